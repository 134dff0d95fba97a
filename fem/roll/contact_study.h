#pragma once
#include "core/base/each_member.h"
#include "core/base/errors.h"
#include "core/process/progress.h"
#include "core/records/records.h"
#include "fem/contact/problem.h"
#include "fem/roll/held_roll.h"
#include <Eigen/SparseCore>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace mill::fem {
class SolvedLoads;

/// Two condensed rolls facing each other along one contact line.
struct ContactPair {
  std::string name;       ///< "upper", "lower", "line"
  std::string reference;  ///< datum of the approach, one sentence
  PatchGrid grid;         ///< stations of the patch; a quarter of the contact, or a half of it (grid.whole)
  /// One motion (approach) for a quarter, two (approach, and tilt about mid-length) for the whole.
  contact::Problem problem;
  Eigen::MatrixXd axis;          ///< (n_s, n) m/N, sum of both: axes moving away from the contact at the stations
  Eigen::MatrixXd axis_support;  ///< (n_s, k)
  Eigen::VectorXd path;          ///< (n_s) m, contact length that belongs to each station
  Eigen::MatrixXd mean;          ///< (n_s, k) weights of mean and mean slope over the contact length
  Eigen::VectorXd drop;          ///< (n_s) m, sum of the profiles
  Eigen::SparseMatrix<double, Eigen::RowMajor>
      transfer;             ///< (n_s, stations of the second roll), shifted rolls only
  double radii_sum    = 0;  ///< m, distance of the axes
  double multiplicity = 4;  ///< -, total force over the sum of nodal forces; slabs: 1/m, per metre, 2 / thickness
  double axial_mirror = 2;  ///< -, line load over (force per station / axial weight): both sides of x = 0
  /// What is imposed besides the force, for the whole: the tilt of the axes (rad), or where the force stands (m).
  double tilt        = 0;                                         ///< rad, used when load_offset is not given
  double load_offset = std::numeric_limits<double>::quiet_NaN();  ///< m
  /// What is known of this pair, shared by its copies; null: nothing is remembered.
  std::shared_ptr<SolvedLoads> solved;
  /// Of a pair whose `problem` was not kept for the next run: the same with it, made when something is not known.
  std::function<const ContactPair &()> completed;
};

// What is read off a pair, without what solves it.
template <class Io, class R, if_record<R, ContactPair> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, reference, grid, problem, axis, axis_support, path, mean, drop, transfer, radii_sum, multiplicity,
         axial_mirror, tilt, load_offset, solved, completed] = record;
  io("name", name);
  io("reference", reference);
  io("grid", grid);
  io("axis", axis);
  io("axis_support", axis_support);
  io("path", path);
  io("mean", mean);
  io("drop", drop);
  io("radii_sum", radii_sum);
  io("multiplicity", multiplicity);
  io("axial_mirror", axial_mirror);
  io("tilt", tilt);
  io("load_offset", load_offset);
}

/// The pair with its `problem`.
const ContactPair &complete(const ContactPair &pair);

/// Distance of the two undeformed surfaces at (x, z), from the analytic profiles and never from facets: radii and
/// the drops of the two profiles (m on the radius, positive: smaller roll), shifted so that the smallest is zero.
Eigen::VectorXd profile_gap(const PatchGrid &grid, double first_radius, double second_radius,
                            const Eigen::VectorXd &drop);

/// Puts a pair together.  The patches must have the same grid.  For two slabs every load is per metre of length.
/// @param drop (n_z) m, sum of the two profiles' drops at the stations of the held rolls
ContactPair make_pair(const std::string &name, const CondensedRoll &first, const HeldRoll &first_held,
                      const CondensedRoll &second, const HeldRoll &second_held, const Eigen::VectorXd &drop);

/// The same for rolls shifted along each other: the middle of the second roll lies at `shift` (m) in the frame of
/// the first.  Both are whole; the axial grids need not match and are coupled by multipliers on the stations of
/// the first (fem/contact/mortar.h).  Moments count about mid-length of the first roll.
/// @param drop   m, sum of the two profiles' drops, at z in the frame of the first roll
ContactPair make_pair(const std::string &name, const CondensedRoll &first, const HeldRoll &first_held,
                      const CondensedRoll &second, const HeldRoll &second_held,
                      const std::function<double(double)> &drop, double shift);

/// Adds roll bending: forces (N) on the chocks at z > 0 and z < 0 of a roll held by the strip, positive towards
/// the contact.  On a quarter both sides carry the mean.
void bend(ContactPair &pair, const HeldRoll &roll, double right, double left);

/// Gives the rolls of an unshifted pair other profiles.  What was solved of it is forgotten.
/// @param drop (n_s) m, sum of the two profiles' drops
void change_profiles(ContactPair &pair, const Eigen::VectorXd &drop);

/// One solved load.
struct ContactPoint {
  contact::State state;
  double load;        ///< N, total
  double approach;    ///< m, axis to axis from the first touch; mean over the contact length; under load_offset at
                      ///< the force
  double tangent;     ///< N/m, exact dF/d(approach), with what else is imposed held
  double tilt   = 0;  ///< rad, of the axes, closing at z > 0
  double moment = 0;  ///< N m, of the contact force about mid-length
  Eigen::MatrixXd compliance;  ///< (k, k) d(approach, tilt)/d(force, moment), total: m/N, 1/N, 1/(N m)
};

template <class Io, class R, if_record<R, ContactPoint> = 0> void each_member(Io &&io, R &record)
{
  auto &[state, load, approach, tangent, tilt, moment, compliance] = record;
  io("state", state);
  io("load", load);
  io("approach", approach);
  io("tangent", tangent);
  io("tilt", tilt);
  io("moment", moment);
  io("compliance", compliance);
}
/// A load that starts from nothing is solved once, where the pair remembers its loads.
ContactPoint solve_load(const ContactPair &pair, double load, const std::vector<char> &start = {});

/// Loads of a pair that are solved, and numbers made from them by name.
class SolvedLoads {
public:
  struct Known {
    std::map<double, ContactPoint> points;  ///< by load
    std::map<std::string, Eigen::MatrixXd> numbers;
  };
  SolvedLoads() = default;
  explicit SolvedLoads(Known known);
  Known known() const;
  ContactPoint point(double load, const std::function<ContactPoint()> &solve);
  Eigen::MatrixXd number(const std::string &name, const std::function<Eigen::MatrixXd()> &make);

private:
  mutable std::mutex access;
  Known at;
};

template <class Io, class R, if_record<R, SolvedLoads::Known> = 0> void each_member(Io &&io, R &record)
{
  auto &[points, numbers] = record;
  io("points", points);
  io("numbers", numbers);
}

/// The number of this name, made once where the pair remembers.
Eigen::MatrixXd remembered(const ContactPair &pair, const std::string &name,
                           const std::function<Eigen::MatrixXd()> &make);

/// Approach (m) at which the undeformed rolls begin to touch: with their axes held at `tilt` (rad), counted at z =
/// 0; or, when `offset` (m) is given, free to tilt under a force there and counted there.
/// @param z, gap  (n) m, increasing stations and gap of the rolls there
double touching_approach(const Eigen::VectorXd &z, const Eigen::VectorXd &gap, double tilt, double offset);

/// Load-approach curve; each load starts from the active set of the one before.
/// @throws SolverError  names the load and how many steps are good
ContactCurve sweep(const ContactPair &pair, const Eigen::VectorXd &loads, const Progress &progress = {});

/// Station at mid-length.
int middle_station(const PatchGrid &grid);

/// Distribution along the contact line at one load.
BarrelProfile barrel_profile(const ContactPair &pair, const ContactPoint &point);

/// n loads from low to high, equally spaced in their logarithm.
Eigen::VectorXd log_spaced(double low, double high, int n);
}  // namespace mill::fem
