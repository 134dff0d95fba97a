#include "tests/support/sample_run.h"
#include "tests/support/sample_bearing.h"
#include "tests/support/sample_csv.h"
#include "tests/support/sample_line_contact.h"
#include "tests/support/sample_results.h"
#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <vector>

namespace {
using Eigen::MatrixXd;
using Eigen::VectorXd;
using namespace sample;
namespace fs            = std::filesystem;
constexpr double fs_out = 20e3;  // Hz

VectorXd per_load(const VectorXd &load, double (*law)(double))
{
  return load.unaryExpr([law](const double F) { return law(F); });
}

// A finite-length contact, 2 % softer than the plane-strain form.
void write_contact(const fs::path &curves, const std::string &name, const bool barrel)
{
  const VectorXd load   = VectorXd::LinSpaced(24, std::log(1e5), std::log(2e6)).array().exp();
  const VectorXd secant = per_load(load, hertz_secant) / softer;
  // Cylinders in plane strain are stored per length, which their units say.
  const double length   = barrel ? 1 : L;
  const std::string per = barrel ? "" : "/m", squared = barrel ? "" : "2";
  const auto curve = [&](const std::string &kind, const double factor) {
    write_csv(curves / ("contact-" + name + kind + ".csv"),
              Csv()
                  .with("load [N" + per + "]", load / length)
                  .with("approach [m]", factor * load.cwiseQuotient(secant))
                  .with("half_width [m]", per_load(load, half_width))
                  .with("peak_pressure [Pa]", per_load(load, peak_pressure))
                  .with("tangent [N/m" + squared + "]", per_load(load, hertz_tangent) / (factor * softer * length))
                  .with("secant [N/m" + squared + "]", secant / (factor * length))
                  .with("iterations []", VectorXd::Constant(24, 5)));
  };
  curve("", 1);
  if (barrel)
    curve("-in-stand", 1.15);
  write_csv(curves / ("contact-" + name + "-closed.csv"),
            Csv()
                .with("load [N" + per + "]", load / length)
                .with("hertz_secant [N/m" + squared + "]", per_load(load, hertz_secant) / length)
                .with("hertz_tangent [N/m" + squared + "]", per_load(load, hertz_tangent) / length)
                .with("foeppl_secant [N/m" + squared + "]", per_load(load, foeppl_secant) / length)
                .with("half_space_secant [N/m" + squared + "]", per_load(load, half_space_secant) / length)
                .with("palmgren_secant [N/m" + squared + "]", per_load(load, palmgren_secant) / length));
  if (!barrel)
    return;
  const VectorXd z    = VectorXd::LinSpaced(36, 0, L / 2);
  const VectorXd edge = z.unaryExpr([](const double s) { return 1 + 0.12 * std::exp(-(L / 2 - s) / 0.05); });
  constexpr double F  = working_load;
  for (const std::string kind : {"-barrel", "-barrel-mirrored"})
    write_csv(curves / ("contact-" + name + kind + ".csv"),
              Csv()
                  .with("z [m]", z)
                  .with("line_load [N/m]", F / L * edge)
                  .with("approach [m]", VectorXd::Constant(36, approach(F)))
                  .with("tangent [N/m2]", hertz_tangent(F) / L * edge.cwiseInverse())
                  .with("half_width [m]", half_width(F) * edge.cwiseSqrt())
                  .with("peak_pressure [Pa]", peak_pressure(F) * edge.cwiseSqrt()));
}

void write_shapes(const fs::path &curves)
{
  const VectorXd x = VectorXd::LinSpaced(61, 0, 1.225);
  const VectorXd w = x.unaryExpr([](const double s) { return 1.468e-11 * (1 - std::pow(s / 1.225, 2)); });
  write_csv(curves / "shape-backup-roll.csv", Csv()
                                                  .with("x [m]", x)
                                                  .with("f2_upper [m/N]", (2.414e-10 + w.array()).matrix())
                                                  .with("f2_lower [m/N]", (1.648e-10 + w.array()).matrix()));
  const VectorXd xw = VectorXd::LinSpaced(61, 0, 1.16);
  const VectorXd f  = xw.unaryExpr([](const double s) { return 3.13e-11 * std::exp(-std::pow(s / 0.7, 2)); });
  write_csv(curves / "shape-work-roll.csv", Csv()
                                                .with("x [m]", xw)
                                                .with("f1_upper [m/N]", (2.5e-10 + f.array()).matrix())
                                                .with("f1_lower [m/N]", (1.73e-10 + f.array()).matrix()));
}

SampleChain chain_of()
{
  SampleChain chain;
  MatrixXd stiffness = MatrixXd::Zero(6, 6);
  chain.M << 9320, 59725.0, 1875.25, 3069.21, 42315.97, 4660;
  chain.K << 6.31412e9, 1.02333e10, 4.0192e10, 0, 4.0192e10, 2.92702e10, 6.88067e9;
  for (int i = 0; i < 6; ++i) {
    stiffness(i, i) = chain.K[i] + chain.K[i + 1];
    if (i < 5)
      stiffness(i, i + 1) = stiffness(i + 1, i) = -chain.K[i + 1];
  }
  const MatrixXd mass = chain.M.asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solved(stiffness, mass);
  chain.frequency = solved.eigenvalues().cwiseSqrt() / (2 * pi);
  chain.shapes    = solved.eigenvectors();
  return chain;
}

void write_modes(const fs::path &curves, const SampleChain &chain)
{
  Csv columns = Csv().with("mode []", VectorXd::LinSpaced(6, 1, 6)).with("frequency [Hz]", chain.frequency);
  write_csv(curves / "poles.csv", Csv()
                                      .with("pole []", VectorXd::LinSpaced(6, 1, 6))
                                      .with("frequency [Hz]", chain.frequency)
                                      .with("damping []", VectorXd::Constant(6, 0.01)));
  MatrixXd y = chain.shapes;
  for (int mode = 0; mode < 6; ++mode) {
    Eigen::Index largest;
    y.col(mode).cwiseAbs().maxCoeff(&largest);
    y.col(mode) /= y(largest, mode);
  }
  for (int mass = 0; mass < 6; ++mass)
    columns.with("y" + std::to_string(mass + 1) + " []", y.row(mass).transpose());
  MatrixXd energy(6, 7);
  for (int mode = 0; mode < 6; ++mode) {
    for (int spring = 0; spring < 7; ++spring) {
      const double stretch = (spring < 6 ? y(spring, mode) : 0) - (spring > 0 ? y(spring - 1, mode) : 0);
      energy(mode, spring) = chain.K[spring] * stretch * stretch;
    }
    energy.row(mode) /= energy.row(mode).sum();
  }
  for (int spring = 0; spring < 7; ++spring)
    columns.with("energy_K" + std::to_string(spring + 1) + " []", energy.col(spring));
  write_csv(curves / "modes.csv", columns);
  write_csv(curves / "modes-horizontal.csv",
            Csv()
                .with("mode []", VectorXd::LinSpaced(4, 1, 4))
                .with("frequency [Hz]", Eigen::Vector4d(130.6, 155.3, 573.6, 734.3))
                .with("upper_backup []", Eigen::Vector4d(1, 0, 0, 0))
                .with("lower_backup []", Eigen::Vector4d(0, 1, 0, 0))
                .with("lower_work []", Eigen::Vector4d(0, 0, 1, 0))
                .with("upper_work []", Eigen::Vector4d(0, 0, 0, 1)));
}

// Mode by mode with the recurrence of a damped oscillator: good enough for a picture.
void write_response(const fs::path &run, const std::string &slug, const SampleChain &chain, const double mean,
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
    const double w = 2 * pi * chain.frequency[mode], zeta = 0.01, h = 1 / fs_out;
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
  const VectorXd time                   = VectorXd::LinSpaced(n, 0, (n - 1) / fs_out);
  write_csv(run / "response" / (slug + ".csv"), Csv()
                                                    .with("time [s]", time)
                                                    .with("force [kN]", force * 1e-3)
                                                    .with("upper_work_roll [g]", acceleration.col(2))
                                                    .with("lower_work_roll [g]", acceleration.col(3))
                                                    .with("load_cell [kN]", force * 1e-3));
  const VectorXd f = VectorXd::LinSpaced(2000, 1, 2000);
  Csv spectra      = Csv()
                    .with("frequency [Hz]", f)
                    .with("force [N/sqrt(Hz)]", VectorXd(2000))
                    .with("upper_work_roll [g/sqrt(Hz)]", VectorXd(2000))
                    .with("lower_work_roll [g/sqrt(Hz)]", VectorXd(2000));
  for (int i = 0; i < 2000; ++i) {
    const double w        = 2 * pi * f[i];
    const double input    = 20 / (1 + std::pow(f[i] / 1000, 4));
    spectra.columns[1][i] = input;
    for (int roll = 0; roll < 2; ++roll) {
      std::complex<double> sum = 0;
      for (int mode = 0; mode < 6; ++mode) {
        const double natural = 2 * pi * chain.frequency[mode];
        sum += chain.shapes(2 + roll, mode) * (chain.shapes(2, mode) - chain.shapes(3, mode)) * -w * w /
               std::complex<double>(natural * natural - w * w, 0.02 * natural * w);
      }
      spectra.columns[std::size_t(2 + roll)][i] = std::abs(sum) * input / 9.80665;
    }
  }
  write_csv(run / "response" / (slug + "-spectrum.csv"), spectra);
}

// The directories of this process; gone when it ends.
struct Directories {
  std::vector<fs::path> made;
  ~Directories()
  {
    std::error_code ignored;  // what is already gone need not be removed
    for (const fs::path &directory : made)
      fs::remove_all(directory, ignored);
  }
} directories;

fs::path new_directory()
{
  std::string pattern = (fs::temp_directory_path() / "sample-run-XXXXXX").string();
  directories.made.push_back(mkdtemp(pattern.data()));
  return directories.made.back();
}
}  // namespace

int sample_spike(const SampleRun &sample)
{
  return sample.samples * 2 / 3;
}

std::string write_sample_run(const SampleRun &sample)
{
  const fs::path run      = new_directory();
  const fs::path curves   = run / "curves";
  const std::string name  = sample_name(sample);
  const SampleChain chain = chain_of();
  if (sample.kind == "two-cylinders")
    write_contact(curves, "line", false);
  else if (sample.kind == "bearing")
    write_whole_bearing(run, sample);
  else {
    write_modes(curves, chain);
    write_response(run, "pass-1", chain, 976217.5, 6639, sample, 1);
    write_response(run, "pass-2", chain, 737992.5, 8575, sample, 2);
  }
  if (sample.kind == "four-high") {
    write_contact(curves, "upper", true);
    write_contact(curves, "lower", true);
    write_plain_bearing(run, "trb", 1.614e10, 39, 0.02);
    write_plain_bearing(run, "crb", 4.3e10, 32, 0);
    write_shapes(curves);
  }
  std::ofstream(run / "results.json") << sample_results(sample, chain).dump(2);
  std::ofstream(run / "run.json") << sample_manifest(sample, name).dump(2);
  return run.string();
}
