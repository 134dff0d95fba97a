#include "report/bearing/figures.h"
#include "report/front/html.h"
#include "report/plot/number.h"
#include "report/results/names.h"
#include "tests/support/near.h"
#include "tests/support/sample_run.h"
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <set>

using namespace mill;
using namespace mill::report;
using Eigen::VectorXd;
namespace fs = std::filesystem;

namespace {
constexpr double pi = 3.14159265358979323846;

SampleRun bearing_sample()
{
  SampleRun sample;
  sample.kind = "bearing";
  return sample;
}

bool says(const std::string &text, const std::string &what)
{
  return text.find(what) != std::string::npos;
}

// Roller loads of rows as multiples of a cosine, the cage turned by an angle, with a dip on the load line.
Table ring(const std::vector<double> &rows, const int rollers = 20, const double turned = 0, const double dip = 0)
{
  const VectorXd angle = VectorXd::LinSpaced(rollers, 0, 2 * pi * (rollers - 1) / rollers).array() + turned;
  const VectorXd shape = angle.unaryExpr([dip](const double a) {
    return std::max(0.0, std::cos(a)) * (1 - dip * std::exp(-std::pow(std::remainder(a, 2 * pi) / 0.2, 2)));
  });
  Table table;
  table.add("angle", "rad", angle);
  for (std::size_t r = 0; r < rows.size(); ++r)
    table.add("row" + std::to_string(r + 1), "N", 1e4 * rows[r] * shape);
  return table;
}
}  // namespace

TEST(BearingReport, StatesThePlaceOfTheHeaviestRoller)
{
  EXPECT_TRUE(says(heaviest_roller_sentence(ring({1, 2, 1, 1})),
                   "On the load line:</b> the heaviest roller, in row 2, "
                   "carries 20.00\u00a0kN"));
  // cage turned by half a pitch: two rollers astride of the load line
  EXPECT_TRUE(says(heaviest_roller_sentence(ring({1}, 20, pi / 20)), "On the load line"));
  // dip of one half on the load line: the neighbours at 18 degrees carry cos(18) (1 - 0.5 exp(-2.467)) = 0.911
  const std::string off = heaviest_roller_sentence(ring({1, 1}, 20, 0, 0.5));
  EXPECT_TRUE(says(off, "Off the load line")) << off;
  EXPECT_TRUE(
      says(off, "carries 9.107\u00a0kN and lies 18.0\u00b0 off it, while the roller on it carries 5.000\u00a0kN"))
      << off;
  EXPECT_EQ(heaviest_roller_sentence(Table()), "");
}

TEST(BearingReport, RowsThatCarryTheSameAreDrawnOnce)
{
  const auto titles = [](const std::vector<double> &rows) {
    std::vector<std::string> texts;
    for (const std::string &svg : roller_polars(ring(rows))) {
      const std::size_t position = svg.find("aria-label=\"") + 12;
      texts.push_back(svg.substr(position, svg.find(':', position) - position));
    }
    return texts;
  };
  EXPECT_EQ(titles({1, 1, 1, 1}), (std::vector<std::string>{"Each row"}));
  EXPECT_EQ(titles({1, 2, 2, 1}), (std::vector<std::string>{"Rows 1 and 4", "Rows 2 and 3"}));
  EXPECT_EQ(titles({1, 2, 3, 4}), (std::vector<std::string>{"Row 1", "Row 2", "Row 3", "Row 4"}));
  EXPECT_EQ(titles({1, 1, 2, 1}), (std::vector<std::string>{"Rows 1, 2 and 4", "Row 3"}));
  EXPECT_EQ(titles({1}), (std::vector<std::string>{"Row 1"}));
}

// Sum of the published row values 2587.324 kN/mm: times 39/5 = 20 181, times 39 cos^2(19.66 deg)/4.0847 = 21 907.
TEST(BearingReport, PublishedTableSpellsOutTheFactor)
{
  const std::string html = html_report(write_sample_run(bearing_sample()));
  EXPECT_TRUE(says(html, "2587.3\u00a0kN/mm, times Z/5 = 39/5 = 7.8 is 20\u202f181\u00a0kN/mm"));
  EXPECT_TRUE(says(html, "sum \u00d7 Z/5 = sum \u00d7 7.8</th><td class=\"num\">20\u202f181</td>"));
  EXPECT_TRUE(says(html, "sum \u00d7 Z cos\u00b2\u03b1/4.0847 = sum \u00d7 8.47"));
  EXPECT_TRUE(says(html, "<td class=\"num\">21\u202f907</td>"));
  EXPECT_TRUE(says(html, "which is +0.40\u00a0% from the published total of 20\u202f100\u00a0kN/mm"));
  // row 1: 678.395 published, secant 540.5 of the sample
  EXPECT_TRUE(says(html, "one roller of row 1</th><td class=\"num\">678.4</td><td class=\"num\">20.50</td><td "
                         "class=\"num\">540.5 <span class=\"deviation\">(\u221220.3\u00a0%)"));
}

TEST(BearingReport, ComparesEveryModelWithTheRun)
{
  const std::string html = html_report(write_sample_run(bearing_sample()));
  for (const char *legend : {"tangent, this run", "secant, this run", "tangent, the same with rigid rings",
                             "secant, standard, rigid rings", "standard, rigid rings", "ISO/TS 16281",
                             "Palmgren, two contacts", "contact elements"})
    EXPECT_TRUE(says(html, std::string(">") + legend + "<")) << legend;
  EXPECT_TRUE(says(html, "Off the load line"));
  EXPECT_TRUE(says(html, "Pressure on the inner raceway"));
  EXPECT_TRUE(says(html, "tangent 10\u202f000\u00a0kN/mm in the mean, 1.6\u00a0% from the softest"));
  EXPECT_TRUE(says(html, "The rollers carry nothing during 3.10\u00a0% of the time"));
  EXPECT_TRUE(says(html, "4 \u00d7 39 rollers 33.40 \u00d7 \u2300 21.50, cup angle 19.66\u00b0")) << "sketch";
  EXPECT_FALSE(says(html, "class=\"absent\""));
}

// A stand of an earlier version: no other models, no companions, and no complaint about them.
TEST(BearingReport, FilesOfEarlierVersionsKeepTheirFigures)
{
  const std::string html = html_report(write_sample_run());
  EXPECT_TRUE(says(html, "Radial stiffness over load"));
  EXPECT_TRUE(says(html, "Share of the rows"));
  EXPECT_FALSE(says(html, "standard, rigid rings"));
  EXPECT_FALSE(says(html, "class=\"absent\""));
}

TEST(BearingReport, EveryFileMayBeMissing)
{
  const std::string directory = write_sample_run(bearing_sample());
  std::vector<fs::path> files;
  for (const char *folder : {"curves", "response"})
    for (const auto &file : fs::directory_iterator(fs::path(directory) / folder))
      files.push_back(file.path());
  EXPECT_EQ(files.size(), 11u);
  const std::set<std::string> announced{"bearing-trb", "bearing-trb-rows", "bearing-trb-rollers",
                                        "bearing-trb-law", "bearing-trb-spectrum"};
  for (const fs::path &file : files) {
    const fs::path kept = file.string() + ".kept";
    fs::rename(file, kept);
    std::string html;
    EXPECT_NO_THROW(html = html_report(directory)) << file;
    if (announced.count(file.stem()))
      EXPECT_TRUE(says(html, "class=\"absent\"")) << file;
    fs::rename(kept, file);
  }
}

TEST(BearingReport, ResultsAreGrouped)
{
  auto run              = read_run(write_sample_run(bearing_sample()));
  const std::size_t all = run.results.size();
  Result odd            = run.results[0];
  odd.name              = "Kzc.something_new";
  run.results.push_back(odd);
  odd.name = "K99";
  run.results.push_back(odd);
  std::vector<std::string> titles;
  std::size_t shown = 0;
  for (const Group &group : bearing_groups(run)) {
    titles.push_back(group.title);
    shown += group.results.size();
  }
  EXPECT_EQ(titles,
            (std::vector<std::string>{"Stiffness of one bearing", "Rows", "Rollers",
                                      "From one roller to the bearing", "A mass on the bearing", "Others"}));
  EXPECT_EQ(shown, all + 2) << "none is lost";
  EXPECT_EQ(bearing_groups(run)[0].results.back()->name, "Kzc.something_new");
  for (const Result &result : run.results)
    if (result.name.rfind("Kzc.", 0) == 0 && result.name != "Kzc.something_new") {
      EXPECT_TRUE(says(meaning_of(result.name), "the bearing at its load, ")) << result.name << " has no words";
    }
  EXPECT_EQ(meaning_of("Kzc.row3_axial"), "the bearing at its load, axial force of row 3");
}

TEST(BearingReport, AnglesAreInDegreesAndIntegersHaveNoDecimals)
{
  EXPECT_EQ(engineering(0.32, "rad").unit, "\u00b0");
  EXPECT_TRUE(near(engineering(pi, "rad").value, 180,
                   within(1e-10 / 180, "one multiplication with a factor of 17 digits")));
  EXPECT_EQ(engineering(5e-4, "rad").unit, "mrad");
  const std::string html = html_report(write_sample_run(bearing_sample()));
  EXPECT_TRUE(says(html, "<b>21</b>")) << "loaded rollers are counted";
  EXPECT_TRUE(says(html, "ISO/TS 16281, rigid rings: 25.0\u00a0% <span class=\"deviation\">(\u22124.5 points)"));
}

TEST(BearingReport, StatesTheArrangementOfTheRows)
{
  auto run = read_run(write_sample_run(bearing_sample()));
  EXPECT_TRUE(
      says(html_page(run), "+-+-, pairs back to back: two double cups (TQI)</code>, as the case gives it"));
  run.manifest.bearings["trb"].size["arrangement_assumed"] = 1;
  EXPECT_TRUE(
      says(html_page(run), "(TQI)</code>, <b>assumed</b>: the case does not give <code>arrangement</code>"));
  run.manifest.bearings["trb"].size["cup_angle"] = 0;
  EXPECT_FALSE(says(html_page(run), "back to back"));
}

TEST(BearingReport, WithoutDimensionsThereIsNoSketch)
{
  EXPECT_TRUE(bearing_sketch({}).empty());
  auto run = read_run(write_sample_run(bearing_sample()));
  EXPECT_EQ(bearing_sketch(run.bearing("trb")).size(), 2u);
  EXPECT_TRUE(bearing_sketch(run.bearing("crb")).empty());
  run.manifest.bearings["trb"].size.erase("roller_diameter");
  EXPECT_FALSE(says(html_page(run), "The bearing in its chock"));
}
