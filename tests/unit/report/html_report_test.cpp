#include "core/base/errors.h"
#include "report/front/html.h"
#include "tests/support/sample_run.h"
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <vector>

using namespace mill;
using namespace mill::report;

namespace {
// Elements <name ...> ... </name> of the page, nested ones included in the outer.
std::vector<std::string> elements(const std::string &html, const std::string &name)
{
  std::vector<std::string> found;
  const std::string open = "<" + name, close = "</" + name + ">";
  for (std::size_t at = html.find(open); at != std::string::npos;) {
    int depth       = 1;
    std::size_t end = at + 1;
    while (depth > 0) {
      const std::size_t next_open = html.find(open, end), next_close = html.find(close, end);
      if (next_close == std::string::npos)
        return found;
      depth += next_open < next_close ? 1 : -1;
      end = std::min(next_open, next_close) + 1;
    }
    found.push_back(html.substr(at, end - at));
    at = html.find(open, end);
  }
  return found;
}

std::string without(const std::string &html, const std::string &name)
{
  std::string text = html;
  for (const std::string &element : elements(html, name))
    text.erase(text.find(element), element.size() + name.size() + 2);
  return text;
}

// Empty when every element is closed in order, else the first that is not.
std::string unbalanced(const std::string &html)
{
  std::vector<std::string> open;
  for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
    const std::size_t end  = html.find('>', at);
    const std::string tag  = html.substr(at + 1, end - at - 1);
    const bool closing     = tag[0] == '/';
    const std::string name = tag.substr(closing, tag.find_first_of(" />", closing) - closing);
    if (tag.back() == '/' || tag[0] == '!')
      continue;
    if (!closing)
      open.push_back(name);
    else if (open.empty() || open.back() != name)
      return "<" + tag + ">";
    else
      open.pop_back();
  }
  return open.empty() ? "" : "<" + open.back() + ">";
}

std::size_t count(const std::string &text, const std::string &word)
{
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + word.size()))
    ++n;
  return n;
}

std::string page_of(const std::string &kind)
{
  SampleRun sample;
  sample.kind = kind;
  return html_report(write_sample_run(sample));
}
}  // namespace

class EveryKind : public testing::TestWithParam<const char *> {};

// One figure without a unit is one figure nobody can use.
TEST_P(EveryKind, EveryFigureNamesItsUnits)
{
  const std::string html = page_of(GetParam());
  int n_figures          = 0;
  for (const std::string &figure : elements(html, "figure"))
    for (const std::string &svg : elements(figure, "svg")) {
      ++n_figures;
      const std::regex unit("<text class=\"axis\"[^>]*>[^<]*\\[[^\\]<]+\\][^<]*</text>");
      EXPECT_TRUE(std::regex_search(svg, unit)) << svg.substr(0, 300);
    }
  EXPECT_GE(n_figures, 2);
  EXPECT_EQ(count(html, "<figure>"), count(html, "<figcaption>"));
}

TEST_P(EveryKind, IsOneFileThatLoadsNothing)
{
  const std::string html = page_of(GetParam());
  const std::regex loads("(src|href|srcset|data|action|poster)\\s*=\\s*[\"'][^#\"']");
  EXPECT_FALSE(std::regex_search(without(html, "script"), loads));
  EXPECT_EQ(count(html, "<link"), 0u);
  EXPECT_EQ(count(html, "<img"), 0u);
  EXPECT_EQ(count(html, "@import"), 0u);
  for (const std::string &style : elements(html, "style"))
    EXPECT_EQ(count(style, "url("), 0u);
  EXPECT_EQ(count(html, "<script"), count(html, "<script>") + count(html, "<script type=\"application/json\">"))
      << "no script from elsewhere";
}

TEST_P(EveryKind, IsWellFormed)
{
  const std::string html = without(without(page_of(GetParam()), "script"), "style");
  EXPECT_EQ(unbalanced(html), "");
  EXPECT_EQ(count(html, ">nan<"), 0u);
  EXPECT_EQ(count(html, "\"nan\""), 0u);
  EXPECT_EQ(count(html, "=\"inf\""), 0u);
}

TEST_P(EveryKind, ContentsLeadToEverySection)
{
  const std::string html = page_of(GetParam());
  const std::regex link("href=\"#([a-z]+)\"");
  int n_links = 0;
  for (std::sregex_iterator found(html.begin(), html.end(), link), end; found != end; ++found, ++n_links)
    EXPECT_EQ(count(html, "id=\"" + (*found)[1].str() + "\""), 1u) << (*found)[1];
  EXPECT_GE(n_links, 5);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryKind, testing::Values("four-high", "lumped", "two-cylinders", "bearing"),
                         [](const auto &kind) {
                           std::string name = kind.param;
                           name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                           return name;
                         });

TEST(HtmlReport, SaysTheNumbersWithSourceAndDeviation)
{
  const std::string html = page_of("four-high");
  // Hertz at 976.2 kN: 40 192 kN/mm; the sample run is 2 % softer, so 39 404 and a deviation of 1/1.02 - 1 = -1.96
  // %.
  EXPECT_NE(html.find("39\u202f404</b>\u00a0kN/mm"), std::string::npos);
  EXPECT_NE(html.find("40\u202f192\u00a0kN/mm <span class=\"deviation\">(\u22122.0\u00a0%)"), std::string::npos);
  EXPECT_NE(html.find("753\u202f399\u00a0kN/mm"), std::string::npos) << "the published value stands beside it";
  EXPECT_NE(html.find("3.9404 \u00d7 10\u00b9\u2070\u00a0N/m"), std::string::npos);
  EXPECT_NE(html.find("\u00b10.40\u00a0%"), std::string::npos) << "error estimate";
  EXPECT_NE(html.find("no independent estimate"), std::string::npos) << "a missing one has its reason";
  EXPECT_NE(html.find("computed: contact FEM"), std::string::npos);
}

// 1.23 g against the published model's 1.40 and the measured 1.20.
TEST(HtmlReport, PeaksStandBesideModelAndMeasurement)
{
  const std::string html = page_of("four-high");
  const std::string row =
      "<td>upper</td><td class=\"num\"><b>1.23</b></td><td class=\"num\">0.342</td><td class=\"num\">1.40</td>"
      "<td class=\"num\">0.88</td><td class=\"num\">1.20</td><td class=\"num\">1.02</td>";
  EXPECT_NE(html.find(row), std::string::npos);
  EXPECT_GE(count(html, "synthetic"), 5u) << "said wherever a made record appears";
}

TEST(HtmlReport, ComputedSecantIsPlacedAmongTheClosedForms)
{
  const std::string html = page_of("four-high");
  // 976.2 kN: lowest 3.400e10 (Palmgren), highest 3.721e10 (Hertz); the sample 3.7208e10/1.02 = 3.648e10, 77 % up.
  EXPECT_NE(html.find("36\u202f478</td><td class=\"num\">34\u202f00"), std::string::npos);
  EXPECT_NE(html.find("77\u00a0% of the way from the lowest to the highest"), std::string::npos);
}

// The same contact per metre of length: 1 kN/mm per m is what is stored as 1e6 N/m2.
TEST(HtmlReport, CylindersArePerLength)
{
  const std::string html = page_of("two-cylinders");
  EXPECT_NE(html.find("load on the contact [N/mm]"), std::string::npos);
  EXPECT_NE(html.find("stiffness [kN/mm per m]"), std::string::npos);
  // 39 404 kN/mm over 1.4 m, Hertz 40 192 over 1.4 m.
  EXPECT_NE(html.find("28\u202f146</td><td class=\"num\">28\u202f708 (\u22122.0\u00a0%)"), std::string::npos);
  EXPECT_EQ(html.find("no finite value"), std::string::npos);
}

TEST(HtmlReport, TheVerdictTellsTheStatus)
{
  SampleRun sample;
  EXPECT_NE(html_report(write_sample_run(sample)).find("verdict warnings\"><p><b>Done, read what is to know.</b>"),
            std::string::npos);
  sample.warnings             = false;
  const std::string directory = write_sample_run(sample);
  EXPECT_NE(html_report(directory).find("verdict ok\"><p><b>Done.</b>"), std::string::npos);
  auto run   = read_run(directory);
  run.status = "failed";
  EXPECT_NE(html_page(run).find("verdict failed\"><p><b>Failed.</b>"), std::string::npos);
}

TEST(HtmlReport, EscapesTitleAndNames)
{
  SampleRun sample;
  sample.title                = "Stand <1> & \"co\"</script><b>";
  auto run                    = read_run(write_sample_run(sample));
  run.manifest.passes[0].name = "a<b";
  run.results[0].source       = "given & <kept>";
  run.assumptions.push_back("x < y & \"z\"");
  const std::string html = html_page(run);
  EXPECT_NE(html.find("Stand &lt;1&gt; &amp; &quot;co&quot;&lt;/script&gt;&lt;b&gt;"), std::string::npos);
  EXPECT_NE(html.find("a&lt;b"), std::string::npos);
  EXPECT_EQ(html.find("a<b"), std::string::npos);
  EXPECT_NE(html.find("given &amp; &lt;kept&gt;"), std::string::npos);
  EXPECT_NE(html.find("x &lt; y &amp; &quot;z&quot;"), std::string::npos);
}

// Whatever optional file is gone, the page is there and says in a sentence what is not.
TEST(HtmlReport, EveryOptionalFileMayBeMissing)
{
  namespace fs                = std::filesystem;
  const std::string directory = write_sample_run();
  std::vector<fs::path> files;
  for (const char *folder : {"curves", "response"})
    for (const auto &file : fs::directory_iterator(fs::path(directory) / folder))
      files.push_back(file.path());
  files.push_back(fs::path(directory) / "run.json");
  const std::size_t whole = count(html_report(directory), "class=\"absent\"");
  EXPECT_EQ(whole, 0u);
  for (const fs::path &file : files) {
    const fs::path kept = file.string() + ".kept";
    fs::rename(file, kept);
    std::string html;
    EXPECT_NO_THROW(html = html_report(directory)) << file;
    // Without these a figure has a curve less, or a table or a whole subsection is not there: nothing is
    // announced.
    const std::set<std::string> silent{"modes-horizontal",
                                       "poles",
                                       "contact-upper",
                                       "contact-lower",
                                       "contact-upper-in-stand",
                                       "contact-lower-in-stand",
                                       "bearing-trb",
                                       "bearing-crb",
                                       "contact-upper-barrel-mirrored",
                                       "contact-lower-barrel-mirrored"};
    if (!silent.count(file.stem())) {
      EXPECT_GE(count(html, "class=\"absent\"") + count(html, "Not in this report"), 1u) << file;
    }
    fs::rename(kept, file);
  }
  for (const fs::path &file : files)
    fs::remove(file);
  EXPECT_NE(html_report(directory).find("run.json is missing"), std::string::npos);
}

TEST(HtmlReport, NoResultsIsAnInputError)
{
  EXPECT_THROW(html_report("no/such/folder"), InputError);
}

TEST(HtmlReport, LongRecordsStaySmallAndKeepTheirPeak)
{
  SampleRun sample;
  sample.samples         = 200001;
  const std::string html = html_report(write_sample_run(sample));
  EXPECT_LT(html.size(), 2000000u) << "a report is mailed";
  EXPECT_GE(count(html, "9.5"), 2u);
  for (const std::string &box : elements(html, "div class=\"zoom\""))
    EXPECT_LE(count(box, ","), 8100u) << "at most 8000 points for a chart of one series";
  // The static drawing is there whether or not a script puts a chart in its place.
  EXPECT_EQ(count(html, "class=\"history\""), count(html, "<div class=\"static\"><svg"));
  EXPECT_EQ(count(html, "class=\"history\""), 8u) << "two passes, two forces and two rolls";
}
