#include "reduce/chain/equivalent_mass.h"
#include "core/model/four_high.h"
#include "core/model/roll.h"
#include "core/numerics/gauss.h"
#include <algorithm>
#include <cmath>

namespace mill::reduce {
namespace {
constexpr int n_gauss = 40;

double integral(const std::function<double(double)> &f, const double from, const double to)
{
  static const GaussRule rule = gauss_legendre(n_gauss);
  const double middle = (from + to) / 2, half = (to - from) / 2;
  double sum = 0;
  for (int i = 0; i < n_gauss; ++i)
    sum += rule.weight[i] * f(middle + half * rule.node[i]);
  return half * sum;
}

double barrel_mass_per_length(const Roll &roll, const Material &m)
{
  return mass_per_length(barrel_section(roll), m);
}

double neck_mass(const Roll &roll, const Material &m)
{
  return mass_per_length(neck_section(roll), m) * roll.neck_length;
}

/// Half the backup roll: the whole neck is smeared over the span between barrel and bearing centre.
std::vector<MassSpan> half_backup_roll(const FourHigh &stand)
{
  const Roll &roll = stand.backup_roll;
  const double h = roll.barrel_length / 2, a = roll.bearing_span / 2;
  const double neck = a > h ? neck_mass(roll, stand.steel) / (a - h) : 0;
  return {{0, h, barrel_mass_per_length(roll, stand.steel)}, {h, a, neck}};
}
}  // namespace

double equivalent_mass(const std::function<double(double)> &shape, const std::vector<MassSpan> &spans,
                       const std::vector<PointMass> &points, const double reference)
{
  double moving = 0;
  for (const MassSpan &span : spans)
    moving += span.mass_per_length * integral([&](double x) { return shape(x) * shape(x); }, span.from, span.to);
  for (const PointMass &point : points)
    moving += point.mass * point.displacement * point.displacement;
  return moving / (reference * reference);
}

double upper_frame_mass(const Frame &f)
{
  return f.upper_post_mass + f.upper_beam_mass + f.upper_packing_mass + f.piston_mass;
}

double lower_frame_mass(const Frame &f)
{
  return f.lower_post_mass + f.lower_beam_mass + f.load_cell_mass + f.lower_packing_mass;
}

double backup_shape(const BentBackupRoll &bent, const double bearing_displacement, const double x)
{
  return bearing_displacement + bent.deflection(x);
}

double upper_backup_mass(const FourHigh &stand, const BentBackupRoll &bent, const Flexibilities &u)
{
  const auto f2    = [&](double x) { return backup_shape(bent, u.bearing_upper, x); };
  const Roll &roll = stand.backup_roll;
  return 2 * equivalent_mass(f2, half_backup_roll(stand),
                             {{stand.frame.cylinder_mass, u.cylinder},
                              {roll.chock_mass_upper, u.chock_upper},
                              {roll.bearing_mass, u.bearing_upper},
                              {stand.frame.balance_mass / 2, u.frame_upper}},  // hangs on the frame; whole stand
                             u.roll_upper);
}

double lower_backup_mass(const FourHigh &stand, const BentBackupRoll &bent, const Flexibilities &u)
{
  const auto f2    = [&](double x) { return backup_shape(bent, u.bearing_lower, x); };
  const Roll &roll = stand.backup_roll;
  return 2 * equivalent_mass(f2, half_backup_roll(stand),
                             {{roll.chock_mass_lower, u.frame_lower}, {roll.bearing_mass, u.bearing_lower}},
                             u.roll_lower);
}

double work_shape(const BentWorkRoll &bent, const BentBackupRoll &backup, const double backup_reference,
                  const double x)
{
  const double on_barrel = std::min(std::abs(x), backup.half_barrel);
  const double drop      = backup.deflection(0) - backup.deflection(on_barrel);
  return backup_reference - drop + bent.deflection(x);
}

double work_roll_mass(const FourHigh &stand, const BentWorkRoll &bent, const BentBackupRoll &backup,
                      const double backup_reference, const double chock_mass)
{
  const Roll &roll       = stand.work_roll;
  const auto f1          = [&](double x) { return work_shape(bent, backup, backup_reference, x); };
  const double h         = roll.barrel_length / 2;
  const double edge      = std::min(bent.half_strip, h);  // the shape has a kink in its fourth derivative here
  const double per_meter = barrel_mass_per_length(roll, stand.steel);
  return 2 * equivalent_mass(f1, {{0, edge, per_meter}, {edge, h, per_meter}},
                             {{roll.bearing_mass + chock_mass, f1(roll.bearing_span / 2)},
                              {neck_mass(roll, stand.steel), f1(h + roll.neck_length / 2)}},
                             f1(0));
}
}  // namespace mill::reduce
