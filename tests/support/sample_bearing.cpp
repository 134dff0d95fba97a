#include "tests/support/sample_bearing.h"
#include "tests/support/sample_csv.h"
#include "tests/support/sample_values.h"
#include <cmath>

namespace {
using namespace sample;
using Eigen::VectorXd;
using nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr double pi = 3.14159265358979323846;
constexpr int Z     = 39;
constexpr double F  = 1e6;  // N, working load

VectorXd log_spaced(const int n, const double low, const double high)
{
  return VectorXd::LinSpaced(n, std::log(low), std::log(high)).array().exp();
}

double share_of(const int row)
{
  return 0.25 + 0.03 * (row - 1.5);
}

// Secant that grows with the tenth power of the load, as that of a power law of 10/9.
VectorXd secant_of(const VectorXd &load, const double at_F)
{
  return at_F * (load / F).array().pow(0.1);
}

// Round the ring between elastic rings: the load is handed to both sides, 25 degrees off the load line.
VectorXd m_shape(const VectorXd &angle)
{
  return angle.unaryExpr([](const double a) {
    const double c = std::cos(a), dip = 1 - 0.25 * std::exp(-std::pow(std::remainder(a, 2 * pi) / 0.3, 2));
    return std::pow(std::max(0.0, c), 10.0 / 9) * dip;
  });
}

VectorXd rigid_shape(const VectorXd &angle)
{
  return angle.unaryExpr([](const double a) { return std::pow(std::max(0.0, std::cos(a)), 10.0 / 9); });
}

VectorXd angles(const int rollers)
{
  return VectorXd::LinSpaced(rollers, 0, 2 * pi * (rollers - 1) / rollers);
}

void write_curve(const fs::path &stem)
{
  const VectorXd load = log_spaced(20, 1e5, 4e6), secant = secant_of(load, 9e9), rigid = secant_of(load, 2.05e10),
                 standard = secant_of(load, 1.957e10);
  Csv csv                 = Csv()
                .with("load [N]", load)
                .with("displacement [m]", load.cwiseQuotient(secant))
                .with("secant [N/m]", secant)
                .with("tangent [N/m]", 10.0 / 9 * secant)
                .with("loaded_rollers []", VectorXd::Constant(20, 19))
                .with("loaded_rollers_all_rows []", VectorXd::Constant(20, 76))
                .with("roller_max [N]", 0.028 * load)
                .with("rigid_secant [N/m]", rigid)
                .with("rigid_tangent [N/m]", 10.0 / 9 * rigid)
                .with("standard_secant [N/m]", standard)
                .with("standard_tangent [N/m]", 10.0 / 9 * standard);
  for (int row = 0; row < 4; ++row)
    csv.with("row" + std::to_string(row + 1) + "_share []",
             VectorXd::Constant(20, 0.25) +
                 (share_of(row) - 0.25) * load.unaryExpr([](const double f) { return std::pow(F / f, 0.3); }));
  write_csv(stem.string() + ".csv", csv);
}

void write_rows(const fs::path &stem)
{
  const VectorXd row   = VectorXd::LinSpaced(4, 1, 4);
  const VectorXd share = 0.25 + 0.03 * (row.array() - 2.5);
  write_csv(stem.string() + "-rows.csv",
            Csv()
                .with("row []", row)
                .with("share []", share)
                .with("axial [N]", 4.5e5 * share.cwiseProduct(Eigen::Vector4d(1, -1, 1, -1)))
                .with("rib_max [N]", 4e3 * share)
                .with("roller_max [N]", 1e5 * share)
                .with("roller_secant [N/m]", 5.2e8 + 1e8 * share.array())
                .with("roller_tangent [N/m]", 5.8e8 + 1e8 * share.array()));
  Csv rollers = Csv().with("angle [rad]", angles(Z));
  for (int r = 0; r < 4; ++r)
    rollers.with("row" + std::to_string(r + 1) + " [N]", 1.2e5 * share[r] * m_shape(angles(Z)));
  for (int r = 0; r < 4; ++r)
    rollers.with("standard_row" + std::to_string(r + 1) + " [N]", 2.786e4 * rigid_shape(angles(Z)));
  write_csv(stem.string() + "-rollers.csv", rollers);
  write_csv(stem.string() + "-published.csv",
            Csv()
                .with("row []", row)
                .with("published [N/m]", Eigen::Vector4d(6.78395e8, 6.37958e8, 6.23286e8, 6.47685e8))
                .with("roller_load [N]", 1e5 * share)
                .with("secant [N/m]", 5.2e8 + 1e8 * share.array())
                .with("tangent [N/m]", 5.8e8 + 1e8 * share.array())
                .with("load_that_fits_secant [N]", Eigen::Vector4d(9.5e4, 5.9e4, 4.1e4, 6e4))
                .with("load_that_fits_tangent [N]", Eigen::Vector4d(3.3e4, 2.1e4, 1.4e4, 2.3e4)));
}

void write_roller(const fs::path &stem)
{
  const VectorXd load                          = log_spaced(16, 1e3, 4e4);
  Csv law                                      = Csv().with("load [N]", load);
  const std::pair<const char *, double> laws[] = {
      {"fe", 6.3e8}, {"slices", 6.25e8}, {"iso", 5.24e8}, {"palmgren", 5.41e8}, {"elastic", 6.22e8}};
  for (const auto &[name, at] : laws) {
    const VectorXd secant = at * (load / 1e4).array().pow(0.1);
    law.with(std::string("secant_") + name + " [N/m]", secant)
        .with(std::string("tangent_") + name + " [N/m]", 10.0 / 9 * secant);
  }
  write_csv(stem.string() + "-law.csv", law);
  const VectorXd tilt = VectorXd::LinSpaced(9, 0, 2e-3);
  write_csv(stem.string() + "-tilt.csv", Csv()
                                             .with("tilt [rad]", tilt)
                                             .with("load [N]", 2.8e4 * (1 + 1e5 * tilt.array().square()))
                                             .with("moment [N m]", 2e4 * tilt)
                                             .with("load_slices [N]", 2.8e4 * (1 + 0.9e5 * tilt.array().square()))
                                             .with("moment_slices [N m]", 1.9e4 * tilt));
  constexpr int along = 41, across = 21;
  VectorXd z(along * across), x(along * across), p(along * across);
  for (int k = 0; k < along; ++k)
    for (int i = 0; i < across; ++i) {
      const int index   = k * across + i;
      z[index]          = -0.0167 + 0.0334 * k / (along - 1);
      x[index]          = 3.6e-4 * (2.0 * i / (across - 1) - 1);
      const double half = 3e-4 * std::sqrt(std::max(0.0, 1 - std::pow(z[index] / 0.0167, 8)));
      p[index]          = half > 0 ? 1.7e9 * std::sqrt(std::max(0.0, 1 - std::pow(x[index] / half, 2))) : 0;
    }
  for (const char *raceway : {"inner", "outer"})
    write_csv(stem.string() + "-pressure-" + raceway + ".csv",
              Csv().with("z [m]", z).with("x [m]", x).with("pressure [Pa]", p));
  const VectorXd cage = VectorXd::LinSpaced(8, 0, 2 * pi / Z * 7 / 8);
  write_csv(stem.string() + "-cage.csv", Csv()
                                             .with("angle [rad]", cage)
                                             .with("tangent [N/m]", 1e10 * (1 + 0.008 * (Z * cage.array()).cos()))
                                             .with("secant [N/m]", 9e9 * (1 + 0.001 * (Z * cage.array()).sin())));
}

// A hard spring that swings under a harmonic force: two lines and their sum.
void write_motion(const fs::path &run, const fs::path &stem)
{
  const VectorXd time = VectorXd::LinSpaced(4001, 0, 0.2), w = 2 * pi * time;
  const VectorXd x = 1.1e-4 + 2e-5 * (100 * w.array()).sin() + 4e-6 * (530 * w.array()).cos();
  const VectorXd y = 6e-6 * (300 * w.array()).sin();
  write_csv(run / "response" / "bearing-trb.csv", Csv()
                                                      .with("time [s]", time)
                                                      .with("x [m]", x)
                                                      .with("y [m]", y)
                                                      .with("force [N]", 9e9 * x)
                                                      .with("acceleration_x [m/s2]", -1e7 * x)
                                                      .with("acceleration_y [m/s2]", -1e7 * y));
  const VectorXd f = VectorXd::LinSpaced(1000, 2, 2000);
  const VectorXd a = f.unaryExpr([](const double load) {
    return 0.3 * std::exp(-std::pow((load - 100) / 3, 2)) + 0.8 * std::exp(-std::pow((load - 530) / 3, 2)) + 1e-4;
  });
  write_csv(
      stem.string() + "-spectrum.csv",
      Csv().with("frequency [Hz]", f).with("acceleration [g/sqrt(Hz)]", a).with("force [N/sqrt(Hz)]", 1e4 * a));
}
}  // namespace

void write_plain_bearing(const fs::path &run, const std::string &name, const double stiffness, const int rollers,
                         const double tilt)
{
  const std::string stem = (run / "curves" / ("bearing-" + name)).string();
  const VectorXd load    = log_spaced(20, 1e4, 1e6);
  const VectorXd secant  = stiffness * (load / 1e5).array().pow(0.1);
  write_csv(stem + ".csv", Csv()
                               .with("load [N]", load)
                               .with("displacement [m]", load.cwiseQuotient(secant))
                               .with("secant [N/m]", secant)
                               .with("tangent [N/m]", 10.0 / 9 * secant)
                               .with("loaded_rollers []", VectorXd::Constant(20, rollers / 2)));
  const VectorXd row   = VectorXd::LinSpaced(4, 1, 4);
  const VectorXd share = 0.25 + tilt * (row.array() - 2.5);
  write_csv(stem + "-rows.csv", Csv().with("row []", row).with("share []", share));
  Csv columns = Csv().with("angle [rad]", angles(rollers));
  for (int i = 0; i < 4; ++i)
    columns.with("row" + std::to_string(i + 1) + " [N]",
                 4 * 4.08 * 48810.0 * share[i] / (4 * rollers) * rigid_shape(angles(rollers)));
  write_csv(stem + "-rollers.csv", columns);
}

void write_whole_bearing(const fs::path &run, const SampleRun &)
{
  const fs::path stem = run / "curves" / "bearing-trb";
  write_curve(stem);
  write_rows(stem);
  write_roller(stem);
  write_motion(run, stem);
}

// clang-format off: lists of lists of different lengths crash clang-format 14 with AlignArrayOfStructures
ordered_json sample_bearing_results()
{
  ordered_json v;
  const std::string by = "computed: FE law of one roller, elastic rings in their chock";
  const mill::OperatingPoint at("{} on one bearing", {{1e6, "kN"}});
  const auto add = [&](const std::string &name, const double number, const std::string &unit,
                       const double standard) {
    v["Kzc." + name] = value(number, unit, by, at, 0.02, {"bearing.trb.rows", "load.radial"},
                             {{"ISO/TS 16281, rigid rings", ""}}, {standard});
  };
  add("tangent", 1e10, "N/m", 2.174e10);
  add("secant", 9e9, "N/m", 1.957e10);
  add("tangent_across", 8.1e9, "N/m", 1.95e10);
  add("axial", 3.1e9, "N/m", 6.2e9);
  add("tilting", 4.2e7, "N m", 9e7);
  add("roller_secant", 5.5e8, "N/m", 5.7e8);
  add("roller_tangent", 6.1e8, "N/m", 6.4e8);
  add("roller_max", 2.95e4, "N", 2.786e4);
  add("heaviest_angle", 0.32, "rad", 1);
  add("loaded_rollers", 21, "1", 19);
  for (int row = 0; row < 4; ++row)
    add("row" + std::to_string(row + 1) + "_share", share_of(row), "1", 0.25);
  for (int row = 0; row < 4; ++row)
    add("row" + std::to_string(row + 1) + "_axial", (row % 2 ? -4.5e5 : 4.5e5) * share_of(row), "N", 9e4);
  add("rib_max", 1.2e3, "N", 1.2e3);
  v["Kzc.rollers_times_Z5"] = value(
      1.96e10, "N/m", by, at, NAN, {"bearing.trb.rows"},
      {{"published per-roller values times Z/5", "their own total"}, {"published total", "no contact angle"}},
      {2.0181e10, 2.01e10});
  v["Kzc.rollers_times_stribeck"]   = value(2.1e10, "N/m", by, at);
  v["Kzc.motion.frequency"]         = value(530, "Hz", "computed: small motions", at);
  v["Kzc.motion.peak_acceleration"] = value(46, "m/s2", "computed: time integration", at);
  v["Kzc.motion.peak_force"]        = value(1.2e6, "N", "computed: time integration", at);
  v["Kzc.motion.without_contact"]   = value(0.031, "1", "computed: instants of loss and return", at);
  return v;
}
// clang-format on

ordered_json sample_bearing_dimensions()
{
  ordered_json trb;
  trb["bore"]                = 0.2667;
  trb["outside_diameter"]    = 0.3556;
  trb["width"]               = 0.230188;
  trb["pitch_diameter"]      = 0.31115;
  trb["rows"]                = 4;
  trb["rollers_per_row"]     = Z;
  trb["roller_length"]       = 0.0334;
  trb["roller_diameter"]     = 0.0215;
  trb["roller_cone_angle"]   = 2.5 * pi / 180;
  trb["cup_angle"]           = 19.66 * pi / 180;
  trb["arrangement"]         = "+-+-";
  trb["chock_width"]         = 0.6;
  trb["chock_height"]        = 0.56;
  trb["chock_support_width"] = 0.3;
  ordered_json bearings;
  bearings["trb"] = trb;
  return bearings;
}
