#include "app/bearing_results.h"
#include "app/bearing_published.h"
#include "bearing/geometry.h"
#include "core/provenance.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
std::string load_text(const BearingStudy &s)
{
  std::string text = fmt::format("{:.6g} kN on one bearing", s.question.radial / 1e3);
  if (s.question.axial != 0)
    text += fmt::format(", {:.6g} kN axial", s.question.axial / 1e3);
  if (s.question.tilt != 0)
    text += fmt::format(", tilted by {:.4g} mrad", s.question.tilt * 1e3);
  return text;
}

Parameter plain(const BearingStudy &s, const std::vector<std::string> &inputs)
{
  Parameter p;
  p.unit           = "N/m";
  p.method         = model_name(s.question.bearing);
  p.at             = load_text(s);
  p.error_estimate = s.error_tangent;
  p.inputs         = inputs;
  return p;
}

// The same number of the standard's model beside it; its distance is no error of ours.
std::vector<Check> beside(const double standard)
{
  return {
      {"ISO/TS 16281, rigid rings", standard, ""}
  };
}
}  // namespace

std::vector<std::string> bearing_inputs(const RollerBearing &b)
{
  return bearing_keys(b);
}

Parameter tangent_of(const BearingStudy &s, const std::vector<std::string> &inputs)
{
  Parameter p = plain(s, inputs);
  p.value     = s.tangent;
  p.checks    = s.tangent_checks;
  return p;
}

void add_bearing_results(RunContext &run, const std::string &prefix, const BearingStudy &s,
                         const std::vector<std::string> &inputs)
{
  const auto add = [&](const std::string &name, const std::string &unit, const double value,
                       std::vector<Check> checks, const double error, const std::string &more = "") {
    Parameter p      = plain(s, inputs);
    p.value          = value;
    p.unit           = unit;
    p.checks         = std::move(checks);
    p.error_estimate = error;
    p.method += more;
    run.results.add(prefix + "." + name, p);
  };
  run.results.add(prefix + ".tangent", tangent_of(s, inputs));
  add("secant", "N/m", s.secant, s.secant_checks, s.error_secant);
  add("tangent_across", "N/m", s.tangent_across, beside(stiffness_along(s.standard, s.drive, 1)), s.error_tangent,
      ", across the load");
  add("axial", "N/m", s.at.tangent(2, 2), beside(s.standard.tangent(2, 2)), s.error_tangent,
      ", tangent along the axis, all other motions held");
  if (std::isfinite(s.question.bearing.width))  // else the places of the rows are not known
    add("tilting", "N m/rad", s.at.tangent(4, 4), beside(s.standard.tangent(4, 4)), s.error_tangent,
        ", tangent against tilt in the plane of the load, all other motions held");
  Eigen::Index row, roller;
  const double heaviest = s.at.roller_load.maxCoeff(&row, &roller);
  const auto heavy = heaviest_of_rows(s.at), standard = heaviest_of_rows(s.standard);
  Eigen::Index standard_row;
  const double standard_heaviest = standard.load.maxCoeff(&standard_row);
  add("roller_secant", "N/m", heavy.secant[row], beside(standard.secant[standard_row]), s.error_secant,
      ", heaviest roller between its raceways");
  add("roller_tangent", "N/m", heavy.tangent[row], beside(standard.tangent[standard_row]), s.error_tangent,
      ", heaviest roller between its raceways");
  add("roller_max", "N", heaviest, beside(standard_heaviest), s.error_secant, ", heaviest roller");
  // Both flanks carry alike without a load across; the angle is counted without its sign.
  const double angle = std::abs(std::remainder(s.at.azimuth[roller], 2 * M_PI));
  add("heaviest_angle", "rad", angle, {}, not_given, ", of the heaviest roller from the line of the load");
  add("loaded_rollers", "1", s.at.loaded_rollers.maxCoeff(), beside(s.standard.loaded_rollers.maxCoeff()),
      not_given,
      fmt::format(", in the fullest row; {} of {} in all rows", s.at.loaded_rollers.sum(),
                  s.at.roller_load.size()));
  for (Eigen::Index r = 0; r < s.at.row_share.size(); ++r)
    add(fmt::format("row{}_share", r + 1), "1", s.at.row_share[r], beside(s.standard.row_share[r]),
        s.error_secant);
  for (Eigen::Index r = 0; r < s.at.row_axial.size() && s.question.bearing.cup_angle > 0; ++r)
    add(fmt::format("row{}_axial", r + 1), "N", s.at.row_axial[r], beside(s.standard.row_axial[r]), s.error_secant,
        ", axial force of the row on the cup");
  if (s.question.bearing.cup_angle > 0)
    add("rib_max", "N", s.at.rib_force.maxCoeff(), beside(s.standard.rib_force.maxCoeff()), s.error_secant,
        ", heaviest roller on the cone's rib");
}

void note_bearing(RunContext &run, const BearingStudy &s)
{
  const RollerBearing &b = s.question.bearing;
  for (const std::string &sentence : b.filled)
    run.assume(sentence);
  for (const std::string &sentence : s.parts.notes)
    run.assume("bearing " + b.name + ": " + sentence);
  if (std::isnan(b.pitch_diameter) && std::isfinite(bearing::pitch_diameter(b)))
    run.assume(
        fmt::format("bearing.{}.pitch_diameter is not given: {:.5g} mm, the mean of bore and outside diameter",
                    b.name, 1e3 * bearing::pitch_diameter(b)));
  const int loaded = s.at.loaded_rollers.maxCoeff();
  if (loaded <= 2)
    run.warn(
        fmt::format("bearing {}: of {} rollers of a row {} carr{} {:.4g} kN; with a clearance of {:.4g} mm the "
                    "stiffness hangs on the place of the cage",
                    b.name, b.rollers_per_row, loaded, loaded == 1 ? "ies" : "y", s.question.radial / 1e3,
                    1e3 * b.radial_clearance));
  const double heaviest = s.at.roller_load.maxCoeff();
  if (std::isfinite(b.roller_diameter) && std::isfinite(bearing::pitch_diameter(b))) {
    const double pressure = bearing::elastic_roller(b, heaviest, b.roller_diameter / 2).inner_peak_pressure;
    if (pressure > b.yield_pressure)
      run.warn(
          fmt::format("bearing {}: the heaviest roller presses its inner raceway with {:.0f} MPa under {:.4g} kN; "
                      "bearing.{}.yield_pressure is {:.0f} MPa, beyond which elastic stiffnesses end",
                      b.name, pressure / 1e6, heaviest / 1e3, b.name, b.yield_pressure / 1e6));
  }
  if (s.at.row_share.minCoeff() < 0)
    run.warn(fmt::format("bearing {}: the tilt loads a row on the far side (its share is {:.3g} %)", b.name,
                         100 * s.at.row_share.minCoeff()));
}
}  // namespace mill
