#include "tests/support/studio_page.h"

// The long form of the page of the studio: all values of a sheet of paper typed one by one.
using nlohmann::json;

class StudioTyped : public StudioBrowser {};

TEST_F(StudioTyped, AStandIsTypedFromASheetWithoutALineOfToml)
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
  EXPECT_EQ(text("#state").find("cannot"), std::string::npos) << text("#problems");
  const json values = studio->get("/document")["values"];
  for (const auto &[key, value] : sheet)
    EXPECT_EQ(values[key], value) << key;
  // The saved file means the same to the command line.
  browser->run("document.getElementById('save').click()");
  ASSERT_TRUE(browser->wait_for("return document.getElementById('saved').textContent === 'saved'"));
  const Outcome check = millstand("check " + folder + "/stand.toml");
  EXPECT_EQ(check.exit_code, 0) << check.err;
  const json console = browser->console();
  EXPECT_TRUE(console.empty()) << console.dump();
  for (const std::string &request : browser->requests())
    EXPECT_EQ(request.find("http://127.0.0.1:" + std::to_string(studio->program().port()) + "/"), 0u) << request;
}
