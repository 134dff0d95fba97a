#include "reduce/stand/six_masses.h"
#include "core/base/errors.h"
#include "core/records/chain_number.h"
#include "core/records/stand_place.h"
#include "reduce/stand/stand_assembly.h"
#include "reduce/stand/stand_modes.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace mill::reduce {
namespace {
const std::array<const char *, 6> places{"upper frame",     "upper backup roll", "upper work roll",
                                         "lower work roll", "lower backup roll", "lower frame"};

void require_places(const StandModel &stand)
{
  for (std::size_t i = 0; i < 6; ++i)
    if (stand.points.size() < 6 || stand.points[i].name != places[i])
      throw InputError("stand model \"" + stand.name + "\": point " + std::to_string(i + 1) + " must be the " +
                       places[i]);
}

double stiffness_of_foundation(const StandModel &stand, const std::string &name)
{
  for (const Connection &c : stand.connections)
    if (c.name == name)
      return c.stiffness.sum();
  return 0;
}

/// Displacement of a part weighted with the forces that an elastic foundation puts on it; `otherwise` without such
/// an elastic foundation.
double loaded_mean(const StandModel &stand, const std::string &foundation, const std::string &part,
                   const Eigen::VectorXd &y, const double otherwise)
{
  for (const Connection &c : stand.connections) {
    if (c.name != foundation)
      continue;
    Eigen::VectorXd shape_vector = y;
    for (Eigen::Index i = 0; i < y.size(); ++i)
      if (stand.parts[std::size_t(stand.part_of[std::size_t(i)])] != part)
        shape_vector[i] = 0;
    const Eigen::VectorXd force = c.stiffness.cwiseProduct(c.rows * y);
    return std::copysign(force.dot(c.rows * shape_vector) / force.sum(), otherwise);
  }
  return otherwise;
}

/// Place of the chain to which the energy of unknown i belongs.
int place_of_unknown(const StandModel &stand, const Eigen::Index i)
{
  const int place = place_of_part(stand.parts[std::size_t(stand.part_of[std::size_t(i)])]);
  if (place >= 0)
    return place;
  for (const StandPoint &point : stand.points)
    if (const StandPlace named = stand_place(point.name); named.housing && named.seat && point.row[i] != 0)
      return 5;
  return 0;  // the screw; modes of the housing rest in a static shape
}
}  // namespace

StandModel chain_stand(const LumpedModel &model, const FrameForm frame)
{
  StandModel s;
  s.name    = "six-mass";
  s.M       = Eigen::MatrixXd::Zero(6, 6);
  s.K_parts = Eigen::MatrixXd::Zero(6, 6);
  s.b       = Eigen::VectorXd::Unit(6, 2) - Eigen::VectorXd::Unit(6, 3);
  for (int i = 0; i < 6; ++i) {
    s.M(i, i) = model.M[std::size_t(i)].value;
    s.parts.push_back(places[std::size_t(i)]);
    s.part_of.push_back(i);
    s.unknowns.emplace_back();
    s.points.push_back({places[std::size_t(i)], Eigen::VectorXd::Unit(6, i)});
  }
  const bool closed = frame == FrameForm::closed;
  for (int j = 0; j < 7; ++j) {
    Eigen::RowVectorXd row =
        Eigen::RowVectorXd::Zero(6);  // above minus below, so that an elastic foundation's force is positive
    if (j > 0)
      row[j - 1] = 1;
    if (j < 6)
      row[j] = j > 0 ? -1 : 1;
    if (j == 0 && closed)
      row[5] = -1;
    const double stiffness = model.K[std::size_t(j)].value;
    if (j != 3 || stiffness > 0)
      s.connections.push_back({"K" + std::to_string(j + 1), row, Eigen::VectorXd::Constant(1, stiffness)});
  }
  const Eigen::VectorXd lower = Eigen::VectorXd::Unit(6, 5);
  s.load_cell                 = closed ? Eigen::VectorXd(model.K[0].value * (Eigen::VectorXd::Unit(6, 0) - lower))
                                       : Eigen::VectorXd(-model.K[6].value * lower);
  return s;
}

StandModel load_path(const StandModel &stand)
{
  require_places(stand);
  StandModel path             = without(stand, "K4");
  const Eigen::VectorXd upper = path.points[0].row, across = upper - path.points[5].row;
  for (Connection &c : path.connections)
    if (c.name == word_of(ChainNumber::K1) && c.rows.rows() == 1 &&
        (c.rows.row(0).transpose() - across).isZero(1e-12))
      c.rows.row(0) = upper;
  return path;
}

std::vector<Rider> riders_of(const FourHigh &stand)
{
  return {{"balance gear", "upper frame", 0, 1, stand.frame.balance_mass},
          {"lower chocks", "lower backup chock", 5, 4, 2 * stand.backup_roll.chock_mass_lower}};
}

SixMasses six_masses(const StandModel &stand, const std::vector<Rider> &riders, const MassReference reference,
                     const double upper_share)
{
  const StandModel path   = load_path(stand);
  const Eigen::VectorXd y = static_displacement(path);
  SixMasses six;
  for (std::size_t i = 0; i < 6; ++i)
    six.displacement[i] = path.points[i].row.dot(y);
  auto &u = six.displacement;
  if (reference == MassReference::mean) {
    u[1] = loaded_mean(path, "K3", places[1], y, u[1]);
    u[4] = loaded_mean(path, "K5", places[4], y, u[4]);
  }
  six.K = {1 / u[0],          1 / (u[1] - u[0]), 1 / (u[2] - u[1]), stiffness_of_foundation(stand, "K4"),
           1 / (u[4] - u[3]), 1 / (u[5] - u[4]), -1 / u[5]};  // (22.10)

  const Eigen::VectorXd My = path.M * y;
  std::array<double, 6> moving{};  // twice the kinetic energy, (22.11)
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const double energy = y[i] * My[i];
    if (std::isnan(upper_share) || place_of_part(path.parts[std::size_t(path.part_of[std::size_t(i)])]) >= 0) {
      moving[std::size_t(place_of_unknown(path, i))] += energy;
      continue;
    }
    moving[0] += upper_share * energy;
    moving[5] += (1 - upper_share) * energy;
  }
  for (const Rider &rider : riders) {
    const auto match = std::find_if(path.points.begin(), path.points.end(),
                                    [&](const StandPoint &p) { return p.name == rider.point; });
    if (match == path.points.end())
      throw InputError("stand model \"" + stand.name + "\" has no point \"" + rider.point + "\" for the " +
                       rider.name);
    const double energy = rider.mass * std::pow(match->row.dot(y), 2);
    moving[std::size_t(rider.from)] -= energy;
    moving[std::size_t(rider.to)] += energy;
  }
  for (std::size_t i = 0; i < 6; ++i)
    six.M[i] = moving[i] / (u[i] * u[i]);
  return six;
}

LumpedModel with_six_masses(LumpedModel chain, const SixMasses &values, const std::string &method)
{
  const auto set = [&](Parameter &p, const double value) {
    if (p.source != Source::computed)
      return;
    p.value          = value;
    p.method         = method;
    p.error_estimate = std::numeric_limits<double>::quiet_NaN();
    p.checks.clear();
  };
  for (std::size_t i = 0; i < 6; ++i)
    set(chain.M[i], values.M[i]);
  for (std::size_t i = 0; i < 7; ++i)
    if (i != 3)  // the bite does not belong to the stand
      set(chain.K[i], values.K[i]);
  return chain;
}
}  // namespace mill::reduce
