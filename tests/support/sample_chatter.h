#pragma once
#include "tests/support/sample_csv.h"
#include "tests/support/sample_run.h"
#include "tests/support/sample_values.h"
#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

// What a run stores about chatter, made of straight lines and sines: growth rate 1.5 1/s per m/s around a critical
// speed of 18 m/s that falls by 0.02 m/s per per cent of tension.  Nothing of it is computed by the product.
namespace sample {
using Eigen::VectorXd;
using nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr double chatter_speed = 18, chatter_hertz = 128, chatter_slope = 1.5;

inline void write_chatter_speed(const fs::path &stem)
{
  const VectorXd v = VectorXd::LinSpaced(57, 2, 30);
  VectorXd growth  = chatter_slope * (v.array() - chatter_speed);
  growth[0]        = NAN;  // no bite at the lowest speed
  VectorXd f       = VectorXd::Constant(57, chatter_hertz);
  f[0]             = NAN;
  write_csv(stem.string() + "-speed.csv", Csv()
                                              .with("speed [m/s]", v)
                                              .with("growth_rate [1/s]", growth)
                                              .with("frequency [Hz]", f)
                                              .with("force [kN]", (8000 + 9000 / v.array()).matrix())
                                              .with("friction [-]", (0.5 / v.array()).matrix())
                                              .with("film_thickness [um]", 0.05 * v)
                                              .with("process_damping [MN s/m]", v.array().log().matrix()));
  write_csv(stem.string() + "-locus.csv", Csv()
                                              .with("speed [m/s]", v)
                                              .with("mode1_growth [1/s]", VectorXd::Constant(57, -3))
                                              .with("mode1_frequency [Hz]", VectorXd::Constant(57, 81))
                                              .with("mode2_growth [1/s]", growth)
                                              .with("mode2_frequency [Hz]", f)
                                              .with("mode3_growth [1/s]", VectorXd::Constant(57, -1400))
                                              .with("mode3_frequency [Hz]", VectorXd::Constant(57, 555)));
}

/// Critical speed 20 - 0.02 t: 18 m/s at 100 % of the tension.  The slowest column has no bite.
inline double chatter_boundary(const double tension)
{
  return 20 - 0.02 * tension;
}

inline void write_chatter_map(const fs::path &stem, const std::string &quantity, const std::string &unit,
                              const double low, const double high)
{
  constexpr int n = 26, m = 11;
  const VectorXd v = VectorXd::LinSpaced(n, 5, 30), y = VectorXd::LinSpaced(m, low, high);
  VectorXd speed(n * m), other(n * m), growth(n * m), boundary(m);
  for (int j = 0; j < m; ++j) {
    boundary[j] = chatter_boundary(50 + 100. * j / (m - 1));
    for (int i = 0; i < n; ++i) {
      speed[j * n + i]  = v[i];
      other[j * n + i]  = y[j];
      growth[j * n + i] = i == 0 ? NAN : chatter_slope * (v[i] - boundary[j]);
    }
  }
  write_csv(stem.string() + "-map-" + quantity + ".csv", Csv()
                                                             .with("speed [m/s]", speed)
                                                             .with(quantity + " [" + unit + "]", other)
                                                             .with("growth_rate [1/s]", growth)
                                                             .with("frequency [Hz]", 0 * speed));
  boundary[m - 1] = NAN;
  write_csv(stem.string() + "-boundary-" + quantity + ".csv",
            Csv().with(quantity + " [" + unit + "]", y).with("critical_speed [m/s]", boundary));
}

/// A gap of 0.01 um that grows like exp(growth t); force against it, tensions behind it.
inline void write_chatter_history(const fs::path &file, const double growth, const double gap_mean,
                                  const double force_mean)
{
  constexpr int n     = 2001;
  const VectorXd t    = VectorXd::LinSpaced(n, 0, 0.2);
  const auto swinging = [&](const double size, const double degrees) {
    return VectorXd((size * (growth * t.array()).exp() *
                     (2 * 3.14159265358979 * chatter_hertz * t.array() + degrees * 3.14159265358979 / 180).cos())
                        .matrix());
  };
  write_csv(file, Csv()
                      .with("time [s]", t)
                      .with("gap [um]", (gap_mean + swinging(0.01, 0).array()).matrix())
                      .with("upper_work_roll [um]", swinging(0.001, 0))
                      .with("lower_work_roll [um]", -swinging(0.009, 0))
                      .with("force [kN]", (force_mean + swinging(0.3, 178).array()).matrix())
                      .with("entry_tension [MPa]", swinging(0.2, -61))
                      .with("exit_tension [MPa]", swinging(0.1, -93))
                      .with("friction [-]", swinging(1e-6, 180)));
}

inline ordered_json chatter_json(const std::string &name)
{
  ordered_json json{
      {"condition", name}, {"speed", 17.5}, {"reduction", 27.0}, {"viscosity", 5.0}, {"scheme", "sequential"}};
  json["critical"] = {{"verdict", "crossing"}, {"speed", 18.0},
                      {"frequency", 128.0},    {"growth_at_working_speed", -0.75},
                      {"searched", {1, 30}},   {"sentence", "stable below 18.00 m/s and unstable above <128 Hz>"}};
  for (const auto &[what, speed] : {std::pair("below", 17.8), {"at", 18.0}, {"above", 18.2}})
    json["histories"].push_back({{"file", "response/chatter-" + name + "-" + what},
                                 {"speed", speed},
                                 {"growth_rate", chatter_slope * (speed - 18)},
                                 {"measured_growth", chatter_slope * (speed - 18)}});
  json["limit_cycle"] = {{"speed", 19},
                         {"settled", true},
                         {"amplitude_um", 11.9},
                         {"frequency", 127.5},
                         {"limited_by", "the strip before the stand slack"}};
  for (int i = 0; i < 40; ++i)
    json["limit_cycle"]["events"].push_back(
        {{"time", 0.1 + i / 127.5}, {"what", i % 2 ? "entry strip taut" : "entry strip slack"}});
  json["phases"]   = {{"frequency", 128.0},     {"ratio", 0.015},        {"force", 178.3},
                      {"entry_tension", -60.7}, {"exit_tension", -93.1}, {"friction", 180.0}};
  double amplitude = 0.5;
  for (const char *body : {"upper housing", "upper backup roll", "upper work roll", "lower work roll",
                           "lower backup roll", "lower housing"})
    json["phases"]["shape"].push_back(
        {{"label", body}, {"amplitude", amplitude *= 1.1}, {"phase", std::string(body).size() > 15 ? 175 : 3}});
  const auto input = [&](const char *key, const char *words, const double friction, const double speed,
                         const ordered_json &minus, const ordered_json &plus, const bool curved) {
    json["sensitivities"].push_back(
        {{"key", key}, {"name", words}, {"friction", friction}, {"critical_speed", speed}, {"monotone", !curved}});
    ordered_json &last = json["sensitivities"].back();
    last["lowered"]    = {{"friction", -0.1 * friction}, {"critical_speed", minus}};
    last["raised"]     = {{"friction", 0.1 * friction}, {"critical_speed", plus}};
  };
  input("oil.viscosity", "viscosity of the oil", -1.1, -0.27, 0.029, -0.025, false);
  input("condition.entry_thickness", "entry thickness", 3.4, -0.17, 0.052, 0.001, true);
  input("stand.masses[4]", "lower backup roll, mass", 0, -0.27, nullptr, -0.03, false);
  const auto other = [&](const char *list, const char *called, const ordered_json &speed, const char *verdict) {
    json[list].push_back({{"name", called},
                          {"verdict", verdict},
                          {"critical_speed", speed},
                          {"frequency", speed.is_null() ? ordered_json() : ordered_json(128.0)},
                          {"growth_rate", -0.75},
                          {"ratio", 1.17},
                          {"force_phase", 166.6},
                          {"entry_tension_phase", -67.2},
                          {"upper_moves_more", true}});
  };
  other("schemes", "sequential", 18.0, "crossing");
  other("schemes", "consistent", 18.9, "crossing");
  other("schemes", "frozen-friction", 17.46, "crossing");
  other("variants", "D", 18.0, "crossing");
  other("variants", "B & more", 18.18, "crossing");
  other("structures", "six masses", 18.0, "crossing");
  other("structures", "beam", nullptr, "stable");
  json["conclusions"].push_back({{"text", "The critical speed"}, {"holds", true}, {"detail", "18.0 .. 18.2 m/s"}});
  json["conclusions"].push_back({{"text", "The chatter frequency"}, {"holds", false}, {"detail", "81 .. 132 Hz"}});
  json["published"].push_back({{"quantity", "critical speed"},
                               {"unit", "m/s"},
                               {"here", 18.0},
                               {"published", 18.9},
                               {"measured", 20.0},
                               {"note", "a <note>"}});
  return json;
}

inline ordered_json chatter_tandem_json()
{
  ordered_json json{{"stands", {"1", "2"}},
                    {"verdict", "crossing"},
                    {"critical_speed", 17.1},
                    {"frequency", 127.0},
                    {"without_delay", 17.442},
                    {"sentence", "stable below 17.10 m/s"},
                    {"sentences", ordered_json::array({"The delay costs 0.3 m/s."})}};
  for (const char *stand : {"1", "2"}) {
    json["single"].push_back({{"name", stand}, {"critical_speed", 18.0}});
    json["shape"].push_back(
        {{"label", std::string(stand) + ", upper work roll"}, {"amplitude", 1}, {"phase", -140}});
  }
  return json;
}

/// Everything that a run leaves about the conditions "2" (in full), "10" (tables only) and the tandem.
inline void write_chatter(const fs::path &run)
{
  const fs::path curves = run / "curves", response = run / "response", stem = curves / "chatter-2";
  write_chatter_speed(stem);
  write_chatter_map(stem, "reduction", "%", 13, 41);
  write_chatter_map(stem, "tension", "%", 50, 150);
  write_chatter_map(stem, "viscosity", "Pa s", 2.5e-3, 10e-3);
  write_chatter_history(response / "chatter-2-below.csv", -0.3, 0, 0);
  write_chatter_history(response / "chatter-2-at.csv", 0, 0, 0);
  write_chatter_history(response / "chatter-2-above.csv", 0.3, 0, 0);
  write_chatter_history(response / "chatter-2-limit-cycle.csv", 0, 577, 8700);
  std::ofstream(stem.string() + ".json") << chatter_json("2").dump(1);
  write_chatter_speed(curves / "chatter-10");
  write_chatter_map(curves / "chatter-10", "reduction", "%", 13, 41);
  const VectorXd v = VectorXd::LinSpaced(57, 2, 30);
  for (const char *file : {"chatter-tandem-speed.csv", "chatter-tandem-lobes.csv"})
    write_csv(curves / file, Csv()
                                 .with("speed [m/s]", v)
                                 .with("growth_rate [1/s]", v.array().sin().matrix())
                                 .with("growth_without_delay [1/s]", 0.1 * v)
                                 .with("growth_alone [1/s]", 0.09 * v)
                                 .with("frequency [Hz]", VectorXd::Constant(57, 127)));
  std::ofstream(curves / "chatter-tandem.json") << chatter_tandem_json().dump(1);
}

/// A run of kind "chatter" with results of condition "2".
inline std::string run_with_chatter()
{
  SampleRun kind;
  kind.kind          = "two-cylinders";
  const fs::path run = write_sample_run(kind);
  fs::remove_all(run / "curves");
  ordered_json results{{"case", "tandem"},
                       {"status", "ok"},
                       {"warnings", ordered_json::array()},
                       {"assumptions", ordered_json::array()}};
  ordered_json &v                          = results["values"];
  v["chatter.2.critical_speed"]            = value(18.0, "m/s", "computed: eigenvalues over speed");
  v["chatter.2.frequency"]                 = value(128.0, "Hz", "computed: eigenvalues over speed");
  v["chatter.2.growth_rate"]               = value(-0.75, "1/s", "computed: eigenvalues");
  v["chatter.2.variant.C.critical_speed"]  = value(18.18, "m/s", "computed: eigenvalues over speed");
  v["chatter.2.speed_slope.oil.viscosity"] = value(-0.27, "1", "computed: exact derivative");
  v["bite.2.force"]                        = value(8.7e6, "N", "computed: Bland and Ford");
  v["bite.2.friction"]                     = value(0.028, "1", "computed: film law");
  ordered_json manifest{
      {"program", "millstand"}, {"version", "0"}, {"kind", "chatter"}, {"title", "Tandem"}, {"run_id", "r1"}};
  std::ofstream(run / "results.json") << results.dump(1);
  std::ofstream(run / "run.json") << manifest.dump(1);
  write_chatter(run);
  return run.string();
}
}  // namespace sample
