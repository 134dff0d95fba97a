#include "app/bearing_stage.h"
#include "app/contact_stage.h"
#include "core/csv.h"
#include "bearing/rigid_rings.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
// The same bearing by the other published law of one roller: the spread of the two is how well the law is known.
RollerBearing by_the_other_law(RollerBearing bearing)
{
  bearing.roller_law = bearing.roller_law == "iso" ? "palmgren" : "iso";
  return bearing;
}

std::string law_name(const RollerBearing &bearing)
{
  return bearing.roller_law == "iso" ? "ISO/TS 16281 laminae" : "Palmgren, two contacts in series";
}

double load_on_one(const Roll &roll, const double assumed)
{
  return std::isnan(roll.bearing_load) ? assumed : roll.bearing_load;
}

std::vector<std::string> inputs_of(const RollerBearing &bearing, const std::string &roll)
{
  std::vector<std::string> keys{roll + ".bearing", roll + ".bearing_load"};
  for (const char *key : {"rows", "rollers_per_row", "roller_length", "roller_diameter", "cup_angle",
                          "radial_clearance", "profile", "roller_law", "slices"})
    keys.push_back("bearing." + bearing.name + "." + key);
  return keys;
}

void write_curves(RunContext &run, const RollerBearing &bearing, const bearing::BearingState &at)
{
  constexpr int n = 24;
  std::vector<double> loads;
  for (int i = 0; i < n; ++i)
    loads.push_back(at.load * std::pow(100., double(i) / (n - 1) - 0.6));
  const auto states = bearing::bearing_curve(bearing, loads);
  Eigen::MatrixXd values(n, 5);
  for (int i = 0; i < n; ++i) {
    const auto &s = states[i];
    values.row(i) << s.load, s.displacement, s.secant, s.tangent, double(s.loaded_rollers.sum());
  }
  Table curve;
  curve.add("load", "N", values.col(0))
      .add("displacement", "m", values.col(1))
      .add("secant", "N/m", values.col(2));
  curve.add("tangent", "N/m", values.col(3)).add("loaded_rollers", "", values.col(4));
  const auto rows = at.row_share.size();
  Table shares, rollers;
  shares.add("row", "", Eigen::VectorXd::LinSpaced(rows, 1, double(rows))).add("share", "", at.row_share);
  rollers.add("angle", "rad", at.azimuth);
  for (Eigen::Index r = 0; r < rows; ++r)
    rollers.add("row" + std::to_string(r + 1), "N", at.roller_load.row(r).transpose());
  const std::string stem = "curves/bearing-" + slug(bearing.name);
  run.out.write(stem + ".csv", csv_text(curve));
  run.out.write(stem + "-rows.csv", csv_text(shares));
  run.out.write(stem + "-rollers.csv", csv_text(rollers));
}
}  // namespace

StandBearings solve_bearings(RunContext &run, const FourHigh &stand, const double F, const bool write)
{
  struct Seat {
    const char *name;
    const Roll *roll;
    const char *section;
    double assumed_load;
  };
  const Seat places[] = {
      {"Kzc1", &stand.backup_roll, "backup_roll", F / 2 },
      {"Kzc2", &stand.work_roll,   "work_roll",   F / 20},
      {"Kzc3", &stand.work_roll,   "work_roll",   F / 20},
      {"Kzc4", &stand.backup_roll, "backup_roll", F / 2 }
  };
  StageTimer timer(run, "bearings");
  StandBearings out;
  for (int i = 0; i < 4; ++i) {
    const Seat &p                = places[i];
    const RollerBearing &bearing = bearing_of(stand, p.roll->bearing);
    const double load            = load_on_one(*p.roll, p.assumed_load);
    const auto at                = bearing::solve_bearing(bearing, load);
    const auto other             = bearing::solve_bearing(by_the_other_law(bearing), load);
    Parameter k;
    k.unit                 = "N/m";
    k.method               = law_name(bearing) + ", rigid rings";
    k.at                   = in_kN(load) + " on one bearing";
    k.inputs               = inputs_of(bearing, p.section);
    Parameter tangent      = k;
    tangent.value          = at.tangent;
    tangent.error_estimate = std::abs(other.tangent / at.tangent - 1);
    tangent.checks         = {
                {law_name(by_the_other_law(bearing)), other.tangent, "another law of one roller"}
    };
    out.Kzc[i] = tangent;
    if (i == 0) {
      out.K_Zy        = tangent;
      out.K_Zy.value  = 2 * tangent.value;
      out.K_Zy.method = tangent.method + ", two bearings";
      for (Check &check : out.K_Zy.checks)
        check.value *= 2;
    }
    if (!write)
      continue;
    const std::string name = p.name;
    run.results.add(name + ".tangent", tangent);
    const auto add = [&](const std::string &what, const double value, const double second, const char *unit) {
      Parameter s      = k;
      s.value          = value;
      s.unit           = unit;
      s.error_estimate = std::abs(second / value - 1);
      s.checks         = {
                  {law_name(by_the_other_law(bearing)), second, "another law of one roller"}
      };
      run.results.add(name + "." + what, s);
    };
    add("secant", at.secant, other.secant, "N/m");
    add("roller_secant", at.roller_secant, other.roller_secant, "N/m");
    for (Eigen::Index r = 0; r < at.row_share.size(); ++r)
      add("row" + std::to_string(r + 1) + "_share", at.row_share[r], other.row_share[r], "1");
    if (i < 2) {
      write_curves(run, bearing, at);
      if (std::isnan(p.roll->bearing_load))
        run.assume(std::string(p.section) + ".bearing_load is not given: " +
                   (i == 0 ? "half the rolling force, shared by two bearings"
                           : "a twentieth of the rolling force on each bearing, for balance and bending"));
    }
  }
  return out;
}
}  // namespace mill
