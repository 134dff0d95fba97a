#pragma once
#include "core/model/support_type.h"
#include "dynamics/cluster/contact_law.h"
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

// A planar stack of rigid rolls: what it consists of.  x rolling direction, y up; SI.
namespace mill::cluster {
struct Roll {
  std::string name;
  double radius          = 0;                        ///< m
  double length          = 0;                        ///< m
  double mass            = 0;                        ///< kg
  double inertia         = 0;                        ///< kg m2, about its axis
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< m, unloaded
};

/// Rolls a and b touch; one-sided.  theory.md 38.1
struct Contact {
  std::string name;  ///< "W-I"
  int a = 0, b = 0;  ///< index of the rolls
  ContactLaw law;
  double free_length = 0;     ///< m, distance of the axes at first touch
  double loss_factor = 0;     ///< -, of complex stiffness
  double damping     = 0;     ///< N s/m, of impact_force
  double depth       = 0;     ///< m, of impact_force
  double tangential  = 0;     ///< tangential over normal stiffness; 0: the contact is frictionless
  bool one_sided     = true;  ///< false: a spring that also pulls, of a straight law
  /// The strip between two rolls: a straight spring about the state at rest, whose free length settle() sets; 0:
  /// not yet, no spring.
  bool strip     = false;
  double carried = 0;  ///< N, strip: force at rest, which the loads of the stack put on both rolls

  /// Has the whole force reached zero?  The strip lets go where the fluctuation has taken all of what it carries.
  bool is_open(const double approach) const
  {
    return strip ? carried + law.k * approach <= 0 : one_sided && approach < 0;
  }
};

/// By how much two points (x, y) apart, `distance` from each other, are `now` farther after a motion of (dx, dy)
/// between them.  A difference of two lengths of a metre would leave 1e-16 m: times 1e10 N/m more than an
/// equilibrium is asked to.
inline double lengthened(const double x, const double y, const double dx, const double dy, const double distance,
                         const double now)
{
  return ((2 * x + dx) * dx + (2 * y + dy) * dy) / (now + distance);
}

/// Bearing law d = kappa F^q.  theory.md (38.8)
struct BearingLaw {
  double kappa = 0;  ///< m/N^q
  double q     = 1;  ///< -
};
BearingLaw bearing_through(double tangent, double force, double q);  ///< N/m at N; q = 1 needs no force
double bearing_force(const BearingLaw &law, double d);               ///< N, odd in d
double bearing_secant(const BearingLaw &law, double d);              ///< N/m; of a curved law not at d = 0
double bearing_tangent(const BearingLaw &law, double d);             ///< N/m
double bearing_energy(const BearingLaw &law, double d);              ///< J

/// What holds one roll from the ground.
struct Support {
  using Type = SupportType;
  std::string name;
  int roll  = 0;
  Type type = Type::radial;
  BearingLaw law;
  double across          = 0;   ///< N/m, isotropic: in x
  double direction       = 0;   ///< rad, guide; rollers: outward normal of the contact they press together
  double half_angle      = 0;   ///< rad, rollers: either side of the normal
  double preload         = 0;   ///< N, of each roller
  double guard           = 0;   ///< N/m, rollers: holds a roll that has left its contact
  int against            = -1;  ///< rollers: roll that theirs presses
  double loss_factor     = 0;   ///< -
  Eigen::Vector2d anchor = Eigen::Vector2d::Zero();  ///< m, where the law has its zero (rollers: its preload)
};

/// A force that one pass puts on the stack.
struct Load {
  int roll              = 0;
  Eigen::Vector2d force = Eigen::Vector2d::Zero();  ///< N
};

struct Stack {
  std::vector<Roll> rolls;
  std::vector<Contact> contacts;
  std::vector<Support> supports;
  std::vector<Load> loads;       ///< rolling force: rollers are set under it
  std::vector<Load> side_loads;  ///< come on top of it
  bool gravity = true;
  /// Rolls have a third unknown each, their rotation times their radius, and contacts are tangential springs about
  /// the state at rest, in which no tangential force acts.
  bool coupled = false;

  int per_roll() const
  {
    return coupled ? 3 : 2;
  }
  int size() const
  {
    return per_roll() * int(rolls.size());
  }
};

constexpr double free_fall = 9.80665;  ///< m/s2

/// Displacements from the unloaded centres, per_roll() a roll: u_x, u_y in m, R times rotation in m.
using Motion = Eigen::VectorXd;

Eigen::VectorXd masses(const Stack &stack);  ///< kg, of every unknown

/// Where a contact stands at a displacement.
struct ContactState {
  double distance        = 0;                         ///< m, of the axes
  double approach        = 0;                         ///< m, negative: open
  Eigen::Vector2d normal = Eigen::Vector2d::UnitY();  ///< from a to b
};
/// @param u  per_roll() or, of a coupled stack at rest, two unknowns a roll
ContactState contact_state(const Stack &stack, const Contact &contact, const Motion &u);
double contact_force(const Contact &contact, double approach);  ///< N; of the strip the whole force, never < 0
/// N, what the contact puts on its rolls in addition to the loads: of the strip the change of its force.
double added_force(const Contact &contact, double approach);
double contact_tangent(const Contact &contact, double approach);  ///< N/m
double contact_energy(const Contact &contact, double approach);   ///< J, stored by added_force()

/// Slip of a coupled contact over the unknowns, one row.  theory.md (38.18)
Eigen::VectorXd slip_row(const Stack &stack, const Contact &contact, const Eigen::Vector2d &normal);

/// Unit vectors of the two rollers of a support, from the roll outwards.
std::array<Eigen::Vector2d, 2> roller_directions(const Support &support);
/// N, of either roller at a displacement of its roll.
std::array<double, 2> roller_forces(const Support &support, const Eigen::Vector2d &u);

/// N, of a support on its roll at a displacement of that.
Eigen::Vector2d support_force(const Support &support, const Eigen::Vector2d &u);

/// Forces at rest; one sum of each, so that balances can be checked.
struct Forces {
  Eigen::VectorXd total;                      ///< N, on every unknown: all of the below
  Eigen::VectorXd loads, contacts, supports;  ///< N, gravity is a load
};
Forces forces(const Stack &stack, const Motion &u);

/// -d(force)/d(displacement), symmetric, N/m; each part separately.  theory.md (38.9)
struct Tangent {
  Eigen::MatrixXd total;
  std::vector<Eigen::MatrixXd> contacts;   ///< of every contact, geometric term included
  std::vector<Eigen::MatrixXd> geometric;  ///< that term alone
  std::vector<Eigen::MatrixXd> supports;
};
Tangent tangent(const Stack &stack, const Motion &u);
Eigen::MatrixXd total_tangent(const Stack &stack, const Motion &u);

/// J, of contacts and supports, less the work of the loads.
double potential_energy(const Stack &stack, const Motion &u);
}  // namespace mill::cluster
