#include "tests/support/sample_run.h"
#include "tests/support/reference.h"
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <vector>

namespace
{
using Eigen::MatrixXd;
using Eigen::VectorXd;
using nlohmann::ordered_json;
namespace fs         = std::filesystem;
constexpr double pi  = EIGEN_PI;
constexpr double E   = 210e9, nu = 0.28, D1 = 0.42, D2 = 1.45, L = 1.4;  // demo stand
constexpr double A   = 2 * (1 - nu * nu) / (pi * E);
constexpr double fs_out = 20e3;  // Hz

struct CsvColumn {
  std::string header;
  VectorXd values;
};

void write_csv(const fs::path &path, const std::vector<CsvColumn> &columns)
{
  fs::create_directories(path.parent_path());
  std::ofstream file(path);
  file.precision(9);
  for (std::size_t c = 0; c < columns.size(); ++c)
    file << (c ? ", " : "") << columns[c].header;
  file << '\n';
  for (Eigen::Index r = 0; r < columns[0].values.size(); ++r)
    for (std::size_t c = 0; c < columns.size(); ++c)
      file << (c ? "," : "") << columns[c].values[r] << (c + 1 == columns.size() ? "\n" : "");
}

VectorXd per_load(const VectorXd &load, double (*law)(double))
{
  return load.unaryExpr([law](const double F) { return law(F); });
}

double half_width(const double F)
{
  const double R = D1 * D2 / (2 * (D1 + D2));
  return std::sqrt(4 * (F / L) * R * 2 * (1 - nu * nu) / (pi * E));
}
double logarithm(const double F)
{
  return std::log(4 * D1 * D2 / (half_width(F) * half_width(F)));
}
double approach(const double F)
{
  return A * F / L * (logarithm(F) - 1);
}
double hertz_secant(const double F)
{
  return L / (A * (logarithm(F) - 1));
}
double hertz_tangent(const double F)
{
  return L / (A * (logarithm(F) - 2));
}
double foeppl_secant(const double F)
{
  const double b = 2 * half_width(F);
  return L / (A * (2.0 / 3 + std::log(2 * D1 / b) + std::log(2 * D2 / b)));
}
double half_space_secant(const double F)
{
  return L / (A * std::log(4 * D1 * L / (half_width(F) * half_width(F))));
}
double palmgren_secant(const double F)
{
  return F / (3.84e-5 * std::pow(F, 0.9) / std::pow(1e3 * L, 0.8) * 1e-3);
}
double peak_pressure(const double F)
{
  return 2 * F / L / (pi * half_width(F));
}

// A finite-length contact, 2 % softer than the plane-strain form.
void write_contact(const fs::path &curves, const std::string &name, const bool barrel)
{
  constexpr double soft  = 1.02;
  const VectorXd load    = VectorXd::LinSpaced(24, std::log(1e5), std::log(2e6)).array().exp();
  const VectorXd secant  = per_load(load, hertz_secant) / soft;
  write_csv(curves / ("contact-" + name + ".csv"),
            {{"load [N]", load},
             {"approach [m]", load.cwiseQuotient(secant)},
             {"half_width [m]", per_load(load, half_width)},
             {"peak_pressure [Pa]", per_load(load, peak_pressure)},
             {"tangent [N/m]", per_load(load, hertz_tangent) / soft},
             {"secant [N/m]", secant},
             {"iterations []", VectorXd::Constant(24, 5)}});
  write_csv(curves / ("contact-" + name + "-closed.csv"), {{"load [N]", load},
                                                           {"hertz_secant [N/m]", per_load(load, hertz_secant)},
                                                           {"hertz_tangent [N/m]", per_load(load, hertz_tangent)},
                                                           {"foeppl_secant [N/m]", per_load(load, foeppl_secant)},
                                                           {"half_space_secant [N/m]", per_load(load, half_space_secant)},
                                                           {"palmgren_secant [N/m]", per_load(load, palmgren_secant)}});
  if (!barrel)
    return;
  const VectorXd z    = VectorXd::LinSpaced(36, 0, L / 2);
  const VectorXd edge = z.unaryExpr([](const double s) { return 1 + 0.12 * std::exp(-(L / 2 - s) / 0.05); });
  constexpr double F  = 976217.5;
  write_csv(curves / ("contact-" + name + "-barrel.csv"),
            {{"z [m]", z},
             {"line_load [N/m]", F / L * edge},
             {"approach [m]", VectorXd::Constant(36, approach(F))},
             {"tangent [N/m2]", hertz_tangent(F) / L * edge.cwiseInverse()},
             {"half_width [m]", half_width(F) * edge.cwiseSqrt()},
             {"peak_pressure [Pa]", peak_pressure(F) * edge.cwiseSqrt()}});
}

void write_bearing(const fs::path &curves, const std::string &name, const double stiffness, const int rollers,
                   const double tilt)
{
  const VectorXd load   = VectorXd::LinSpaced(20, std::log(1e4), std::log(1e6)).array().exp();
  const VectorXd secant = stiffness * (load / 1e5).array().pow(0.1);
  write_csv(curves / ("bearing-" + name + ".csv"), {{"load [N]", load},
                                                    {"displacement [m]", load.cwiseQuotient(secant)},
                                                    {"secant [N/m]", secant},
                                                    {"tangent [N/m]", 10.0 / 9 * secant},
                                                    {"loaded_rollers []", VectorXd::Constant(20, rollers / 2)}});
  const VectorXd row = VectorXd::LinSpaced(4, 1, 4);
  const VectorXd share = 0.25 + tilt * (row.array() - 2.5);
  write_csv(curves / ("bearing-" + name + "-rows.csv"), {{"row []", row}, {"share []", share}});
  const VectorXd angle = VectorXd::LinSpaced(rollers, 0, 2 * pi * (rollers - 1) / rollers);
  const VectorXd arc   = angle.unaryExpr([](const double a) { return std::pow(std::max(0.0, std::cos(a)), 10.0 / 9); });
  std::vector<CsvColumn> columns{{"angle [rad]", angle}};
  for (int i = 0; i < 4; ++i)
    columns.push_back({"row" + std::to_string(i + 1) + " [N]", 4 * 4.08 * 48810.0 * share[i] / (4 * rollers) * arc});
  write_csv(curves / ("bearing-" + name + "-rollers.csv"), columns);
}

void write_shapes(const fs::path &curves)
{
  const VectorXd x = VectorXd::LinSpaced(61, 0, 1.225);
  const VectorXd w = x.unaryExpr([](const double s) { return 1.468e-11 * (1 - std::pow(s / 1.225, 2)); });
  write_csv(curves / "shape-backup-roll.csv",
            {{"x [m]", x}, {"f2_upper [m/N]", (2.414e-10 + w.array()).matrix()}, {"f2_lower [m/N]", (1.648e-10 + w.array()).matrix()}});
  const VectorXd xw = VectorXd::LinSpaced(61, 0, 1.16);
  const VectorXd f  = xw.unaryExpr([](const double s) { return 3.13e-11 * std::exp(-std::pow(s / 0.7, 2)); });
  write_csv(curves / "shape-work-roll.csv",
            {{"x [m]", xw}, {"f1_upper [m/N]", (2.5e-10 + f.array()).matrix()}, {"f1_lower [m/N]", (1.73e-10 + f.array()).matrix()}});
}

struct Chain {
  VectorXd M = VectorXd(6), K = VectorXd(7);
  MatrixXd stiffness = MatrixXd::Zero(6, 6);
  VectorXd omega;
  MatrixXd shapes;  // M-normalised columns
};

Chain chain_of()
{
  Chain chain;
  chain.M << 9320, 59725.0, 1875.25, 3069.21, 42315.97, 4660;
  chain.K << 6.31412e9, 1.02333e10, 4.0192e10, 0, 4.0192e10, 2.92702e10, 6.88067e9;
  for (int i = 0; i < 6; ++i) {
    chain.stiffness(i, i) = chain.K[i] + chain.K[i + 1];
    if (i < 5)
      chain.stiffness(i, i + 1) = chain.stiffness(i + 1, i) = -chain.K[i + 1];
  }
  const MatrixXd mass = chain.M.asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solved(chain.stiffness, mass);
  chain.omega  = solved.eigenvalues().cwiseSqrt();
  chain.shapes = solved.eigenvectors();
  return chain;
}

void write_modes(const fs::path &curves, const Chain &chain)
{
  std::vector<CsvColumn> columns{{"mode []", VectorXd::LinSpaced(6, 1, 6)},
                                 {"frequency [Hz]", chain.omega / (2 * pi)},
                                 {"damping []", VectorXd::Constant(6, 0.01)}};
  MatrixXd y = chain.shapes;
  for (int mode = 0; mode < 6; ++mode) {
    Eigen::Index largest;
    y.col(mode).cwiseAbs().maxCoeff(&largest);
    y.col(mode) /= y(largest, mode);
  }
  for (int mass = 0; mass < 6; ++mass)
    columns.push_back({"y" + std::to_string(mass + 1) + " []", y.row(mass).transpose()});
  MatrixXd energy(6, 7);
  for (int mode = 0; mode < 6; ++mode) {
    for (int spring = 0; spring < 7; ++spring) {
      const double stretch  = (spring < 6 ? y(spring, mode) : 0) - (spring > 0 ? y(spring - 1, mode) : 0);
      energy(mode, spring)  = chain.K[spring] * stretch * stretch;
    }
    energy.row(mode) /= energy.row(mode).sum();
  }
  for (int spring = 0; spring < 7; ++spring)
    columns.push_back({"energy_K" + std::to_string(spring + 1) + " []", energy.col(spring)});
  write_csv(curves / "modes.csv", columns);
  write_csv(curves / "modes-horizontal.csv", {{"mode []", VectorXd::LinSpaced(4, 1, 4)},
                                              {"frequency [Hz]", Eigen::Vector4d(130.6, 155.3, 573.6, 734.3)},
                                              {"upper_backup []", Eigen::Vector4d(1, 0, 0, 0)},
                                              {"lower_backup []", Eigen::Vector4d(0, 1, 0, 0)},
                                              {"lower_work []", Eigen::Vector4d(0, 0, 1, 0)},
                                              {"upper_work []", Eigen::Vector4d(0, 0, 0, 1)}});
}

// Mode by mode with the recurrence of a damped oscillator: good enough for a picture.
void write_response(const fs::path &run, const std::string &slug, const Chain &chain, const double mean,
                    const double range, const SampleRun &sample, const unsigned seed)
{
  const int n = sample.samples;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  VectorXd force(n);
  double s1 = 0, s2 = 0;
  for (int i = 0; i < n; ++i) {  // two first-order low passes, 1 kHz
    s1 += 0.27 * (normal(random) - s1);
    s2 += 0.27 * (s1 - s2);
    force[i] = s2;
  }
  force = mean + range * ((force.array() - force.minCoeff()) / (force.maxCoeff() - force.minCoeff()) - 0.5);
  MatrixXd acceleration = MatrixXd::Zero(n, 6);
  for (int mode = 0; mode < 6; ++mode) {
    const double w = chain.omega[mode], zeta = 0.01, h = 1 / fs_out;
    const double push = chain.shapes(2, mode) - chain.shapes(3, mode);
    double q = 0, v = 0;
    for (int i = 0; i < n; ++i) {
      const double a = push * (force[i] - mean) - 2 * zeta * w * v - w * w * q;
      v += h * a;  // semi-implicit Euler, stable for w h < 2
      q += h * v;
      acceleration.row(i) += a * chain.shapes.col(mode).transpose();
    }
  }
  acceleration /= 9.80665;
  acceleration(sample_spike(sample), 2) = 9.5;
  const VectorXd time = VectorXd::LinSpaced(n, 0, (n - 1) / fs_out);
  write_csv(run / "response" / (slug + ".csv"), {{"time [s]", time},
                                                 {"force [kN]", force * 1e-3},
                                                 {"upper_work_roll [g]", acceleration.col(2)},
                                                 {"lower_work_roll [g]", acceleration.col(3)},
                                                 {"load_cell [kN]", force * 1e-3}});
  const VectorXd f = VectorXd::LinSpaced(2000, 1, 2000);
  std::vector<CsvColumn> spectra{{"frequency [Hz]", f}, {"force [N/sqrt(Hz)]", VectorXd(2000)},
                                 {"upper_work_roll [g/sqrt(Hz)]", VectorXd(2000)}, {"lower_work_roll [g/sqrt(Hz)]", VectorXd(2000)}};
  for (int i = 0; i < 2000; ++i) {
    const double w      = 2 * pi * f[i];
    const double input  = 20 / (1 + std::pow(f[i] / 1000, 4));
    spectra[1].values[i] = input;
    for (int roll = 0; roll < 2; ++roll) {
      std::complex<double> sum = 0;
      for (int mode = 0; mode < 6; ++mode)
        sum += chain.shapes(2 + roll, mode) * (chain.shapes(2, mode) - chain.shapes(3, mode)) * -w * w /
               std::complex<double>(chain.omega[mode] * chain.omega[mode] - w * w, 0.02 * chain.omega[mode] * w);
      spectra[std::size_t(2 + roll)].values[i] = std::abs(sum) * input / 9.80665;
    }
  }
  write_csv(run / "response" / (slug + "-spectrum.csv"), spectra);
}

ordered_json value(const double number, const std::string &unit, const std::string &source, const std::string &at = "",
                   const double error = NAN, const std::vector<std::string> &inputs = {},
                   const std::vector<std::array<std::string, 2>> &checks = {}, const std::vector<double> &check_values = {})
{
  ordered_json json{{"value", number}, {"unit", unit}, {"source", source}};
  if (!at.empty())
    json["at"] = at;
  json["error_estimate"] = error;
  json["inputs"]         = inputs;
  for (std::size_t i = 0; i < checks.size(); ++i)
    json["checks"].push_back({{"name", checks[i][0]}, {"value", check_values[i]}, {"note", checks[i][1]}});
  return json;
}

ordered_json chain_results(const Chain &chain)
{
  ordered_json v;
  constexpr double F = 976217.5;
  const std::vector<std::string> rolls{"work_roll.barrel_diameter", "backup_roll.barrel_diameter", "steel.youngs_modulus"};
  const double published[] = {6.3086e9, 1.0233e10, 7.53399e11, 1.91141e11, 6.58293e11, 2.9301e10, 6.8789e9};
  for (int i = 1; i <= 7; ++i) {
    const std::string name = "K" + std::to_string(i);
    if (i == 3 || i == 5) {
      const double K = hertz_tangent(F) / 1.02;
      v[name + ".tangent"] = value(K, "N/m", "computed: contact FEM", "976.2 kN", 0.004, rolls,
                                   {{"Hertz line contact, axis to axis", "plane strain; the barrel ends are not in it"},
                                    {"published", "no line contact of solid rolls reaches it"}},
                                   {hertz_tangent(F), published[i - 1]});
      v[name + ".secant"] = value(hertz_secant(F) / 1.02, "N/m", "computed: contact FEM", "976.2 kN", 0.004, rolls,
                                  {{"F\u00f6ppl", ""}, {"half space", ""}}, {foeppl_secant(F), half_space_secant(F)});
    } else if (i == 4) {
      v["K4.plastic_slope"] = value(2.1e8, "N/m", "computed: slab model", "976.2 kN", 0.02, {"strip.flow_stress"});
      v["K4"]               = value(0, "N/m", "assumed: measured force holds the reaction of K4", "976.2 kN");
    } else
      v[name] = value(chain.K[i - 1], "N/m", "computed: series springs", "976.2 kN", NAN, {"frame.upper_post_stiffness"},
                      {{"published", ""}}, {published[i - 1]});
  }
  for (int i = 1; i <= 4; ++i) {
    const bool work = i == 2 || i == 3;
    v["Kzc" + std::to_string(i) + ".tangent"] =
      value(work ? 1.669e10 : 5.114e10, "N/m", "computed: roller law, rigid rings", work ? "48.81 kN" : "488.1 kN", 0.03,
            {work ? "bearing.trb.rollers_per_row" : "bearing.crb.rollers_per_row"}, {{"Palmgren", "3.3 % apart at fixed load"}},
            {work ? 1.72e10 : 5.28e10});
  }
  v["Kzc2.row1_share"] = value(0.27, "1", "computed: roller law, rigid rings", "48.81 kN");
  const double masses[] = {9321.943, 59716.884, 1888.705, 3094.684, 42200.563, 4663.29};
  for (int i = 0; i < 6; ++i)
    v["M" + std::to_string(i + 1)] = value(chain.M[i], "kg", "computed: shape integrals", "976.2 kN", 0.002,
                                           {"work_roll.neck_diameter"}, {{"published", ""}}, {masses[i]});
  for (int i = 0; i < 6; ++i)
    v["f" + std::to_string(i + 1)] = value(chain.omega[i] / (2 * pi), "Hz", "computed: eigenvalues", "976.2 kN", 0.03);
  return v;
}

void add_peaks(ordered_json &v)
{
  const double peaks[2][2] = {{1.23, 0.66}, {1.58, 0.85}}, model[2][2] = {{1.40, 0.75}, {1.60, 1.30}},
               measured[2][2] = {{1.20, 0.60}, {1.50, 0.90}};
  for (int pass = 0; pass < 2; ++pass)
    for (int roll = 0; roll < 2; ++roll) {
      const std::string end = roll ? "lower_work_roll" : "upper_work_roll", name = "pass " + std::to_string(pass + 1);
      v[name + ".peak_g." + end] = value(9.80665 * peaks[pass][roll], "m/s2", "computed: exact first-order hold", "", NAN,
                                         {"dynamics.modal_damping"}, {{"published model", ""}, {"measured", "one pass"}},
                                         {9.80665 * model[pass][roll], 9.80665 * measured[pass][roll]});
      v[name + ".rms_g." + end]  = value(9.80665 * peaks[pass][roll] / 3.6, "m/s2", "computed: exact first-order hold");
    }
}

ordered_json manifest(const SampleRun &sample, const std::string &name)
{
  ordered_json run{{"program", "millstand"}, {"version", "0.1.0"}, {"case", name}, {"case_path", "cases/" + name + ".toml"},
                   {"kind", sample.kind}, {"title", sample.title}, {"run_id", "7c41d09e"}, {"date", "2024-05-14 09:32"},
                   {"hostname", "mill-office"}, {"blas", "OpenBLAS 0.3.21, openmp"}, {"threads", 2}, {"peak_memory", 3.2e9}};
  run["versions"] = {{"Eigen", "3.4.0"}, {"deal.II", "9.4.1"}, {"Gmsh", "4.8.4"}};
  run["timings"]  = {{{"stage", "contact upper"}, {"seconds", 21.4}, {"cached", false}},
                     {{"stage", "contact lower"}, {"seconds", 0.1}, {"cached", true}},
                     {{"stage", "response"}, {"seconds", 0.16}, {"cached", false}}};
  if (sample.kind == "four-high")
    run["geometry"] = {{"work_roll_diameter", 0.42}, {"work_roll_length", 1.4}, {"work_neck_diameter", 0.2667},
                       {"work_total_length", 2.32}, {"work_bearing_span", 2.0}, {"backup_diameter", 1.45},
                       {"backup_length", 1.4}, {"backup_neck_diameter", 0.95}, {"backup_neck_length", 0.95},
                       {"backup_bearing_span", 2.45}, {"strip_width", 1.0}, {"entry_thickness", 8e-3}, {"exit_thickness", 5e-3}};
  run["passes"] = ordered_json::array();
  if (sample.kind != "two-cylinders")
    for (int i = 1; i <= 2; ++i)
      run["passes"].push_back({{"name", "pass " + std::to_string(i)}, {"slug", "pass-" + std::to_string(i)},
                               {"load", i == 1 ? 976217.5 : 737992.5}, {"synthetic", true}, {"force_meaning", "measured"}});
  return run;
}

ordered_json two_cylinder_results()
{
  ordered_json v;
  constexpr double F = 976217.5;
  v["contact.line.half_width"]    = value(half_width(F), "m", "computed: contact FEM", "976.2 kN", 0.004, {"upper.diameter"}, {{"Hertz", ""}}, {half_width(F)});
  v["contact.line.peak_pressure"] = value(peak_pressure(F), "Pa", "computed: contact FEM", "976.2 kN", 0.004, {"upper.diameter"}, {{"Hertz", ""}}, {peak_pressure(F)});
  v["contact.line.approach"]      = value(1.02 * approach(F), "m", "computed: contact FEM", "976.2 kN", 0.004, {"upper.diameter"}, {{"Johnson", ""}}, {approach(F)});
  v["contact.line.tangent"]       = value(hertz_tangent(F) / L, "N/m2", "computed: contact FEM", "976.2 kN", 0.004, {"upper.diameter"});
  v["contact.line.secant"]        = value(hertz_secant(F) / L, "N/m2", "computed: contact FEM", "976.2 kN", 0.004, {"upper.diameter"});
  return v;
}

fs::path new_directory()
{
  std::string pattern = (fs::temp_directory_path() / "sample-run-XXXXXX").string();
  return mkdtemp(pattern.data());
}
} // namespace

int sample_spike(const SampleRun &sample)
{
  return sample.samples * 2 / 3;
}

std::string write_sample_run(const SampleRun &sample)
{
  const fs::path run     = new_directory();
  const fs::path curves  = run / "curves";
  const std::string name = sample.kind == "four-high" ? "four-high-1400" : sample.kind == "lumped" ? "published-1400" : "two-cylinders";
  const Chain chain      = chain_of();
  ordered_json results{{"schema", 1}, {"case", name}, {"status", "ok"}};
  results["values"] = sample.kind == "two-cylinders" ? two_cylinder_results() : chain_results(chain);
  if (sample.kind == "two-cylinders")
    write_contact(curves, "line", false);
  else {
    add_peaks(results["values"]);
    write_modes(curves, chain);
    write_response(run, "pass-1", chain, 976217.5, 6639, sample, 1);
    write_response(run, "pass-2", chain, 737992.5, 8575, sample, 2);
  }
  if (sample.kind == "four-high") {
    write_contact(curves, "upper", true);
    write_contact(curves, "lower", true);
    write_bearing(curves, "trb", 1.614e10, 39, 0.02);
    write_bearing(curves, "crb", 4.3e10, 32, 0);
    write_shapes(curves);
  }
  results["warnings"] = ordered_json::array();
  if (sample.warnings)
    results["warnings"].push_back("pass 1: the force record ends at 1000 Hz, 30 % above the highest mode; a faster record would show more");
  results["assumptions"] = {"work-roll bearings carry F/20 each", "every mode has 1 % of critical damping"};
  std::ofstream(run / "results.json") << results.dump(2);
  std::ofstream(run / "run.json") << manifest(sample, name).dump(2);
  return run.string();
}
