#include "report/front/html.h"
#include "report/models/figures.h"
#include "report/modes/animation.h"
#include "report/modes/drawing.h"
#include "tests/support/html_page.h"
#include "tests/support/near.h"
#include "tests/support/sample_models.h"
#include <gtest/gtest.h>
#include <regex>
#include <sstream>

using namespace mill;
using namespace mill::report;
using Eigen::VectorXd;
using nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {
// The page of one sample run, read once, without the histories that cost most of its time.
std::string page_of(const ordered_json &models)
{
  static const report::Run run = [] {
    report::Run read = read_run(write_sample_run());
    for (auto table = read.tables.begin(); table != read.tables.end();)
      table = table->first.rfind("response/", 0) == 0 ? read.tables.erase(table) : std::next(table);
    return read;
  }();
  std::ofstream(fs::path(run.directory) / "curves" / "models.json") << models.dump();
  return html_page(run);
}

ModelData data_of(const ordered_json &models)
{
  return read_models(sample::run_with_models(models));
}

ordered_json script_of(const std::string &html)
{
  const std::size_t player = html.find("class=\"mode-player\"");
  const std::string open   = "<script type=\"application/json\">";
  const std::size_t start  = html.find(open, player) + open.size();
  return ordered_json::parse(html.substr(start, html.find("</script>", start) - start));
}
}  // namespace

TEST(ReadModels, ReadsNumbersTextsAndGaps)
{
  ordered_json json = sample::models_json();
  json["models"][1]["modes"][0]["points"].erase(3);  // one too few
  json["models"][1]["modes"][1].erase("lines");
  const ModelData data = data_of(json);
  EXPECT_TRUE(data.stored);
  EXPECT_EQ(data.problem, "");
  EXPECT_EQ(data.frequency_limit, 1000);
  EXPECT_EQ(data.at, "976.2 kN");
  ASSERT_EQ(data.models.size(), 3u);
  EXPECT_EQ(data.title("craig-bampton"), "Craig-Bampton");
  EXPECT_EQ(data.title("unknown"), "unknown");
  EXPECT_EQ(data.detailed()->name, "craig-bampton");
  EXPECT_TRUE(std::isnan(data.models[0].modes[0].error_estimate));
  const ComparedModel &beam = data.models[1];
  EXPECT_EQ(beam.modes[0].points.size(), 12);
  EXPECT_TRUE(std::isnan(beam.modes[0].points[11]));
  ASSERT_EQ(beam.modes[1].lines.size(), 4u);
  EXPECT_EQ(beam.modes[1].lines[2].size(), beam.lines[2].z.size());
  EXPECT_TRUE(beam.modes[1].lines[2].array().isNaN().all());
  ASSERT_EQ(data.pairs.size(), 6u);
  EXPECT_EQ(data.pairs[2].partner.at("beam").frequency, 176.1);
  EXPECT_EQ(data.pairs[5].partner.size(), 0u);
  EXPECT_EQ(data.mac.values(2, 3), 0.36);
  EXPECT_EQ(data.masses_needed[0].missing.size(), 10u);
  EXPECT_EQ(data.kept_modes.error.rows(), 5);
  EXPECT_TRUE(std::isnan(data.routes[2].published));
}

TEST(ReadModels, ABrokenFileIsReportedWithoutAnException)
{
  const std::string run = write_sample_run();
  EXPECT_FALSE(read_models(run).stored);
  EXPECT_FALSE(says(html_report(run), "id=\"models\""));
  for (const char *text : {"{\"models\": [", "[1, 2]", "", "7"}) {
    std::ofstream(fs::path(run) / "curves" / "models.json") << text;
    const ModelData data = read_models(run);
    EXPECT_FALSE(data.stored) << text;
    EXPECT_EQ(data.problem,
              "curves/models.json is not what this program writes, so the models of the stand are not "
              "shown; run the case again.");
    const std::string html = html_report(run);
    EXPECT_TRUE(says(html, data.problem)) << text;
    expect_sound(html, text);
  }
}

TEST(ModelReport, EverythingThatIsStoredIsShown)
{
  const std::string run = sample::run_with_models(sample::models_json());
  sample::write_fe_shapes(run);
  const std::string html = html_report(run);
  expect_sound(html, "everything");
  for (const char *text :
       {"<details class=\"part\" id=\"masses\"", "<details class=\"part\" id=\"models\"",
        "How few masses are enough?", "Frequencies side by side", "Modal assurance", "Mode shapes of the stand",
        "How many modes of each part are enough", "Six masses are enough below 60 Hz", "the force reaches 990 Hz",
        "limit 1000 Hz", "976.2 kN"})
    EXPECT_TRUE(says(html, text)) << text;
  // The answer comes first in its section.
  const std::size_t section = html.find("<details class=\"part\" id=\"models\"");
  EXPECT_LT(html.find("class=\"answer\"", section), html.find("<figure>", section));
  for (const std::string &figure : elements(html, "figure"))
    for (const std::string &drawing : elements(figure, "svg role"))
      EXPECT_TRUE(std::regex_search(drawing, std::regex("<text class=\"axis\"[^>]*>[^<]*\\[[^\\]<]+\\]")))
          << drawing.substr(0, 200);
  EXPECT_FALSE(std::regex_search(without_scripts(html),
                                 std::regex("(src|href|srcset|data|action|poster)\\s*=\\s*[\"'][^#\"']")));
}

TEST(ModelReport, AnyPartMayBeMissing)
{
  const ordered_json whole = sample::models_json();
  for (const auto &[key, value] : whole.items()) {
    ordered_json json = whole;
    json.erase(key);
    expect_sound(page_of(json), "without " + key);
    if (value.is_array()) {
      json[key] = ordered_json::array();
      expect_sound(page_of(json), key + " empty");
    }
    json[key] = "a text";
    expect_sound(page_of(json), key + " of the wrong type");
  }
  expect_sound(page_of(ordered_json::object()), "empty object");
}

TEST(ModelReport, AnyModelMayBeMissing)
{
  for (const std::size_t gone : {0u, 1u, 2u}) {
    ordered_json json = sample::models_json();
    json["models"].erase(gone);
    expect_sound(page_of(json), "model " + std::to_string(gone));
  }
  ordered_json chain = sample::models_json();
  chain["models"].erase(2);
  chain["models"].erase(1);
  const ModelData data = data_of(chain);
  EXPECT_EQ(data.detailed(), nullptr);
  EXPECT_EQ(verdict_table(data), "");
  EXPECT_EQ(mode_sheet(data), "");
  EXPECT_TRUE(says(mode_player(data, {}), "38.9 Hz"));
  expect_sound(page_of(chain), "six masses alone");
}

TEST(ModelReport, AnyNumberMayBeNull)
{
  const ordered_json whole = sample::models_json();
  for (const auto &[key, value] : whole.items()) {
    ordered_json json = whole;
    make_null(json[key]);
    expect_sound(page_of(json), key);
  }
  ordered_json json = whole;
  make_null(json);
  expect_sound(page_of(json), "no number at all");
}

TEST(ModelReport, TextsAreEscaped)
{
  const std::string evil = "</script><b>\"&' \\";
  ordered_json json      = sample::models_json();
  json["at"] = json["driven"] = evil;
  json["answer"] = json["warnings"] = {evil, evil};
  for (ordered_json &model : json["models"]) {
    for (const char *key : {"title", "source"})
      model[key] = evil;
    for (const char *key : {"points", "parts", "springs"})
      model[key][1] = evil;
  }
  json["models"][1]["lines"][0]["name"]    = evil;
  json["masses_needed"][1]["added"]        = evil;
  json["breakdown"][0]["parts"][0]["name"] = json["breakdown"][0]["route"] = json["routes"][0]["mass"] = evil;
  const std::string html = page_of(json);
  expect_sound(html, "evil");
  EXPECT_EQ(count(html, evil), 0);
  EXPECT_EQ(count(html, "</script><b>"), 0);
  EXPECT_GE(count(html, "&lt;/script&gt;&lt;b&gt;"), 8);
  EXPECT_EQ(script_of(html)[1]["modes"][1]["kinetic"][0][0], evil) << "the script reads it as it was";
}

TEST(ModelAnimation, HoldsEveryModeOfEveryModel)
{
  const ordered_json json = sample::models_json();
  const std::string html  = page_of(json);
  const ordered_json held = script_of(html);
  ASSERT_EQ(held.size(), 3u);
  const std::string page = without_scripts(html);
  for (std::size_t m = 0; m < 3; ++m) {
    const ordered_json &model = json["models"][m];
    EXPECT_EQ(held[m]["name"], model["name"]);
    ASSERT_EQ(held[m]["modes"].size(), model["modes"].size());
    for (std::size_t i = 0; i < model["modes"].size(); ++i) {
      char name[80];
      std::snprintf(name, sizeof name, ">%zu \u00b7 %.1f Hz</option>", i + 1,
                    model["modes"][i]["frequency"].get<double>());
      EXPECT_TRUE(says(page, name)) << name;
      EXPECT_EQ(held[m]["modes"][i]["d"].size(), held[m]["modes"][0]["d"].size());
      EXPECT_EQ(held[m]["modes"][i]["d"][0], 0.0) << "the ground rests";
    }
  }
  // The sample states an error of 0.06 % for the third mode.
  const std::string sentence = held[1]["modes"][2]["say"];
  EXPECT_TRUE(says(sentence, "Mode 3 of the model \u201cbeam\u201d, 176.1 Hz \u00b10.060\u00a0%. 60 % "))
      << sentence;
}

TEST(ModelAnimation, WorksWithoutAScript)
{
  const std::string player = mode_player(data_of(sample::models_json()), {});
  EXPECT_TRUE(says(player, "<div class=\"controls\" hidden=\"\">")) << "dead controls are not shown";
  EXPECT_EQ(count(player, "<div class=\"mode-drawing\""), 3);
  EXPECT_EQ(count(player, "<div class=\"mode-drawing\" data-model=\"craig-bampton\">"), 1);
  EXPECT_EQ(count(player, "<div class=\"mode-drawing\" data-model=\"beam\" hidden=\"\">"), 1);
  EXPECT_GE(count(player, "class=\"ghost\""), 3 * 6)
      << "the other extreme: four rolls and the frames of every model";
  for (const char *control : {"<select", "<button type=\"button\"", "<input type=\"range\""})
    EXPECT_TRUE(says(player, control)) << control << " is reached by the keyboard";
}

// Every corner that the script moves names displacements that the mode holds.
TEST(ModelAnimation, CornersFollowStoredDisplacements)
{
  const std::string html  = page_of(sample::models_json());
  const ordered_json held = script_of(html);
  const auto drawings     = elements(without_scripts(html), "svg role=\"img\" aria-label=\"the stand in a mode");
  ASSERT_EQ(drawings.size(), 3u);
  const std::regex attribute("data-at=\"([^\"]*)\"");
  for (std::size_t m = 0; m < 3; ++m) {
    const int n = int(held[m]["modes"][0]["d"].size());
    int shapes  = 0;
    for (std::sregex_iterator it(drawings[m].begin(), drawings[m].end(), attribute), end; it != end;
         ++it, ++shapes) {
      std::istringstream corners((*it)[1]);
      for (std::string corner; corners >> corner;) {
        double x = 0, y = 0, share = 0;
        int k = -1, l = 0;
        const int read = std::sscanf(corner.c_str(), "%lf,%lf,%d,%d,%lf", &x, &y, &k, &l, &share);
        EXPECT_TRUE(read == 3 || read == 5) << corner;
        EXPECT_TRUE(k >= 0 && k < n && l >= 0 && l < n && share >= 0 && share <= 1) << corner;
      }
    }
    EXPECT_GT(shapes, 20);
  }
}

TEST(StandDrawing, RollsFollowTheirAxes)
{
  ComparedModel model;
  model.points = {"upper frame", "upper work roll", "cylinder", "an unknown place"};
  model.lines  = {{"upper backup roll", VectorXd::LinSpaced(12, 0, 1.65)}};
  ModelMode mode;
  mode.frequency = 10;
  mode.points.resize(4);
  mode.points << 0.5, -0.25, NAN, 0.75;
  mode.lines                 = {model.lines[0].z / 1.65};  // displacement grows along the axis
  const StandDrawing drawing = stand_drawing(model, {});
  const VectorXd d           = drawing.of(model, mode);
  EXPECT_EQ(d[0], 0);
  for (std::size_t i = 1; i < drawing.displacements.size(); ++i) {
    const Displacement &from = drawing.displacements[i];
    if (from.line == 0) {
      EXPECT_TRUE(near(d[Eigen::Index(i)], from.z / 1.65,
                       within(1e-12, "straight between stations of a straight line: rounding", 1)));
    } else if (from.point == 2) {
      EXPECT_EQ(d[Eigen::Index(i)], 0) << "what was not stored rests";
    } else if (from.point >= 0) {
      EXPECT_EQ(d[Eigen::Index(i)], mode.points[from.point]);
    }
  }
  EXPECT_TRUE(std::any_of(drawing.texts.begin(), drawing.texts.end(),
                          [](const FixedText &text) { return text.text == "an unknown place"; }));
  EXPECT_GT(drawing.height, 300);
}

TEST(StandDrawing, SwingIsUpwardsAndAsLargeAsAsked)
{
  const MovingShape shape{"", false, {{10, 50, 0}, {20, 50, 1}, {30, 50, 1, 2, 0.25}}};
  const auto points = moved(shape, Eigen::Vector3d(0, 1, -1), 8);
  EXPECT_EQ(points[0], Eigen::Vector2d(10, 50));
  EXPECT_EQ(points[1], Eigen::Vector2d(20, 42));
  EXPECT_EQ(points[2], Eigen::Vector2d(30, 46));  // 0.75 * 1 + 0.25 * -1 = 0.5
}

// 0.985 * 37.80 = 37.2; 38.92 / 37.233 - 1 = 4.5 %; 218.3 / 173.46 - 1 = 26 %.  Twelve modes, four with a partner.
TEST(ModelTables, VerdictHasOneRowPerMode)
{
  const ModelData data    = data_of(sample::models_json());
  const std::string table = verdict_table(data);
  for (const char *text :
       {"Craig-Bampton [Hz]", "<b>37.2</b>", "38.9 <span class=\"deviation\">(+4.5\u00a0%)</span>",
        "right to 4.5\u00a0%", "wrong by 26\u00a0%", "99\u00a0%"})
    EXPECT_TRUE(says(table, text)) << text << "\n" << table;
  EXPECT_EQ(count(table, "cannot be shown"), 8);
  EXPECT_EQ(count(table, "<tr>"), 13) << "1191.9 Hz is above the limit";
  EXPECT_TRUE(says(stray_sentence(data), "mode 5 (598.6\u00a0Hz) and mode 6 (748.4\u00a0Hz) look like no mode"));
  EXPECT_TRUE(says(model_table(data), "modes below 1000\u00a0Hz"));
}

TEST(ModelTables, PartnersAreFoundByLikeness)
{
  const MacTable mac = data_of(sample::models_json()).mac;
  EXPECT_EQ(mac_partner(mac, 3), 3);
  EXPECT_EQ(mac_partner(mac, 4), 4);
  EXPECT_EQ(mac_partner(mac, 0), 0);
  EXPECT_EQ(mac_partner(mac, 99), 0);
  MacTable unlike = mac;
  unlike.values.setConstant(0.4);
  EXPECT_EQ(mac_partner(unlike, 1), 0);
}

// Frequencies of the chain over the beams': +3.0, +2.8, +24, -14 %; over the solid rolls' 1.5 % more each.
TEST(ModelFigures, LadderJoinsPartnersByHowFarTheyAreApart)
{
  const std::string ladder = frequency_ladder(data_of(sample::models_json()), {{"pass 1", 700}, {"pass 2", 5000}});
  EXPECT_EQ(count(ladder, "<line class=\"join good\""), 2 + 1);  // one more of each in the key
  EXPECT_EQ(count(ladder, "<line class=\"join fair\""), 2 + 1);
  EXPECT_EQ(count(ladder, "<line class=\"join poor\""), 4 + 1);
  EXPECT_EQ(count(ladder, "class=\"step lone\""), 8 + 8 + 2 + 1);
  EXPECT_TRUE(says(ladder, "+24.0\u00a0%"));
  EXPECT_TRUE(says(ladder, "force of pass 1 to 700 Hz"));
  EXPECT_EQ(count(ladder, "reach-head"), 1) << "only the second goes beyond the picture";
  EXPECT_FALSE(says(ladder, "1210.0"));
}

TEST(ModelFigures, MassesChartNamesWhatIsAddedAndMissing)
{
  ordered_json json                       = sample::models_json();
  json["masses_needed"][0]["worst_error"] = nullptr;
  const std::string chart                 = masses_chart(data_of(json));
  for (const char *text : {"the places of the chain", "24 %", "0.81 %", "2 of 12", "12 of 12", ">none<",
                           "worst frequency error of the modes that are shown [%]", "more</text>"})
    EXPECT_TRUE(says(chart, text)) << text;
  EXPECT_EQ(count(chart, "class=\"dot warm\""), 1 + 4);  // key and the rows with missing modes and an error
  EXPECT_EQ(count(chart, "class=\"dot dark\""), 1 + 2);
}

TEST(ModelFigures, DrawsAssuranceMapAndConvergence)
{
  const ModelData data  = data_of(sample::models_json());
  const std::string map = mac_map(data);
  for (const char *text : {"Craig-Bampton, frequency [Hz]", "beam, frequency [Hz]", ">0.62<", ">0.36<", ">176.1<"})
    EXPECT_TRUE(says(map, text)) << text;
  EXPECT_EQ(count(map, "class=\"heat h7\""), 11 + 1);  // diagonal without the mixed pair, and the scale
  const std::string kept = kept_chart(data.kept_modes, 1000);
  for (const char *text : {"frequency error [%]", "modes kept of each part [-]", "lowest mode, 37.2 Hz"})
    EXPECT_TRUE(says(kept, text)) << text;
  EXPECT_EQ(kept_chart({}, 1000), "");
}

// White up to 1000 Hz: 99 % of the mean square lie below 990 Hz, to one line of the spectrum.
TEST(ModelFigures, ReachOfTheForceHas99PercentOfItsMeanSquare)
{
  report::Run run;
  run.manifest.passes = {{"pass 1", "pass-1", 1e6, true, ForceMeaning::measured},
                         {"pass 2", "pass-2", 1e6, true, ForceMeaning::measured}};
  const VectorXd f    = VectorXd::LinSpaced(2001, 0, 2000);
  Table table;
  table.add("frequency", "Hz", f);
  table.add("force", "N/sqrt(Hz)",
            f.unaryExpr([](const double position) { return position <= 1000 ? 20.0 : 0.0; }));
  run.tables["response/pass-1-spectrum"] = table;
  const auto reach                       = force_reach(run);
  ASSERT_EQ(reach.size(), 1u);
  EXPECT_EQ(reach[0].pass, "pass 1");
  EXPECT_TRUE(near(reach[0].frequency, 990, within(1.01 / 990, "99 % of 1000 Hz, on lines 1 Hz apart")));
}

TEST(MassSection, ShowsBarsAndEveryRoute)
{
  const std::string html = page_of(sample::models_json());
  for (const char *text : {"59\u202f725", "60\u202f322 <span class=\"deviation\">(+1.0\u00a0%)</span>",
                           "(\u22120.014\u00a0%)", "published [kg]", "75\u202f770", "balance gear", "mass [kg]"})
    EXPECT_TRUE(says(html, text)) << text;
  EXPECT_EQ(count(html, ">real mass<"), 3) << "once for every mass: the routes agree on it";
  ordered_json json = sample::models_json();
  for (auto &entry : json["breakdown"])
    if (entry["route"] == "finite elements" && entry["mass"] == "M2")
      entry["parts"][0]["mass"] = 18500;
  EXPECT_TRUE(says(page_of(json), ">real, finite elements<"));
}

TEST(ShapeSection, DrawsFiniteElementsWithTheClosedForm)
{
  const std::string run = write_sample_run();
  std::string html      = html_report(run);
  EXPECT_FALSE(says(html, "upper roll, finite elements")) << "an older folder has none";
  EXPECT_TRUE(says(html, "Backup roll and what holds it"));
  sample::write_fe_shapes(run);
  html = html_report(run);
  expect_sound(html, "shapes");
  for (const char *text : {"upper roll, finite elements", "contact line with the work roll", "strip width",
                           "springs of K3 or K5 over the barrel", "class=\"support\""})
    EXPECT_TRUE(says(html, text)) << text;
  // Both shapes bend 1.03 times as much in the sample.
  EXPECT_TRUE(says(html, "f2 3.0\u00a0%, f1 3.0\u00a0%"));
}

TEST(ModelReport, APageWithModelsIsSmall)
{
  // 2 MB is the limit of the whole page; three models with 32 modes are a small part of it.
  const std::string with    = html_report(sample::run_with_models(sample::models_json())),
                    without = html_report(write_sample_run());
  EXPECT_LT(with.size() - without.size(), 400e3);
}
