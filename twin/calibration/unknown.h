#pragma once
#include <Eigen/Core>
#include <limits>
#include <string>

// What is fitted, and what its name says.  theory.md 44
namespace mill::twin {
/// What an unknown moves; its name says it, and nothing else reads the name for it.
enum class Moves {
  parts,      ///< "K3", "mass upper work roll", "K1/K7": springs and masses, by one factor
  ratios,     ///< "zeta": the damping ratios of all modes by one factor
  ratio,      ///< "zeta2": that of the second mode
  frequency,  ///< "f2": the frequency of the second mode, with its shape and ratio kept; not together with parts
  gain,       ///< "gain": all accelerations by one factor
  delay       ///< "delay": s, by which the accelerations are later than the force (two clocks)
};

/// The names of what is not a part.
constexpr const char *ratios_name = "zeta", *gain_name = "gain", *delay_name = "delay";
std::string ratio_name(Eigen::Index mode);  ///< "zeta2" of mode 1, counted from 0

struct Moved {
  Moves what        = Moves::parts;
  Eigen::Index mode = -1;  ///< from 0, of a ratio or a frequency
};
Moved moved_by(const std::string &name);

/// A number that is fitted: theta = ln of a factor on the value of the case; of the delay seconds.
struct Unknown {
  std::string name;
  double prior_sd = std::numeric_limits<double>::infinity();  ///< standard deviation of theta before the record
  double prior    = 0;                                        ///< theta before the record
};

/// What one unknown or its result moves.
template <class Named> Moves moves(const Named &unknown)
{
  return moved_by(unknown.name).what;
}

/// All damping ratios together, or one of them.
template <class Named> bool moves_damping(const Named &unknown)
{
  const Moves what = moves(unknown);
  return what == Moves::ratios || what == Moves::ratio;
}
}  // namespace mill::twin
