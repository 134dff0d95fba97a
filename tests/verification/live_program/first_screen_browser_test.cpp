#include "tests/support/coarse_run.h"
#include "tests/support/program.h"
#include "tests/support/web_driver.h"
#include <gtest/gtest.h>

// What a reader sees of the page of a run before scrolling: positions in a headless Chromium of 1400 x 900. RO-11.
namespace {
struct Page {
  const char *name, *options;
  bool chain;  // a stack of rolls has its springs in its own section
};

// Coarse meshes: positions depend on texts and numbers, not on their last digits.
const Page pages[] = {{"cold-tandem-2030", coarse_demo.c_str(), true},
                      {"four-high-1400", coarse_demo.c_str(), true},
                      {"hot-strip-2050", coarse_demo.c_str(), true},
                      {"plate-4300", coarse_demo.c_str(), true},
                      {"six-high", "", false}};

// Bottoms in px of what is asked, by its words; -1: it is not on the page or not shown.
nlohmann::json bottoms(Browser &browser)
{
  return browser.run(R"(
    const bottom = e => e && e.getClientRects().length ? e.getBoundingClientRect().bottom : -1;
    const card = words => [...document.querySelectorAll('.card')].find(e => e.querySelector('span').textContent.startsWith(words));
    return {verdict: bottom(document.querySelector('.verdict')), speed: bottom(card('critical speed')),
            gap: bottom(card('gap mode, first kind')), modulus: bottom(card('mill modulus')),
            chain: bottom(document.querySelector('.chain')), words: document.querySelector('.verdict').textContent,
            wide: document.documentElement.scrollWidth};)");
}

void expect_seen(const nlohmann::json &seen, const char *what)
{
  EXPECT_GT(seen[what].get<double>(), 0) << what << " is missing";
  EXPECT_LE(seen[what].get<double>(), 900) << what << " needs scrolling";
}
}  // namespace

TEST(FirstScreen, ShowsTheAnswersWithoutScrolling)
{
  if (const std::string missing = Browser::missing(); !missing.empty())
    GTEST_SKIP() << missing;
  Browser browser;
  for (const Page &page : pages) {
    SCOPED_TRACE(page.name);
    const std::string folder = scratch(std::string("first-screen-") + page.name);
    const Outcome run = millstand(std::string("run cases/") + page.name + ".toml -o " + folder + page.options);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    browser.open("file://" + folder + "/report.html");
    browser.size(1400, 900);
    const nlohmann::json seen = bottoms(browser);
    expect_seen(seen, "verdict");
    expect_seen(seen, "gap");
    const bool searched = seen["words"].get<std::string>().find("not searched") == std::string::npos;
    if (searched)
      expect_seen(seen, "speed");
    if (page.chain) {
      expect_seen(seen, "modulus");
      expect_seen(seen, "chain");
    }
    browser.size(500, 900);
    EXPECT_LE(bottoms(browser)["wide"].get<int>(), 500) << "wider than a narrow window";
  }
}
