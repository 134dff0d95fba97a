#include "report/bite/figures.h"
#include "report/front/html.h"
#include "tests/support/near.h"
#include "tests/support/sample_csv.h"
#include "tests/support/sample_run.h"
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace mill;
using namespace mill::report;
using Eigen::VectorXd;
using nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {
// 8 -> 5 mm between rolls of 210 mm radius: the theory of Bland and Ford in closed form, times a factor.
constexpr double R = 0.21, h_e = 8e-3, h_d = 5e-3, mu = 0.2, k = 28e6;
const double arc = std::sqrt(R * (h_e - h_d));

double pressure_at(const double x)
{
  const auto H = [](const double position) {
    return 2 * std::sqrt(R / h_d) * std::atan(position / std::sqrt(R * h_d));
  };
  const double h = h_d + x * x / R;
  return k * std::min(h / h_e * std::exp(mu * (H(arc) - H(x))), h / h_d * std::exp(mu * H(x)));
}

constexpr double neutral = 8.7e-3;  // m

void write_arc(const fs::path &stem, const std::string &model, const double factor)
{
  const VectorXd x = VectorXd::LinSpaced(61, 0, arc), h = h_d + x.array().square() / R;
  const VectorXd p     = factor * x.unaryExpr(&pressure_at);
  const VectorXd shear = x.unaryExpr([](const double position) {
                            return std::clamp((position - neutral) / 5e-4, -1.0, 1.0);
                          }).cwiseProduct(mu * p);
  const double h_n     = h_d + neutral * neutral / R;
  sample::write_csv(stem.string() + "." + model + ".csv", sample::Csv()
                                                              .with("x [m]", x)
                                                              .with("thickness [m]", h)
                                                              .with("pressure [Pa]", p)
                                                              .with("shear [Pa]", shear)
                                                              .with("slip", h_n * h.cwiseInverse().array() - 1));
}

void write_roll(const fs::path &stem)
{
  const VectorXd x = VectorXd::LinSpaced(81, -0.03, 0.055);
  const VectorXd circle =
      x.unaryExpr([](const double position) { return h_d / 2 + R - std::sqrt(R * R - position * position); });
  const VectorXd dent =
      x.unaryExpr([](const double position) { return 9e-6 * std::pow((position - 0.01) / 0.03, 2); });
  const VectorXd strip = x.unaryExpr([](const double position) {
    return position < 0     ? h_d / 2
           : position > arc ? h_e / 2
                            : h_d / 2 + R - std::sqrt(R * R - position * position);
  });
  sample::write_csv(stem.string() + ".roll.csv", sample::Csv()
                                                     .with("x [m]", x)
                                                     .with("circle [m]", circle)
                                                     .with("roll [m]", circle + dent)
                                                     .with("strip [m]", strip));
}

constexpr int stations = 60, through = 9;

void write_field(const fs::path &stem)
{
  constexpr int n = stations * through;
  VectorXd x(n), y(n), strain(n), rate(n);
  for (int i = 0, row = 0; i < stations; ++i)
    for (int j = 0; j < through; ++j, ++row) {
      x[row]         = 0.035 - 0.05 * i / (stations - 1);
      const double s = std::clamp(x[row], 0.0, arc), h = h_d + s * s / R;
      y[row]      = 0.5 * h * j / (through - 1);
      strain[row] = 2 / std::sqrt(3.0) * std::log(h_e / h);
      rate[row]   = x[row] > 0 && x[row] < arc ? 100 * s / arc : 0;
    }
  sample::write_csv(stem.string() + ".field.csv", sample::Csv()
                                                      .with("x [m]", x)
                                                      .with("y [m]", y)
                                                      .with("strain", strain)
                                                      .with("strain_rate [1/s]", rate)
                                                      .with("pressure [Pa]", VectorXd::Constant(n, 3e7))
                                                      .with("velocity_x [m/s]", VectorXd::Constant(n, -1)));
}

void write_k4(const fs::path &curves, const std::string &input, const VectorXd &positions)
{
  const VectorXd slope     = (2e8 + 1e8 * positions.array() / positions.maxCoeff()).matrix();
  VectorXd fe              = VectorXd::Constant(positions.size(), NAN);
  fe[positions.size() / 2] = 0.97 * slope[positions.size() / 2];
  sample::write_csv(curves / ("bite-k4-" + input + ".csv"), sample::Csv()
                                                                .with(input + (input == "tension" ? " [Pa]"
                                                                               : input == "speed" ? " [m/s]"
                                                                                                  : ""),
                                                                      positions)
                                                                .with("plastic_slope [N/m]", slope)
                                                                .with("combined [N/m]", 0.995 * slope)
                                                                .with("force [N]", 4e-3 * slope)
                                                                .with("fe_plastic_slope [N/m]", fe)
                                                                .with("fe_force [N]", 4e-3 * fe));
}

ordered_json entry(const double value, const std::string &unit, const std::string &source)
{
  return {{"value", value},
          {"unit", unit},
          {"source", source},
          {"at", "pass 1, 8 -> 5 mm, 989.5 kN"},
          {"inputs", ordered_json::array({"strip.width"})}};
}

const std::vector<std::pair<std::string, double>> forces{
    {"karman", 995.0}, {"karman-rigid", 989.5},       {"orowan", 942.8}, {"bland-ford", 969.0},
    {"sims", 1228},    {"karman-elastic-arc", 996.0}, {"fe", 928.0}};

// The sample run of a stand with the bites of its two passes; the second with less.
std::string run_with_bites()
{
  const fs::path run = write_sample_run(), curves = run / "curves";
  std::ifstream in(run / "results.json");
  ordered_json json = ordered_json::parse(in);
  ordered_json &v   = json["values"];
  for (const std::string pass : {"pass 1", "pass 2"}) {
    const auto add = [&](const std::string &name, const double value, const std::string &unit,
                         const std::string &model = "") {
      v["bite." + pass + "." + (model.empty() ? "" : model + ".") + name] = entry(
          value, unit, "computed: " + (model.empty() ? std::string("finite elements") : model + " in words"));
    };
    add("force", 928e3, "N");
    add("torque", 11.3e3, "N m");
    add("forward_slip", 0.077, "1");
    add("friction", mu, "1");
    add("peak_pressure", 57e6, "Pa");
    add("flattened_radius", 0.2116, "m");
    for (const auto &[model, kN] : forces) {
      if (pass == "pass 2" && model != "fe")
        continue;
      add("force", 1e3 * kN, "N", model);
      add("torque", 12 * kN, "N m", model);
      add("forward_slip", 0.07, "1", model);
      add("neutral_angle", 0.041, "rad", model);
      add("flattened_radius", 0.2116, "m", model);
      add("plastic_slope", 0.25e6 * kN, "N/m", model);
    }
  }
  v["K4.plastic_slope"] = entry(2.32e8, "N/m", "computed: finite elements");
  v["K4.flattening"]    = entry(9.664e10, "N/m", "computed: closed form");
  v["K4.combined"]      = entry(2.31e8, "N/m", "computed: in series");
  v["K4.path_plateau"]  = entry(2.28e9, "N/m", "computed: path, 49 nodes");
  std::ofstream(run / "results.json") << json.dump(2);
  const fs::path stem = curves / "bite-pass-1";
  double factor       = 1;
  for (const auto &[model, kN] : forces)
    write_arc(stem, model, factor = kN / 963);
  write_arc(curves / "bite-pass-2", "fe", factor);
  write_roll(stem);
  write_field(stem);
  write_k4(curves, "reduction", VectorXd::LinSpaced(21, 0.15, 0.6));
  write_k4(curves, "tension", VectorXd::LinSpaced(21, 0, 14e6));
  write_k4(curves, "friction", VectorXd::LinSpaced(21, 0.1, 0.32));
  const VectorXd a = (VectorXd(6) << 0.4, 0.6, 1, 2, 4, 8).finished(),
                 f = (VectorXd(6) << 1.11, 0.95, 0.81, 0.87, 0.93, 0.99).finished();
  sample::write_csv(curves / "bite-aspect.csv", sample::Csv()
                                                    .with("arc_over_thickness", a)
                                                    .with("fe [N/m]", 1e6 * f)
                                                    .with("karman [N/m]", VectorXd::Constant(6, 1e6))
                                                    .with("orowan [N/m]", VectorXd::Constant(6, 0.95e6))
                                                    .with("ratio_karman", f)
                                                    .with("ratio_orowan", f / 0.95));
  return run.string();
}

bool says(const std::string &text, const std::string &what)
{
  return text.find(what) != std::string::npos;
}
int count(const std::string &text, const std::string &what)
{
  int n = 0;
  for (std::size_t position = text.find(what); position != std::string::npos;
       position             = text.find(what, position + 1))
    ++n;
  return n;
}
}  // namespace

TEST(BiteReport, ReadsPassesAndTheirModels)
{
  const report::Run run = read_run(run_with_bites());
  const auto passes     = bite_passes(run);
  ASSERT_EQ(passes.size(), 2u);
  EXPECT_EQ(passes[0].name, "pass 1");
  EXPECT_EQ(passes[0].slug, "pass-1");
  EXPECT_EQ(passes[0].models, (std::vector<std::string>{"fe", "karman-elastic-arc", "orowan", "karman",
                                                        "bland-ford", "sims", "karman-rigid"}));
  EXPECT_EQ(passes[1].models, std::vector<std::string>{"fe"});
  EXPECT_EQ(bite_value(run, passes[0], "force", "orowan"), 942.8e3);
  EXPECT_TRUE(std::isnan(bite_value(run, passes[0], "force", "unknown-model")));
  EXPECT_EQ(bite_model_name("unknown-model"), "unknown-model");
}

TEST(BiteReport, NeutralPointIsWhereTheSlipChangesSign)
{
  const report::Run run = read_run(run_with_bites());
  EXPECT_TRUE(near(neutral_point(*bite_table(run, bite_passes(run)[0], "fe")), neutral,
                   within(1e-5 / neutral, "chord of the slip over one spacing of the table")));
  Table arc;
  arc.add("x", "m", VectorXd::LinSpaced(5, 0, 4e-3));
  EXPECT_TRUE(std::isnan(neutral_point(arc)));
  Table sticking = arc, wavy = arc, dragged = arc;
  sticking.add("slip", "", (VectorXd(5) << 0.02, 0, 0, 0, -0.02).finished());
  wavy.add("slip", "", (VectorXd(5) << 0.02, -0.01, 0.01, -0.01, -0.02).finished());
  dragged.add("slip", "", (VectorXd(5) << -0.02, -0.03, -0.04, -0.05, -0.06).finished());
  EXPECT_DOUBLE_EQ(neutral_point(sticking), 2e-3);  // the middle of the zone without slip
  EXPECT_TRUE(std::isnan(neutral_point(wavy)));
  EXPECT_TRUE(std::isnan(neutral_point(dragged)));
}

TEST(BiteReport, SectionShowsEveryStoredPart)
{
  const std::string page = html_page(read_run(run_with_bites()));
  EXPECT_TRUE(says(page, "<details class=\"part\" id=\"bite\""));
  EXPECT_TRUE(says(page, "Bite of pass 1"));
  for (const char *title :
       {"Pressure on the roll", "Friction stress on the strip", "Slip of the strip on the roll",
        "How far the roll deflects", "Roll and strip", "Plastic strain", "Strain rate", "K4 over reduction",
        "K4 over tension", "K4 over friction", "Force over reduction",
        "Force of the finite elements over that of the slab theories"})
    EXPECT_TRUE(says(page, title)) << title;
  EXPECT_FALSE(says(page, "K4 over speed"));
  EXPECT_TRUE(says(page, "neutral point"));
  EXPECT_TRUE(says(page, "All passes, by the model that gives K4"));
}

TEST(BiteReport, ModelsAreComparedWithTheFiniteElements)
{
  const report::Run run   = read_run(run_with_bites());
  const std::string table = bite_model_table(run, bite_passes(run)[0]);
  EXPECT_EQ(count(table, "<tr>"), 8);  // head and seven models
  // 995 / 928 - 1 = 7.2 %
  EXPECT_TRUE(says(table, "995.0 <span class=\"deviation\">(+7.2\u00a0%)</span>")) << table;
  EXPECT_TRUE(says(table, "orowan in words"));
  EXPECT_EQ(bite_model_table(run, bite_passes(run)[1]), "");
}

// 989.5 rigid, + 5.5 flattening, - 52.2 inhomogeneity, - 14.8 the rest = 928.
TEST(BiteReport, StepsOfTheForceAddUpToTheForce)
{
  const report::Run run   = read_run(run_with_bites());
  const std::string table = bite_breakdown_table(run, bite_passes(run)[0]);
  for (const char *number : {"989.5", "+5.50", "995.0", "\u221252.2", "942.8", "\u221214.8", "928.0"})
    EXPECT_TRUE(says(table, number)) << number << "\n" << table;
  EXPECT_EQ(bite_breakdown_table(run, bite_passes(run)[1]), "");
}

TEST(BiteReport, ExplainsTheFourStiffnessesCalledK4)
{
  report::Run run        = read_run(run_with_bites());
  const std::string text = k4_relation(run);
  EXPECT_TRUE(says(text, "232.0\u00a0kN/mm")) << text;
  EXPECT_TRUE(says(text, "417 times as stiff")) << text;  // 9.664e10 / 2.32e8 = 416.6
  EXPECT_TRUE(says(text, "path plateau"));
  EXPECT_EQ(count(k4_table(run), "<code>K4."), 4);
  run.results.clear();
  EXPECT_EQ(k4_relation(run), "");
  EXPECT_EQ(k4_table(run), "");
}

// Every cell of the mesh is drawn, merged along the strip; a table that is not a grid draws nothing.
TEST(BiteReport, CellsOfTheFieldAreDrawnAtTheirPlace)
{
  const report::Run run   = read_run(run_with_bites());
  const Table *field      = bite_table(run, bite_passes(run)[0], "field");
  const std::string drawn = bite_field(*field, "strain");
  EXPECT_TRUE(says(drawn, "<polygon class=\"heat h7\""));
  EXPECT_GE(count(drawn, "<polygon"), through - 1);
  EXPECT_LE(count(drawn, "<polygon"), (through - 1) * (stations - 1));
  EXPECT_EQ(bite_field(*field, "temperature"), "");
  Table shorter = *field;
  for (VectorXd &column : shorter.columns)
    column.conservativeResize(column.size() - 1);
  EXPECT_EQ(bite_field(shorter, "strain"), "");
}

TEST(BiteReport, IsEmptyWithoutABite)
{
  const std::string page = html_page(read_run(write_sample_run()));
  EXPECT_FALSE(says(page, "Roll bite"));
}

TEST(BiteReport, APageWithBitesIsSmall)
{
  // 2 MB is the limit of the whole page; the bite's share with 540 field points is a small part of it.
  const std::string with    = html_page(read_run(run_with_bites())),
                    without = html_page(read_run(write_sample_run()));
  EXPECT_LT(with.size() - without.size(), 400e3);
}

TEST(BiteReport, NamesOfPassesAreEscapedOnce)
{
  const fs::path file = fs::path(run_with_bites()) / "results.json";
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  std::string json = text.str();
  for (std::size_t position; (position = json.find("bite.pass 1.")) != std::string::npos;)
    json.replace(position, 11, "bite.pass <1>");
  std::ofstream(file) << json;
  const std::string html = html_report(file.parent_path().string());
  EXPECT_NE(html.find("Bite of pass &lt;1&gt;</h3>"), std::string::npos);
  EXPECT_EQ(html.find("&amp;lt;"), std::string::npos);
}
