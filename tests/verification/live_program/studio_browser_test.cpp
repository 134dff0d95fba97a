#include "tests/support/studio_page.h"
#include <csignal>
#include <gtest/gtest.h>

// The page of the studio in a headless Chromium beside the built program: a stand typed from a sheet of paper.
using nlohmann::json;

// The rest of the sheet is pasted; tests/campaign types all of it.
TEST_F(StudioBrowser, AStandFromASheetNeedsNoLineOfToml)
{
  const std::string before = picture(), k3 = quick("K3");
  EXPECT_NE(k3, "");
  browser->run("document.getElementById('import').click(); document.getElementById('import-text').value = " +
               json(text_of_sheet()).dump() + "; document.getElementById('import-take').click()");
  ASSERT_TRUE(browser->wait_for("return document.getElementById('v-title').value === 'five hundred'", 20))
      << text("#import-errors");
  ASSERT_TRUE(settled()) << text("#problems");
  const std::string pasted = picture();
  EXPECT_NE(pasted, before);
  type("backup_roll.barrel_diameter", "1380");
  EXPECT_NE(picture(), pasted) << "the drawing waits for nothing";
  EXPECT_NE(picture().find("lit-text"), std::string::npos) << "the value in hand has its dimension line";
  type("pass.0.load", "9.6 MN");
  ASSERT_TRUE(settled()) << text("#problems");
  EXPECT_NE(quick("K3"), k3);
  EXPECT_EQ(text("#state").find("cannot"), std::string::npos) << text("#problems");
  const json values = studio->get("/document")["values"];
  EXPECT_EQ(values["backup_roll.barrel_diameter"], "1380 mm");
  EXPECT_EQ(values["pass.0.load"], "9.6 MN");
  EXPECT_EQ(values["bearing.crb.roller_length"], "120 mm");
  // The saved file means the same to the command line.
  browser->run("document.getElementById('save').click()");
  ASSERT_TRUE(browser->wait_for("return document.getElementById('saved').textContent === 'saved'"));
  EXPECT_EQ(millstand("check " + folder + "/stand.toml").exit_code, 0);
  const json console = browser->console();
  EXPECT_TRUE(console.empty()) << console.dump();
  for (const std::string &request : browser->requests())
    EXPECT_EQ(request.find("http://127.0.0.1:" + std::to_string(studio->program().port()) + "/"), 0u) << request;
}

TEST_F(StudioBrowser, AWrongUnitAnOverlapAndUndoAreAnswered)
{
  type("work_roll.barrel_diameter", "420 bar");
  ASSERT_TRUE(
      browser->wait_for("const w = document.querySelector('.value.error[data-key=\"work_roll.barrel_diameter\"] "
                        ".wrong'); return w !== null && w.textContent.length > 10"));
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

// What was typed while the program was away is sent, but for what a case cannot hold; entries of another case
// stay.
TEST_F(StudioBrowser, ARefusedEditTakesNoOtherWithIt)
{
  const int port = studio->program().port();
  studio->program().end(SIGKILL);
  browser->run("localStorage.setItem('millstand-studio-edits/other/t/x-1', '{\"key\":\"title\",\"value\":\"of "
               "another case\",\"time\":1}');");
  type("work_roll.barrel_length", "1390");
  ASSERT_TRUE(browser->wait_for("return document.body.dataset.link === 'lost'", 10));
  browser->run("import('./state.js').then(page => { page.type('work_roll', 'x'); });");
  type("work_roll.barrel_diameter", "431");
  const std::string waiting =
      "Object.keys(localStorage).filter(name => name.startsWith('millstand-studio-edits/'))";
  ASSERT_TRUE(browser->wait_for("return " + waiting + ".length === 4", 10));
  begin("127.0.0.1:" + std::to_string(port));
  ASSERT_TRUE(browser->wait_for("return document.body.dataset.link === 'open'", 20));
  ASSERT_TRUE(browser->wait_for("return " + waiting + ".length === 1", 20)) << text("#banner");
  EXPECT_TRUE(
      browser->run("return localStorage.getItem('millstand-studio-edits/other/t/x-1') !== null").get<bool>());
  const json values = studio->get("/document")["values"];
  EXPECT_EQ(values["work_roll.barrel_length"], "1390 mm");
  EXPECT_EQ(values["work_roll.barrel_diameter"], "431 mm");
  browser->run("localStorage.removeItem('millstand-studio-edits/other/t/x-1');");
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
