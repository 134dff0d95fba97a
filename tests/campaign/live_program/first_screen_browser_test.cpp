#include "tests/support/program.h"
#include "tests/support/web_driver.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

// What a reader sees of the page of a run before scrolling: positions in a headless Chromium of 1400 x 900. RO-11.
namespace {
struct StandPage {
  const char *name, *options;
  bool chain;  // a stack of rolls has its springs in its own section
};

// Coarse contacts and a slab bite: positions depend on texts and numbers, not on their last digits.
const char *const coarse =
    " -q --set bite.method=slab --set contact.upper.elements_per_half_width=2 --set contact.upper.samples=7 "
    "--set contact.lower.elements_per_half_width=2 --set contact.lower.samples=7";
const StandPage pages[] = {{"cold-tandem-2030", coarse, true},
                           {"four-high-1400", coarse, true},
                           {"hot-strip-2050", coarse, true},
                           {"plate-4300", coarse, true},
                           {"six-high", " -q", false}};

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

TEST(FirstScreenInBrowser, ShowsTheAnswersWithoutScrolling)
{
  if (const std::string missing = Browser::missing(); !missing.empty())
    GTEST_SKIP() << missing << "; scripts/install-deps tests installs it";
  Browser browser;
  for (const StandPage &page : pages) {
    SCOPED_TRACE(page.name);
    const std::string folder = scratch(std::string("first-screen-") + page.name);
    const Outcome run = millstand(std::string("run cases/") + page.name + ".toml -o " + folder + page.options +
                                  " --cache " + shared_cache());
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
