#include "core/base/errors.h"
#include "report/front/html.h"
#include "tests/support/near.h"
#include "tests/support/page_numbers.h"
#include "tests/support/sample_run.h"
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <vector>

using namespace mill;
using namespace mill::report;

namespace {
// Elements <name ...> ... </name> of the page, nested ones included in the outer.
std::vector<std::string> elements(const std::string &html, const std::string &name)
{
  std::vector<std::string> texts;
  const std::string open = "<" + name, close = "</" + name + ">";
  for (std::size_t position = html.find(open); position != std::string::npos;) {
    int depth       = 1;
    std::size_t end = position + 1;
    while (depth > 0) {
      const std::size_t next_open = html.find(open, end), next_close = html.find(close, end);
      if (next_close == std::string::npos)
        return texts;
      depth += next_open < next_close ? 1 : -1;
      end = std::min(next_open, next_close) + 1;
    }
    texts.push_back(html.substr(position, end - position));
    position = html.find(open, end);
  }
  return texts;
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
  for (std::size_t position = html.find('<'); position != std::string::npos;
       position             = html.find('<', position + 1)) {
    const std::size_t end  = html.find('>', position);
    const std::string tag  = html.substr(position + 1, end - position - 1);
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
  for (std::size_t position = text.find(word); position != std::string::npos;
       position             = text.find(word, position + word.size()))
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

// A figure without a unit cannot be used.
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
  for (std::sregex_iterator match(html.begin(), html.end(), link), end; match != end; ++match, ++n_links)
    EXPECT_EQ(count(html, "id=\"" + (*match)[1].str() + "\""), 1u) << (*match)[1];
  EXPECT_GE(n_links, 5);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryKind, testing::Values("four-high", "lumped", "two-cylinders", "bearing"),
                         [](const auto &kind) {
                           std::string name = kind.param;
                           name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                           return name;
                         });

// Hertz at 976.2 kN: 40 192 kN/mm; the sample run is 2 % softer, so 39 404 and a deviation of 1/1.02 - 1 = -1.96
// %.
TEST(HtmlReport, ARowHasValueSourceAccuracyAndDeviation)
{
  const auto cells = cells_of_result(page_of("four-high"), "K3.tangent");
  ASSERT_EQ(cells.size(), 5u);
  const Tolerance ten = within(5 / 39404., "an error of 0.4 % allows tens of kN/mm");
  EXPECT_TRUE(near(number_after(cells[0]), 40192 / 1.02, ten)) << cells[0];
  EXPECT_TRUE(near(number_after(cells[0], "kN/mm"), 4.0192e10 / 1.02, ten)) << cells[0] << ": the same in N/m";
  EXPECT_NE(cells[1].find("computed: contact FEM"), std::string::npos) << cells[1];
  EXPECT_TRUE(near(number_after(cells[3], "\u00b1"), 0.4, within(1e-12, "printed with two digits"))) << cells[3];
  const Tolerance printed = within(0.025, "one decimal");
  EXPECT_TRUE(near(number_after(cells[4], ": "), 40192, within(1e-5, "five digits"))) << cells[4];
  EXPECT_TRUE(near(number_after(cells[4], "("), 100 * (1 / 1.02 - 1), printed)) << cells[4];
}

TEST(HtmlReport, APublishedValueIsPrintedNextToTheResult)
{
  const auto cells = cells_of_result(page_of("four-high"), "K3.tangent");
  ASSERT_EQ(cells.size(), 5u);
  const std::string after_first = cells[4].substr(cells[4].find(')') + 1);
  EXPECT_TRUE(near(number_after(after_first, "published: "), 753399, within(1e-6, "six digits"))) << cells[4];
}

TEST(HtmlReport, AMissingErrorHasItsReason)
{
  EXPECT_NE(page_of("four-high").find("no independent estimate"), std::string::npos);
}

// 1.23 g; the published model has 1.40, the measurement 1.20.
TEST(HtmlReport, PeaksAreComparedWithModelAndMeasurement)
{
  const std::string html = page_of("four-high");
  const std::size_t row  = html.find("<td>upper</td>");
  ASSERT_NE(row, std::string::npos);
  std::vector<double> numbers;
  const std::string cells = html.substr(row, html.find("</tr>", row) - row);
  for (std::size_t cell = cells.find("\"num\">"); cell != std::string::npos;
       cell             = cells.find("\"num\">", cell + 1)) {
    const std::string text = cells.substr(cell + 6);
    numbers.push_back(number_after(text, text.rfind("<b>", 0) == 0 ? "<b>" : ""));
  }
  const std::vector<double> expected{1.23, 0.342, 1.40, 1.23 / 1.40, 1.20, 1.23 / 1.20};
  ASSERT_EQ(numbers.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_TRUE(near(numbers[i], expected[i], within(0.006, "two decimals of a number near one"))) << i;
  EXPECT_GE(count(html, "synthetic"), 5u) << "stated wherever a generated record appears";
}

// 976.2 kN: lowest 3.400e10 (Palmgren), highest 3.721e10 (Hertz); the sample 3.7208e10/1.02 = 3.648e10, 77 % up.
TEST(HtmlReport, ComputedSecantIsPlacedAmongTheClosedForms)
{
  const std::string html = page_of("four-high");
  const std::size_t band = html.find("\u00a0% of the way from the lowest to the highest");
  ASSERT_NE(band, std::string::npos);
  const double lowest = 3.400e10, highest = 3.7208e10, secant = highest / 1.02;
  EXPECT_TRUE(near(number_after(html.substr(band - 2, 2)), 100 * (secant - lowest) / (highest - lowest),
                   within(0.02, "whole percent; four digits of the closed forms")));
}

// The same contact per metre of length: 1 kN/mm per m is what is stored as 1e6 N/m2.
TEST(HtmlReport, CylindersArePerLength)
{
  const std::string html = page_of("two-cylinders");
  EXPECT_NE(html.find("load on the contact [N/mm]"), std::string::npos);
  EXPECT_NE(html.find("stiffness [kN/mm per m]"), std::string::npos);
  // 39 404 kN/mm over 1.4 m, Hertz 40 192 over 1.4 m.
  const std::size_t hertz = html.find("28\u202f708 (");
  ASSERT_NE(hertz, std::string::npos);
  const std::string before = html.substr(0, hertz);
  const std::size_t value  = before.rfind("<td", before.rfind("</td>"));
  const std::string cell   = before.substr(before.find('>', value) + 1);
  EXPECT_TRUE(near(number_after(cell), 40192 / 1.02 / 1.4, within(2e-5, "five digits"))) << cell;
  EXPECT_TRUE(near(number_after(html.substr(hertz), "("), 100 * (1 / 1.02 - 1), within(0.025, "one decimal")));
  EXPECT_EQ(html.find("no finite value"), std::string::npos);
}

TEST(HtmlReport, TheVerdictShowsTheStatus)
{
  SampleRun sample;
  EXPECT_NE(html_report(write_sample_run(sample)).find("verdict warnings\"><p><b>Finished with "),
            std::string::npos);
  sample.warnings             = false;
  const std::string directory = write_sample_run(sample);
  EXPECT_NE(html_report(directory).find("verdict ok\"><p><b>Finished.</b>"), std::string::npos);
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

// Without any one optional file the page is made, with a sentence on what is missing.
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
    // Without these a figure has one curve less, or a table or a subsection is left out without a sentence.
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
