#include "reduce/stand/mode_names.h"
#include "core/records/stand_place.h"
#include "reduce/stand/stand_modes.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace mill::reduce {
namespace {
constexpr double bending_limit = 0.5;  // share of the strain energy from which a roll bends

/// Shares of the kinetic energy by part; what a part carries is a part of its own.
std::vector<std::pair<std::string, double>> kinetic_shares(const StandWithModes &s, const Eigen::Index mode)
{
  std::vector<std::pair<std::string, double>> shares;
  for (std::size_t p = 0; p < s.model.parts.size(); ++p)
    shares.emplace_back(s.model.parts[p], s.modes.kinetic(Eigen::Index(p), mode));
  for (const CarriedMass &carried : s.model.carried) {
    const double share = carried.mass * std::pow(carried.row.dot(s.modes.shape.col(mode)), 2);  // phi^T M phi = 1
    for (auto &[part, energy] : shares)
      if (part == carried.carrier)
        energy -= share;
    shares.emplace_back(carried.name, share);
  }
  return shares;
}

/// "upper work-roll chock" -> "chock, upper work roll" and "chock_upper_work_roll".
KineticShare named_part(const std::string &part, const double share, const bool bends)
{
  const StandPlace place = stand_place(part);
  const std::string side = place.lower ? "lower" : "upper";
  const char *roll       = place.work ? "work" : "backup";
  const auto name        = [&](const std::string &what) {
    return KineticShare{part, what + ", " + side + " " + roll + " roll", what + "_" + side + "_" + roll + "_roll",
                        share};
  };
  if (place.chock)
    return name("chock");
  if (place.frame)
    return {part, "frame, " + side, "frame_" + side, share};
  if (place.roll) {
    KineticShare share_of_roll = name(bends ? "bending" : "roll");
    if (bends)
      share_of_roll.part = "bending of the " + part;
    else
      share_of_roll.name = part;
    return share_of_roll;
  }
  std::string key = part;
  std::replace(key.begin(), key.end(), ' ', '_');
  return {part, part, key, share};
}

/// Displacements of the rolls at mid-length: the second to the fifth of the points.
std::vector<StackMotion> stacks_of(const Eigen::VectorXd &y)
{
  return {{"upper", 0, y[2], y[1]}, {"lower", 0, y[3], y[4]}};
}

/// Receptances psi_p g / w^2 at resonance of the measured places for a force in the gap, all with the same
/// damping.
Eigen::VectorXd largest_receptance(const StandWithModes &s)
{
  const Eigen::ArrayXd w2 = (2 * M_PI * s.modes.frequency.array()).square();
  const Eigen::ArrayXd g  = (s.modes.shape.transpose() * s.model.b).array() / w2;
  Eigen::ArrayXd largest  = Eigen::ArrayXd::Zero(g.size());
  for (const StandPoint *place : measured_places(s.model))
    largest = largest.max((s.modes.shape.transpose() * place->row).array().abs() * g.abs());
  return largest;
}
}  // namespace

std::vector<const StandPoint *> measured_places(const StandModel &stand)
{
  std::vector<const StandPoint *> places;
  for (const char *name :
       {"upper backup roll", "upper work roll", "lower work roll", "lower backup roll", "upper backup chock",
        "upper work-roll chock", "lower work-roll chock", "lower backup chock"})
    for (const StandPoint &point : stand.points)
      if (point.name == name)
        places.push_back(&point);
  return places;
}

Eigen::VectorXd gap_shares(const StandWithModes &stand)
{
  return gap_shares(stand.modes.frequency, stand.modes.shape, stand.model.b,
                    stand.model.b.dot(static_displacement(stand.model)));
}

std::vector<GapMotion> gap_motions(const StandWithModes &stand)
{
  const Eigen::VectorXd shares = gap_shares(stand);
  const Eigen::MatrixXd rows   = point_rows(stand.model, 6);
  std::vector<GapMotion> motions;
  for (Eigen::Index k = 0; k < shares.size(); ++k) {
    GapMotion motion{stand.modes.frequency[k], shares[k], stacks_of(rows * stand.modes.shape.col(k)), {}};
    for (const auto &[part, share] : kinetic_shares(stand, k)) {
      const auto p =
          std::find(stand.model.parts.begin(), stand.model.parts.end(), part) - stand.model.parts.begin();
      const bool bends =
          std::size_t(p) < stand.model.parts.size() && stand.modes.strain_of_part(p, k) > bending_limit;
      motion.parts.push_back(named_part(part, share, bends));
      if (const StandPlace place = stand_place(part); !place.housing)  // one body on both sides of the gap
        motion.stacks[place.lower ? 1 : 0].kinetic += share;
    }
    motions.push_back(std::move(motion));
  }
  return motions;
}

std::vector<ModeName> mode_names(const StandWithModes &stand)
{
  std::vector<ModeName> names = gap_mode_names(gap_motions(stand));
  mark_listed(stand, names);
  return names;
}

void mark_listed(const StandWithModes &stand, std::vector<ModeName> &names)
{
  const Eigen::VectorXd response = largest_receptance(stand);
  const double largest           = response.size() ? response.maxCoeff() : 0;
  for (std::size_t k = 0; k < names.size(); ++k)
    names[k].listed =
        names[k].gap_share >= least_share_listed || response[Eigen::Index(k)] >= least_response_listed * largest;
}
}  // namespace mill::reduce
