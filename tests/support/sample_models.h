#pragma once
#include "tests/support/sample_csv.h"
#include "tests/support/sample_run.h"
#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// A comparison of three models as a run stores it, made of shapes drawn by hand: sines along the rolls, masses
// that take turns.  Nothing of it is computed by the product.
namespace sample {
using nlohmann::ordered_json;

/// Hz, of a stand as a chain of six masses and as a stand of beams.
inline const std::vector<double> chain_frequencies{38.92, 53.93, 218.3, 456.7, 598.6, 748.4};
inline const std::vector<double> beam_frequencies{37.80, 52.47, 176.1, 177.0, 257.1, 270.7, 372.9,
                                                  529.4, 547.1, 646.3, 865.5, 869.3, 1210.0};

inline const std::vector<std::string> chain_points{"upper frame",     "upper backup roll", "upper work roll",
                                                   "lower work roll", "lower backup roll", "lower frame"};
inline const std::vector<std::string> roll_names{"upper backup roll", "upper work roll", "lower work roll",
                                                 "lower backup roll"};

/// Numbers rounded as a file would hold them; largest size 1.
inline std::vector<double> scaled(std::vector<double> values)
{
  double largest = 0;
  for (const double value : values)
    largest = std::max(largest, std::abs(value));
  for (double &value : values)
    value = std::round(1e6 * value / largest) / 1e6;
  return values;
}

/// Shares that add up to 1, most of it on the entry `first`.
inline std::vector<double> shares(const std::size_t n, const std::size_t first)
{
  std::vector<double> all(n, 0.4 / double(n - 1));
  all[first % n] = 0.6;
  return all;
}

inline ordered_json chain_model()
{
  ordered_json model;
  model["name"]     = "six-mass";
  model["title"]    = "six masses";
  model["unknowns"] = 6;
  model["source"]   = "equivalent masses and springs";
  model["points"] = model["parts"] = chain_points;
  model["springs"]                 = {"K1", "K2", "K3", "K5", "K6", "K7"};
  model["lines"]                   = ordered_json::array();
  for (std::size_t i = 0; i < 6; ++i) {
    std::vector<double> y;
    for (int mass = 0; mass < 6; ++mass)
      y.push_back(std::cos(3.14159 * double(i) * (mass + 0.5) / 6));
    ordered_json mode;
    mode["frequency"]      = chain_frequencies[i];
    mode["error_estimate"] = nullptr;
    mode["in_chain"]       = nullptr;
    mode["points"]         = scaled(y);
    mode["kinetic"]        = shares(6, i);
    mode["strain"]         = shares(6, i + 1);
    mode["lines"]          = ordered_json::array();
    model["modes"].push_back(mode);
  }
  return model;
}

/// @param factor  on the frequencies
inline ordered_json roll_model(const std::string &name, const std::string &title, const double factor)
{
  ordered_json model;
  model["name"]     = name;
  model["title"]    = title;
  model["unknowns"] = name == "beam" ? 302 : 58;
  model["source"]   = name == "beam" ? "Timoshenko beams" : "finite elements, 4 components";
  model["points"]   = chain_points;
  for (const char *point : {"cylinder", "upper backup chock", "lower backup chock", "upper work-roll chock",
                            "lower work-roll chock", "upper work roll end"})
    model["points"].push_back(point);
  model["parts"] = chain_points;
  model["parts"].push_back("cylinder");
  model["springs"] = {"K1", "oil column", "cylinder body", "K3", "K5", "lower chock and K_Zy", "K7"};
  for (const std::string &roll : roll_names) {
    const double end = roll.find("backup") == std::string::npos ? 1.16 : 1.65;
    std::vector<double> z;
    for (int i = 0; i <= 30; ++i)
      z.push_back(end * i / 30);
    model["lines"].push_back({{"name", roll}, {"z", z}});
  }
  for (std::size_t m = 0; m < beam_frequencies.size(); ++m) {
    // Four rolls that take turns, bending more with every mode; the other places follow their neighbours.
    std::vector<double> base, all;
    for (int roll = 0; roll < 4; ++roll)
      base.push_back(std::cos(3.14159 * double(m) * (roll + 0.5) / 4));
    const double bend = 0.12 * double(m);
    std::vector<std::vector<double>> lines;
    for (const double middle : base) {
      lines.emplace_back();
      for (int i = 0; i <= 30; ++i)
        lines.back().push_back(middle * (1 - bend * std::pow(i / 30.0, 2)));
    }
    all            = {0.5 * base[0],
                      base[0],
                      base[1],
                      base[2],
                      base[3],
                      0.6 * base[3],
                      0.4 * base[0],
                      0.7 * base[0],
                      0.6 * base[3],
                      base[1] * (1 - 0.7 * bend),
                      base[2] * (1 - 0.7 * bend),
                      base[1] * (1 - bend)};
    double largest = 0;
    for (const double value : all)
      largest = std::max(largest, std::abs(value));
    for (auto &line : lines)
      for (double &value : line)
        value = std::round(1e6 * value / largest) / 1e6;
    ordered_json mode;
    mode["frequency"]      = factor * beam_frequencies[m];
    mode["error_estimate"] = 2e-4 * double(m + 1);
    mode["in_chain"]       = m < 2 ? 0.99 : std::max(0.02, 0.9 - 0.15 * double(m));
    mode["points"]         = scaled(all);
    mode["kinetic"]        = shares(7, m);
    mode["strain"]         = shares(7, m + 2);
    mode["lines"]          = lines;
    model["modes"].push_back(mode);
  }
  return model;
}

/// curves/models.json with everything a run can store.
inline ordered_json models_json()
{
  constexpr double soft = 0.985;  // the solid rolls over the beams
  ordered_json json;
  json["frequency_limit"] = 1000.0;
  json["at"]              = "976.2 kN";
  json["driven"]          = "six-mass";
  json["answer"]          = {"Six masses are enough below 60 Hz and not beyond.",
                             "They show 2 of the 12 modes below 1000 Hz within 3 %, and miss 8.",
                             "Eleven masses show every mode below 300 Hz within 5 %."};
  json["warnings"]        = {"pass 1: the force reaches 990 Hz; the chain shows no mode at 176.1 Hz"};
  json["models"]          = {chain_model(), roll_model("beam", "beam", 1),
                             roll_model("craig-bampton", "Craig-Bampton", soft)};
  const auto add_pair     = [&](const int mode, const int other, const double mac) {
    ordered_json pair{{"mode", mode}, {"six_mass", chain_frequencies[std::size_t(mode - 1)]}};
    if (other > 0) {
      const double f                    = beam_frequencies[std::size_t(other - 1)];
      pair["partners"]["beam"]          = {{"mode", other}, {"frequency", f}, {"mac", mac}};
      pair["partners"]["craig-bampton"] = {{"mode", other}, {"frequency", soft * f}, {"mac", mac - 0.01}};
    }
    json["pairs"].push_back(pair);
  };
  add_pair(1, 1, 0.995);
  add_pair(2, 2, 0.99);
  add_pair(3, 3, 0.72);
  add_pair(4, 8, 0.58);
  add_pair(5, 10, 0.31);
  add_pair(6, 0, 0);
  const int n = int(beam_frequencies.size());
  ordered_json values;
  std::vector<double> solid;
  for (int i = 0; i < n; ++i) {
    std::vector<double> row(std::size_t(n), 0.01);
    row[std::size_t(i)] = 0.97;
    if (i == 2 || i == 3) {  // two modes that lie close are mixed
      row[2] = i == 2 ? 0.62 : 0.35;
      row[3] = i == 2 ? 0.36 : 0.63;
    }
    values.push_back(row);
    solid.push_back(soft * beam_frequencies[std::size_t(i)]);
  }
  json["mac"]["rows"]             = "craig-bampton";
  json["mac"]["columns"]          = "beam";
  json["mac"]["row_frequency"]    = solid;
  json["mac"]["column_frequency"] = beam_frequencies;
  json["mac"]["values"]           = values;
  const auto add_count = [&](const int masses, const std::string &added, const double error, const int right,
                             const std::vector<double> &missing) {
    json["masses_needed"].push_back({{"masses", masses},
                                     {"added", added},
                                     {"worst_error", error},
                                     {"right", right},
                                     {"modes_below_limit", 12},
                                     {"missing", missing}});
  };
  add_count(2, "the stack and the upper frame", 0.41, 1,
            {176.1, 177, 257.1, 270.7, 372.9, 529.4, 547.1, 646.3, 865.5, 869.3});
  add_count(6, "the places of the chain", 0.24, 2, {176.1, 177, 257.1, 270.7, 372.9, 547.1, 646.3, 869.3});
  add_count(7, "cylinder", 0.31, 4, {176.1, 177, 372.9, 547.1, 869.3});
  add_count(8, "upper work roll end", 0.12, 7, {372.9, 547.1});
  add_count(9, "lower work roll end", 0.062, 9, {547.1});
  add_count(10, "upper backup chock", 0.034, 12, {});
  add_count(11, "quarter point of the upper work roll", 0.0081, 12, {});
  json["kept_modes"]["kept"]      = {0, 2, 4, 8, 16};
  json["kept_modes"]["frequency"] = std::vector<double>(solid.begin(), solid.begin() + 12);
  for (const double size : {3e-2, 6e-3, 1e-3, 1.2e-4, 9e-6}) {
    std::vector<double> row;
    for (int i = 0; i < 12; ++i)
      row.push_back(size * std::pow((i + 1) / 12.0, 2));
    json["kept_modes"]["error"].push_back(row);
  }
  const auto add_mass = [&](const std::string &mass, const std::string &route,
                            const std::vector<std::pair<std::string, std::array<double, 2>>> &parts) {
    ordered_json entry{{"mass", mass}, {"route", route}};
    for (const auto &[name, kg] : parts)
      entry["parts"].push_back({{"name", name}, {"mass", kg[0]}, {"equivalent", kg[1]}});
    json["breakdown"].push_back(entry);
  };
  for (const auto &[route, factor] : {std::pair{"chain", 1.0}, std::pair{"finite elements", 1.01}}) {
    add_mass("M2", route,
             {{"barrel", {17800, factor * 17100}},
              {"necks", {10370, factor * 9080}},
              {"cylinders", {14800, factor * 6900}},
              {"chocks", {21800, factor * 17700}},
              {"bearings", {3000, factor * 2640}},
              {"balance gear", {8000, factor * 6305}}});
    add_mass("M3", route, {{"barrel", {1493.5, factor * 1480}}, {"necks", {395, factor * 390}}});
  }
  add_mass("M1", "chain", {{"posts", {5200, 5200}}, {"beams", {2700, 2700}}, {"piston", {1420, 1420}}});
  const auto add_route = [&](const std::string &mass, const double closed, const double published) {
    ordered_json row{{"mass", mass},
                     {"chain", closed},
                     {"fe_integral", 1.01 * closed},
                     {"fe_solid", 1.012 * closed},
                     {"published", nullptr}};
    if (published > 0)
      row["published"] = published;
    json["routes"].push_back(row);
  };
  add_route("M2", 59725, 59716.884);
  add_route("M3", 1875.25, 1888.705);
  add_route("M4", 3069.21, 0);
  return json;
}

/// Adds shapes by finite elements to those that a sample run holds.
inline void write_fe_shapes(const std::filesystem::path &run)
{
  using Eigen::VectorXd;
  const auto write = [&](const std::string &roll, const std::string &symbol, const double end,
                         const double(&level)[2], const double size, const double width) {
    const VectorXd x = VectorXd::LinSpaced(61, 0, end);
    const VectorXd w = size * (-(x.array() / width).square()).exp().matrix();
    Csv csv          = Csv().with("x [m]", x);
    for (const std::string kind : {"", "_fe"})
      for (const int side : {0, 1})
        csv.with(symbol + (side ? "_lower" : "_upper") + kind + " [m/N]",
                 ((kind.empty() ? 1 : 1.004) * level[side] + (kind.empty() ? 1 : 1.03) * w.array()).matrix());
    write_csv(run / "curves" / ("shape-" + roll + ".csv"), csv);
  };
  write("backup-roll", "f2", 1.65, {2.414e-10, 1.648e-10}, 1.468e-11, 1.0);
  write("work-roll", "f1", 1.16, {2.5e-10, 1.73e-10}, 3.13e-11, 0.7);
}

/// A sample run of a stand with this comparison of models.
inline std::string run_with_models(const ordered_json &models)
{
  const std::string run = write_sample_run();
  std::ofstream(std::filesystem::path(run) / "curves" / "models.json") << models.dump(1);
  return run;
}
}  // namespace sample
