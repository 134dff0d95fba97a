#pragma once
#include "app/stages/contact/condensed_rolls.h"
#include "core/model/contact_settings.h"
#include "fem/roll/contact_answers.h"
#include <functional>
#include <vector>

namespace mill {
struct FourHigh;
struct TwoCylinders;

/// One roll contact of a stand, ready to be solved at any load.
struct ContactModel : fem::ContactPairs {
  CondensedPair backup, work;
  /// Of a model whose rolls were not needed so far: the same with them and with the compliances of its pairs.
  std::function<const ContactModel &()> completed;
};

/// The model with its rolls.
const ContactModel &complete(const ContactModel &model);

/// The two rolls of a contact as cylinders without ends.
reduce::CylinderPair closed_form(const FourHigh &stand);

/// Every pair of a model.
std::vector<fem::ContactPair *> all_pairs(ContactModel &model);
std::vector<const fem::ContactPair *> all_pairs(const ContactModel &model);

/// (n) m, how much both rolls lack in radius at z of the stand, and what crossed axes add.
/// @param side  1: upper contact, -1: lower
Eigen::VectorXd profile_drop(const FourHigh &stand, const ContactSettings &settings, double side,
                             const Eigen::VectorXd &z);

/// (n) m, the same of the upper contact, the mean of both sides.
Eigen::VectorXd even_drop(const FourHigh &stand, const ContactSettings &settings, const Eigen::VectorXd &z);

/// True when the two sides of mid-length carry different loads.
bool is_one_sided(const FourHigh &stand, const ContactSettings &settings);

/// A roll as it is to be meshed.
struct PlannedRoll {
  RollGeometry geometry;
  meshes::RollMeshSize size;
};
struct PlannedPair {
  PlannedRoll backup, work;
  RollOptions wanted;
};

/// Both rolls of a contact, meshed for loads up to `largest_load`.
/// @param reach  width of the patch over that of the contact
PlannedPair planned_rolls(const FourHigh &stand, const ContactSettings &settings, double largest_load,
                          double reach);
/// One of two cylinders in plane strain.
PlannedRoll planned_cylinder(const TwoCylinders &spec, double diameter);
constexpr double first_reach = 1.5;  // of the patch that is tried first

/// Meshes and condenses the two rolls for loads up to `largest_load`; widens the patch until no load reaches its
/// edge.
/// @param name  "upper" or "lower"
/// @throws SolverError  no patch is wide enough: a crown that leaves a point contact
ContactModel contact_model(RunContext &run, const FourHigh &stand, const std::string &name,
                           const ContactSettings &settings, double largest_load);
}  // namespace mill
