#pragma once
#include "chatter_data.h"
#include <array>
#include <vector>

// The roll bite of Bland and Ford at one moment of a vibrating mill, in plain numbers and without any library: the
// theory of reduce/bite/linear/unsteady_bite once more, for what travels in a unit; the laws are those of
// core/laws. theory.md 8.2 to 8.7, 26.1
namespace mill::fmu {
/// Gap (m), gap rate (m/s), entry tension (Pa), exit tension (Pa), entry thickness (m).
using BiteMoment = std::array<double, 5>;

struct BiteReading {
  double entry_speed = 0, exit_speed = 0;  ///< m/s
  double force          = 0;               ///< N
  double friction       = 0;               ///< -
  double exit_thickness = 0;               ///< m, where the strip leaves the rolls
  bool contact          = true;            ///< the rolls touch the strip
  double from_exit = 1, from_entry = 1;  ///< rad, of the neutral point from both ends; below zero: the rolls skid
};

/// A steady bite and what keeps its value while it vibrates.
class RollBite {
public:
  /// Solves the steady state with Hitchcock's flattened radius.
  /// @throws std::runtime_error  there is no steady state: the message names the cause
  explicit RollBite(const PassData &pass);

  const BiteReading &steady() const
  {
    return steady_;
  }
  double flattened_radius() const
  {
    return radius_;
  }
  const BiteMoment &steady_moment() const
  {
    return moment_;
  }
  /// Cost: 3 us.
  BiteReading at(const BiteMoment &moment) const;

  /// What is left of the draft, m; not above zero: the strip is free.  (26.3)
  double contact_reserve(const BiteMoment &moment) const;
  /// 1 - tension over flow stress at entry and exit; below zero the strip tears.
  std::array<double, 2> yield_reserve(const BiteMoment &moment) const;

private:
  struct Inputs;
  struct Contact;
  struct Rule {
    std::vector<double> node, weight;
  };
  Inputs inputs_at(const BiteMoment &moment) const;
  double stress_at(const Inputs &in, double thickness) const;
  Contact contact_of(const Inputs &in, double entry_speed, bool held) const;
  Contact settled(const Inputs &in, double entry_speed) const;
  double force_of(const Inputs &in, const Contact &c) const;
  double side_of(const Inputs &in, const Contact &c, double from, double to, bool entry_side) const;
  void limit(Inputs &in) const;
  double thickness_at_exit(const Inputs &in) const;
  void choose_rules();
  void flatten();

  enum class Scheme { sequential, implicit, frozen_friction };

  PassData pass_;
  Scheme scheme_;
  Rule entry_rule_, exit_rule_;
  std::vector<double> kinks_;  // strains
  double radius_ = 0;
  BiteMoment moment_{};
  BiteReading steady_;
};
}  // namespace mill::fmu
