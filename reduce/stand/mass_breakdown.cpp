#include "reduce/stand/mass_breakdown.h"
#include "reduce/chain/equivalent_mass.h"
#include "reduce/stand/fe_masses.h"
#include "reduce/stand/six_masses.h"
#include "reduce/stand/stand_modes.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>

namespace mill::reduce {
namespace {
using Shape = std::function<double(double)>;

/// Displacements under a bite force of 1 N that (4.14)-(4.16) ask for; index 0 above, 1 below.  m/N
struct Displacements {
  Shape f1[2], f2[2];                   // of the axes of work and backup rolls
  double reference1[2], reference2[2];  // of the points the masses are put at
  double seat1[2], seat2[2];            // bearing centres
  double frame[2];                      // M1, M6
  double cylinder, chock[2];            // cylinder; backup chocks
  double edge;                          // where f1 has its kink: end of strip or barrel
};

class Breakdown {
public:
  Breakdown(const std::string &mass, const std::string &route, const double reference) : reference_(reference)
  {
    result_.mass  = mass;
    result_.route = route;
  }

  /// Mass on both sides that moves as one.
  void add(const std::string &name, const double mass, const double displacement)
  {
    if (mass > 0)
      result_.parts.push_back({name, mass, mass * displacement * displacement / (reference_ * reference_)});
  }

  /// Mass spread evenly between two stations, on both sides.
  void add_span(const std::string &name, const double mass, const Shape &shape,
                const std::vector<double> &stations)
  {
    const double length = stations.back() - stations.front();
    double equivalent   = 0;
    for (std::size_t i = 0; i + 1 < stations.size(); ++i)
      if (stations[i + 1] > stations[i])
        equivalent += equivalent_mass(shape, {{stations[i], stations[i + 1], mass / length}}, {}, reference_);
    result_.parts.push_back({name, mass, equivalent});
  }

  MassBreakdown result()
  {
    for (const PartMass &part : result_.parts)
      result_.value += part.equivalent;
    return result_;
  }

private:
  MassBreakdown result_;
  double reference_;
};

MassBreakdown frame_mass(const std::string &mass, const std::string &route, const std::vector<PartMass> &parts)
{
  Breakdown b(mass, route, 1);
  for (const PartMass &part : parts)
    b.add(part.name, part.mass, 1);
  return b.result();
}

MassBreakdown backup_mass(const FourHigh &stand, const Displacements &d, const int side, const std::string &route)
{
  const Roll &roll = stand.backup_roll;
  const double h = roll.barrel_length / 2, a = roll.bearing_span / 2;
  Breakdown b(side == 0 ? "M2" : "M5", route, d.reference2[side]);
  b.add_span("barrel", 2 * h * mass_per_length(barrel_section(roll), stand.steel), d.f2[side], {0, h});
  b.add_span("necks", 2 * roll.neck_length * mass_per_length(neck_section(roll), stand.steel), d.f2[side], {h, a});
  b.add("bearings", 2 * roll.bearing_mass, d.seat2[side]);
  b.add("chocks", 2 * (side == 0 ? roll.chock_mass_upper : roll.chock_mass_lower), d.chock[side]);
  if (side == 0) {
    b.add("cylinders", 2 * stand.frame.cylinder_mass, d.cylinder);
    b.add("balance gear", stand.frame.balance_mass, d.frame[0]);
  }
  return b.result();
}

MassBreakdown work_mass(const FourHigh &stand, const Displacements &d, const int side, const std::string &route)
{
  const Roll &roll = stand.work_roll;
  const double h = roll.barrel_length / 2, edge = std::min(d.edge, h);
  Breakdown b(side == 0 ? "M3" : "M4", route, d.reference1[side]);
  b.add_span("barrel", 2 * h * mass_per_length(barrel_section(roll), stand.steel), d.f1[side], {0, edge, h});
  b.add("necks", 2 * roll.neck_length * mass_per_length(neck_section(roll), stand.steel),
        d.f1[side](h + roll.neck_length / 2));
  b.add("bearings", 2 * roll.bearing_mass, d.seat1[side]);
  b.add("chocks", 2 * (side == 0 ? roll.chock_mass_upper : roll.chock_mass_lower), d.seat1[side]);
  return b.result();
}

std::vector<MassBreakdown> all_masses(const FourHigh &stand, const Displacements &d, const std::string &route,
                                      const std::vector<PartMass> &upper, const std::vector<PartMass> &lower)
{
  return {frame_mass("M1", route, upper), backup_mass(stand, d, 0, route), work_mass(stand, d, 0, route),
          work_mass(stand, d, 1, route),  backup_mass(stand, d, 1, route), frame_mass("M6", route, lower)};
}

std::vector<PartMass> upper_frame_parts(const Frame &f)
{
  std::vector<PartMass> parts;
  const auto add = [&](const char *name, const double mass) { parts.push_back({name, mass, mass}); };
  add("posts, reduced", f.upper_post_mass);
  add("beam, reduced", f.upper_beam_mass);
  add("packing", f.upper_packing_mass);
  add("piston", f.piston_mass);
  return parts;
}

std::vector<PartMass> lower_frame_parts(const Frame &f)
{
  std::vector<PartMass> parts;
  const auto add = [&](const char *name, const double mass) { parts.push_back({name, mass, mass}); };
  add("posts, reduced", f.lower_post_mass);
  add("beam, reduced", f.lower_beam_mass);
  add("load cell", f.load_cell_mass);
  add("packing", f.lower_packing_mass);
  return parts;
}
}  // namespace

std::vector<MassBreakdown> chain_breakdown(const FourHigh &stand, const LumpedStand &chain)
{
  const Flexibilities &u = chain.flexibility;
  const Roll &work       = stand.work_roll;
  Displacements d;
  const double reference2[2] = {u.roll_upper, u.roll_lower}, seat2[2] = {u.bearing_upper, u.bearing_lower};
  for (int side = 0; side < 2; ++side) {
    const BentWorkRoll &bent = chain.work[std::size_t(side)];
    d.f1[side]               = [&, side](double x) { return work_shape(bent, chain.backup, reference2[side], x); };
    d.f2[side]               = [&, side](double x) { return backup_shape(chain.backup, seat2[side], x); };
    d.reference1[side]       = d.f1[side](0);
    d.reference2[side]       = reference2[side];
    d.seat1[side]            = d.f1[side](work.bearing_span / 2);
    d.seat2[side]            = seat2[side];
  }
  d.frame[0] = u.frame_upper;
  d.frame[1] = u.frame_lower;
  d.cylinder = u.cylinder;
  d.chock[0] = u.chock_upper;
  d.chock[1] = u.frame_lower;
  d.edge     = stand.strip.width / 2;
  return all_masses(stand, d, "chain", upper_frame_parts(stand.frame), lower_frame_parts(stand.frame));
}

std::vector<MassBreakdown> model_breakdown(const FourHigh &stand, const StandModel &model,
                                           const MassReference reference)
{
  const StandModel path    = load_path(model);
  const Eigen::VectorXd y  = static_displacement(path);
  const SixMasses six      = six_masses(model, riders_of(stand), reference);
  const StandShapes shapes = stand_shapes(model);
  const auto result_at     = [&](const std::string &name) {
    const auto match =
        std::find_if(path.points.begin(), path.points.end(), [&](const StandPoint &p) { return p.name == name; });
    if (match == path.points.end())
      throw InputError("stand model \"" + model.name + "\" has no point \"" + name + "\"");
    return std::abs(match->row.dot(y));
  };
  Displacements d;
  const RollShape *f1[2] = {&shapes.f1_upper, &shapes.f1_lower}, *f2[2] = {&shapes.f2_upper, &shapes.f2_lower};
  const double h1 = stand.work_roll.barrel_length / 2, h2 = stand.backup_roll.barrel_length / 2;
  const std::string side_name[2] = {"upper", "lower"};
  for (int side = 0; side < 2; ++side) {
    d.f1[side]         = [=](double x) { return value_at(*f1[side], x, h1); };
    d.f2[side]         = [=](double x) { return value_at(*f2[side], x, h2); };
    d.reference1[side] = std::abs(six.displacement[side == 0 ? 2 : 3]);
    d.reference2[side] = std::abs(six.displacement[side == 0 ? 1 : 4]);
    d.seat1[side]      = result_at(side_name[side] + " work roll seat");
    d.seat2[side]      = result_at(side_name[side] + " backup roll seat");
    d.chock[side]      = result_at(side_name[side] + " backup chock");
  }
  d.frame[0] = result_at("upper frame");
  d.frame[1] = result_at("lower frame");
  d.cylinder = result_at("cylinder");
  d.edge     = stand.strip.width / 2;

  std::vector<PartMass> upper = upper_frame_parts(stand.frame), lower = lower_frame_parts(stand.frame);
  const bool housing = std::count(model.parts.begin(), model.parts.end(), "housing") > 0;
  if (housing) {  // posts and beams are one body; what it adds is the difference to the sum
    upper.erase(upper.begin(), upper.begin() + 2);
    lower.erase(lower.begin(), lower.begin() + 2);
    auto result       = all_masses(stand, d, "finite elements", upper, lower);
    const auto finish = [&](MassBreakdown &b, const double total) {
      b.parts.insert(b.parts.begin(), {"housing", std::nan(""), total - b.value});
      b.value = total;
    };
    finish(result.front(), six.M.front());
    finish(result.back(), six.M.back());
    return result;
  }
  return all_masses(stand, d, "finite elements", upper, lower);
}
}  // namespace mill::reduce
