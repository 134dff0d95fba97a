#pragma once
#include "dynamics/cluster/motion.h"

namespace mill::cluster {
/// The equations of motion in flat arrays, without allocation.  State: displacement from rest, velocity, work of
/// drive and damping, impulse of the outer forces along x and y.  Approaches are counted from rest, so that a
/// small vibration keeps its digits next to the large diameters.  theory.md (38.20)
class MotionEquations {
public:
  MotionEquations(const Stack &stack, const Motion &rest, const std::vector<Drive> &drives);

  int unknowns() const
  {
    return n_;
  }
  int size() const  ///< of the state
  {
    return 2 * n_ + 3;
  }
  int contacts() const
  {
    return int(contacts_.size());
  }
  bool one_sided(int contact) const
  {
    return contacts_[std::size_t(contact)].one_sided || contacts_[std::size_t(contact)].carried > 0;
  }
  void slope(double time, const double *state, double *slope) const;
  /// m, of every contact; of the strip its whole force over its stiffness.  Positive: closed.
  void approaches(double time, const double *state, double *approach) const;
  /// N, whole force of every contact, damping included
  void contact_forces(double time, const double *state, double *forces) const;
  double energy(const double *state) const;  ///< J, zero at rest
  const Eigen::VectorXd &mass() const
  {
    return mass_;
  }

private:
  struct OneContact {
    int a, b;
    ContactLaw law;
    double x, y, distance, approach;  // at rest
    double damping, depth;
    bool one_sided;
    double carried;       // N, at rest; above zero: the strip
    double drive, omega;  // N, 1/s, of what the strip carries
  };
  struct Now {
    double nx, ny, approach, rate;
  };
  struct OneSupport {
    int roll;
    Support::Type type;
    double kappa, power;      // F = (d/kappa)^power
    double x, y;              // displacement from the anchor at rest
    double tx[2], ty[2], d0;  // guide: the first direction; rollers: both
    double across, guard;
  };
  struct OneDrive {
    int roll;
    double x, y, omega;
  };
  static Now now(const OneContact &c, const double *state, int n);
  static double elastic_force(const OneContact &c, double approach);
  static double pushing(const OneContact &c, const Now &s, double time);
  static double stored(const OneContact &c, double approach);
  static void support_force(const OneSupport &s, double dx, double dy, double *force);

  static double stored(const OneSupport &s, double x, double y);

  int n_;
  Eigen::VectorXd mass_, constant_;  // loads and weight
  std::vector<OneContact> contacts_;
  std::vector<OneSupport> supports_;
  std::vector<OneDrive> drives_;
  Stack stack_;
};
}  // namespace mill::cluster
