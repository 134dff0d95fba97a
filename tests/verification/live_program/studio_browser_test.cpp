#include "tests/support/program.h"
#include "tests/support/studio_program.h"
#include "tests/support/web_driver.h"
#include <csignal>
#include <filesystem>
#include <gtest/gtest.h>
#include <thread>

// The page of the studio in a headless Chromium beside the built program: a stand typed from a sheet of paper.
namespace {
using nlohmann::json;

class StudioBrowser : public testing::Test {
protected:
  void SetUp() override
  {
    if (!Browser::missing().empty())
      GTEST_SKIP() << Browser::missing() << "; scripts/install-deps tests installs it";
    folder = scratch("studio-browser");
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    begin("127.0.0.1:0");
    browser = std::make_unique<Browser>();
    browser->size(1400, 900);
    browser->open(studio->program().url());
    ASSERT_TRUE(browser->wait_for("return document.body.dataset.ready === 'yes'", 20)) << text("body");
    ASSERT_TRUE(settled());
  }
  void begin(const std::string &listen)
  {
    studio = std::make_unique<StudioProgram>(folder, listen, std::vector<std::string>{"--cache", shared_cache()});
  }
  // All that was typed has been taken and answered.
  bool settled()
  {
    return browser->wait_for(
        "return !document.querySelector('#quick.old') && document.getElementById('answer-note').textContent === ''"
        " && JSON.parse(localStorage.getItem('millstand-studio-edits') || '{\"edits\":[]}').edits.length === 0",
        20);
  }
  void type(const std::string &key, const std::string &value)
  {
    ASSERT_TRUE(browser
                    ->run("const i = document.getElementById('v-" + key +
                          "'); if (!i) return false; i.focus(); if (i.select) i.select(); return true;")
                    .get<bool>())
        << key;
    if (browser->run("return document.activeElement.tagName") == "SELECT")
      browser->run("const i = document.activeElement; i.value = '" + value +
                   "'; i.dispatchEvent(new Event('input', {bubbles: true}));");
    else
      browser->type(value.empty() ? "\uE003" : value);
  }
  std::string text(const std::string &selector)
  {
    const json found =
        browser->run("const e = document.querySelector('" + selector + "'); return e ? e.textContent : ''");
    return found.is_string() ? found.get<std::string>() : "";
  }
  // What stands in the picture, as one text.
  std::string picture()
  {
    return browser->run("return document.getElementById('picture').innerHTML").get<std::string>();
  }
  std::string quick(const std::string &name)
  {
    return text("#quick tr[data-name=\"" + name + "\"] td:nth-child(2)");
  }

  std::string folder;
  std::unique_ptr<StudioProgram> studio;
  std::unique_ptr<Browser> browser;
};
}  // namespace

TEST_F(StudioBrowser, AStandIsTypedFromASheetWithoutALineOfToml)
{
  const auto sheet         = sheet_of_paper();
  const std::string before = picture(), k3 = quick("K3");
  EXPECT_NE(k3, "");
  ASSERT_EQ(sheet.size(), 31u);
  type("work_roll.barrel_diameter", "500");
  EXPECT_NE(picture(), before) << "the drawing waits for nothing";
  EXPECT_NE(picture().find("lit-text"), std::string::npos) << "the value in hand has its dimension line";
  for (const auto &[key, value] : sheet)
    if (key == "pass.0.speed") {
      browser->run("const s = document.getElementById('search'); s.value = 'pass.0.speed'; s.dispatchEvent(new "
                   "Event('input'));");
      type(key, value);
    } else {
      type(key, value);
    }
  for (const char *made : {"pass.0.synthetic_range", "pass.0.synthetic"})
    type(made, "");
  ASSERT_TRUE(settled()) << text("#problems");
  EXPECT_NE(quick("K3"), k3);
  EXPECT_EQ(text("#state").find("error"), std::string::npos) << text("#problems");
  const json values = studio->get("/document")["values"];
  for (const auto &[key, value] : sheet)
    EXPECT_EQ(values[key], value) << key;
  // The saved file means the same to the command line.
  browser->run("document.getElementById('save').click()");
  ASSERT_TRUE(browser->wait_for("return document.getElementById('saved').textContent === 'saved'"));
  const Outcome check = millstand("check " + folder + "/stand.toml");
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_TRUE(browser->console().empty()) << browser->console().dump();
  for (const std::string &request : browser->requests())
    EXPECT_EQ(request.find("http://127.0.0.1:" + std::to_string(studio->program().port()) + "/"), 0u) << request;
}

TEST_F(StudioBrowser, AWrongUnitAnOverlapAndUndoAreAnswered)
{
  type("work_roll.barrel_diameter", "420 bar");
  ASSERT_TRUE(
      browser->wait_for("return document.querySelector('.value.error[data-key=\"work_roll.barrel_diameter\"] "
                        ".wrong').textContent.length > 10"));
  EXPECT_EQ(text("#problems .error"), "error: ");
  EXPECT_TRUE(browser->run("return document.getElementById('quick').classList.contains('old')").get<bool>())
      << "an old answer is grey";
  EXPECT_TRUE(browser->run("return document.getElementById('run').disabled").get<bool>());
  browser->run("document.activeElement.blur(); document.querySelector('#problems button').click()");
  EXPECT_EQ(browser->run("return document.activeElement.id"), "v-work_roll.barrel_diameter");
  browser->run("document.getElementById('undo').click()");
  ASSERT_TRUE(browser->wait_for("return !document.querySelector('.value.error')", 10));
  type("backup_roll.bearing_span", "1500");
  EXPECT_NE(text("#overlaps").find("stand in its barrel"), std::string::npos);
  EXPECT_NE(picture().find("class=\"over\""), std::string::npos);
  type("backup_roll.bearing_span", "2450");
  EXPECT_EQ(text("#overlaps"), "");
  ASSERT_TRUE(settled());
}

TEST_F(StudioBrowser, PinsSweepAndTheStateSurviveAReloadAndAKill)
{
  browser->run("document.getElementById('pin-name').value = '<b>as drawn</b>'; "
               "document.getElementById('pin-form').requestSubmit()");
  ASSERT_TRUE(browser->wait_for("return document.querySelector('#pins tbody tr')", 10));
  EXPECT_NE(text("#pins tbody td").find("<b>as drawn</b>"), std::string::npos) << "a name is text";
  type("work_roll.barrel_diameter", "430");
  ASSERT_TRUE(settled());
  ASSERT_TRUE(browser->wait_for("return /[+−]/.test((document.querySelector('#quick tr[data-name=\"K3\"] "
                                "td:nth-child(3)') || {}).textContent)",
                                10));
  EXPECT_NE(text("#pins tbody tr").find("work_roll.barrel_diameter"), std::string::npos) << text("#pins");
  browser->run("document.getElementById('sweep-form').requestSubmit()");
  ASSERT_TRUE(browser->wait_for("return document.querySelector('#sweep-curve svg .line')", 20));
  EXPECT_TRUE(browser->run("return document.querySelector('#sweep-curve svg .mark') !== null").get<bool>());

  const int port = studio->program().port();
  browser->reload();
  ASSERT_TRUE(browser->wait_for("return document.body.dataset.ready === 'yes'", 20));
  EXPECT_EQ(browser->run("return document.getElementById('v-work_roll.barrel_diameter').value"), "430");
  ASSERT_TRUE(browser->wait_for("return document.querySelector('#pins tbody tr')", 10));

  studio->program().end(SIGKILL);
  type("work_roll.barrel_length", "1390");
  EXPECT_TRUE(browser->wait_for("return document.body.dataset.link === 'lost'", 10));
  begin("127.0.0.1:" + std::to_string(port));
  ASSERT_TRUE(browser->wait_for("return document.body.dataset.link === 'open'", 20));
  ASSERT_TRUE(settled()) << text("#banner");
  const json document = studio->get("/document");
  EXPECT_EQ(document["values"]["work_roll.barrel_length"], "1390 mm") << "what was typed in between is not lost";
  EXPECT_EQ(document["values"]["work_roll.barrel_diameter"], "430 mm");
  EXPECT_EQ(document["pins"].size(), 1u);
  browser->run("[...document.querySelectorAll('#pins button')].find(b => b.textContent === 'Back to it').click()");
  ASSERT_TRUE(
      browser->wait_for("return document.getElementById('v-work_roll.barrel_diameter').value === '420'", 10));
}

TEST_F(StudioBrowser, EveryWidthAndBothSchemesHaveNoScrollBarAcross)
{
  for (const int width : {1400, 1000, 500})
    for (const bool dark : {false, true}) {
      browser->dark(dark);
      browser->size(width, 900);
      EXPECT_LE(browser->run("return document.documentElement.scrollWidth").get<int>(), width);
    }
  // The contrast of every text with its ground, WCAG AA.
  for (const bool dark : {false, true}) {
    browser->dark(dark);
    const json poor = browser->run(R"(
      const number = c => (c.match(/[\d.]+/g) || []).map(Number);
      const light = ([r, g, b]) => { const f = v => (v /= 255) <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4; return 0.2126 * f(r) + 0.7152 * f(g) + 0.0722 * f(b); };
      const ground = e => { for (; e; e = e.parentElement) { const c = number(getComputedStyle(e).backgroundColor); if (c.length === 3 || c[3] === 1) return c; } return [255, 255, 255]; };
      const poor = [];
      for (const e of document.querySelectorAll('main *, header *')) {
        const own = [...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim());
        if (!own || !e.getClientRects().length || e.closest('svg, .old, :disabled')) continue;
        const a = light(number(getComputedStyle(e).color)), b = light(ground(e));
        const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
        if (ratio < 4.5) poor.push(`${e.tagName} ${e.className} ${e.textContent.slice(0, 20)} ${ratio.toFixed(2)}`);
      }
      return poor.slice(0, 10);)");
    EXPECT_TRUE(poor.empty()) << (dark ? "dark " : "light ") << poor.dump(1);
  }
}
