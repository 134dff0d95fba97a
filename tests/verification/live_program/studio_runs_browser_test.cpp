#include "tests/support/studio_page.h"
#include <chrono>
#include <gtest/gtest.h>
#include <thread>

// Runs, reports, the comparison of two pins and exports on the page, by keyboard where there is a key.
using nlohmann::json;

namespace {
const std::string tab_key = "\uE004", enter_key = "\uE007", escape_key = "\uE00C", control = "\uE009",
                  right_key = "\uE014", left_key = "\uE012";
}  // namespace

class StudioRunsBrowser : public StudioBrowser {
protected:
  // A chain of masses: its run takes a second.
  void put_case() override
  {
    ASSERT_EQ(millstand("new lumped -o " + folder + "/stand.toml").exit_code, 0);
  }
  std::string focus()
  {
    return browser->run("return document.activeElement.id || document.activeElement.value || ''")
        .get<std::string>();
  }
  void run_and_wait(const std::string &id)
  {
    browser->type_with(control, enter_key);
    ASSERT_TRUE(browser->wait_for("return document.getElementById('run-note').textContent.startsWith('" + id +
                                      ": done') && document.getElementById('show-report') !== null",
                                  60))
        << text("#run-note") << text("#run-answer");
  }
  void pin(const std::string &name, const std::string &count)
  {
    browser->run("document.getElementById('pin-name').value = '" + name +
                 "'; document.getElementById('pin-form').requestSubmit()");
    ASSERT_TRUE(
        browser->wait_for("return document.querySelectorAll('#pins tbody tr').length === " + count + ";", 20));
  }
  std::string frame_text()
  {
    for (int i = 0; i < 100; ++i) {  // a frame is loaded some time after its box is open
      const json shown =
          browser->run_in_frame("#report-frame", "return document.body ? document.body.innerText : ''");
      if (shown.is_string() && shown.get<std::string>().size() > 200)
        return shown;
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
    }
    return "";
  }
};

TEST_F(StudioRunsBrowser, TwoPinsAreRunComparedAndExported)
{
  run_and_wait("run-1");
  browser->run("document.getElementById('show-report').focus()");
  browser->type(enter_key);
  ASSERT_TRUE(browser->wait_for("return document.getElementById('report-box').open"));
  EXPECT_NE(frame_text().find("f1"), std::string::npos) << "the report is in the frame";
  browser->type(escape_key);
  ASSERT_TRUE(browser->wait_for("return !document.getElementById('report-box').open"));
  EXPECT_EQ(focus(), "show-report") << "the focus is back where it was";

  pin("light", "1");
  type("given.M2", "70 t");
  ASSERT_TRUE(settled());
  pin("heavy", "2");
  browser->run("document.querySelectorAll('#pins input').forEach(box => box.click())");
  EXPECT_TRUE(browser->run("return document.getElementById('compare').disabled").get<bool>());
  EXPECT_NE(text("#compare-note").find("without a run"), std::string::npos) << text("#compare-note");
  run_and_wait("run-2");
  ASSERT_TRUE(browser->wait_for("return !document.getElementById('compare').disabled", 10))
      << text("#compare-note") << text("#pins");
  browser->run("document.getElementById('compare').focus()");
  EXPECT_EQ(focus(), "compare");
  browser->type(enter_key);
  ASSERT_TRUE(browser->wait_for("return document.getElementById('report-box').open", 60))
      << focus() << text("#banner") << text("#compare-note");
  const std::string comparison = frame_text();
  EXPECT_NE(comparison.find("run-1"), std::string::npos) << comparison.substr(0, 400);
  EXPECT_NE(comparison.find("run-2"), std::string::npos);
  EXPECT_NE(comparison.find("M2"), std::string::npos) << "the input that differs is named";
  browser->type(escape_key);

  browser->type_with(control, "e");
  ASSERT_TRUE(browser->wait_for("return document.getElementById('export-box').open"));
  for (int i = 0; i < 8 && focus() != "fmu"; ++i)
    browser->type(tab_key);
  ASSERT_EQ(focus(), "fmu");
  browser->type(enter_key);
  ASSERT_TRUE(browser->wait_for("return document.getElementById('download') !== null", 60)) << text("#run-note");
  EXPECT_EQ(text("#download"), "Download stand.fmu");
  browser->reload();
  ASSERT_TRUE(browser->wait_for("return document.getElementById('download') !== null", 20)) << "after a reload";
  ASSERT_TRUE(browser
                  ->run("const done = arguments[arguments.length - 1]; const request = new XMLHttpRequest(); "
                        "request.open('GET', document.getElementById('download').href, false); "
                        "request.overrideMimeType('text/plain; charset=x-user-defined'); request.send(); "
                        "return request.status === 200 && request.responseText.startsWith('PK')")
                  .get<bool>())
      << "the archive of a unit";
  const json console = browser->console();
  EXPECT_TRUE(console.empty()) << console.dump();
}

TEST_F(StudioRunsBrowser, TabsSliderAndBoxesAreReachedByKeys)
{
  browser->run("document.querySelector('#pictures [aria-selected=\"true\"]').focus()");
  browser->type(right_key);
  EXPECT_EQ(browser->run("return document.activeElement.textContent"), "Bearing");
  EXPECT_EQ(browser->run("return document.activeElement.getAttribute('aria-selected')"), "true");
  browser->type(left_key);
  EXPECT_EQ(browser->run("return document.activeElement.textContent"), "Stand");
  browser->run("document.getElementById('sweep-form').requestSubmit()");
  ASSERT_TRUE(browser->wait_for("return !document.getElementById('sweep-slide').hidden", 20)) << text("#banner");
  browser->run("document.getElementById('sweep-slider').focus()");
  const std::string before = text("#sweep-text");
  browser->type(right_key);
  EXPECT_NE(text("#sweep-text"), before) << "the slider reads the curve";
  for (const char *box : {"import", "help", "export"}) {
    browser->run(std::string("document.getElementById('") + box + "').focus()");
    browser->type(enter_key);
    ASSERT_TRUE(browser->wait_for(std::string("return document.getElementById('") + box + "-box').open")) << box;
    browser->type(escape_key);
    ASSERT_TRUE(browser->wait_for(std::string("return !document.getElementById('") + box + "-box').open")) << box;
    EXPECT_EQ(focus(), box) << "the focus is back where it was";
  }
}
