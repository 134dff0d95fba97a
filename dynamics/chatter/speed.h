#pragma once
#include "core/records/stability_finding.h"
#include "dynamics/chatter/chatter.h"
#include "reduce/bite/linear/linear_coefficients.h"
#include <Eigen/Core>
#include <array>
#include <complex>
#include <functional>
#include <optional>
#include <string>
#include <vector>

// At which roll speed vibration begins to grow.  theory.md 25.3
namespace mill::dynamics {
/// The system at a roll speed in m/s.  Throws InputError or SolverError without a steady bite.
using MatrixAtSpeed = std::function<Eigen::MatrixXd(double)>;

/// (s) roots of the system at a roll speed, 1/s, in any order; a real system: with their conjugates.  For systems
/// that are not a matrix (delays); their number may change with the speed.  Throws as MatrixAtSpeed.
using RootsAtSpeed = std::function<Eigen::VectorXcd(double)>;

/// Where to look.
struct SpeedRange {
  double from      = 1;        ///< m/s, > 0
  double to        = 30;       ///< m/s, > from
  double step      = 1;        ///< m/s, of the first grid
  double finest    = 1. / 32;  ///< m/s, to which intervals are halved in which roots may touch the axis unseen
  double tolerance = 1e-10;    ///< m/s, of a crossing
};

/// One speed that was tried.
struct SpeedPoint {
  double speed     = 0;          ///< m/s
  double growth    = not_given;  ///< 1/s, largest real part; nan: no bite
  double frequency = not_given;  ///< Hz, of that root
  int unstable     = 0;          ///< roots that grow, both of a pair
  Eigen::VectorXcd roots;        ///< (s) 1/s, by falling real part; empty: no bite
  std::string no_bite;           ///< why the bite has no steady state; empty: it has one
};

/// A root, or a pair, on the imaginary axis.
struct Crossing {
  double speed  = not_given;     ///< m/s
  bool upward   = true;          ///< it grows above this speed
  bool of_stand = true;          ///< the stand as a whole changes between stable and unstable here; false: another
                                 ///< root grows on both sides
  double frequency = not_given;  ///< Hz; 0: no vibration, the stand drifts away without vibration
  double slope     = not_given;  ///< 1/s per m/s, of the real part
  std::complex<double> root;     ///< 1/s
};

using Verdict = StabilityFinding;

/// Answer of a search.
struct CriticalSpeed {
  Verdict verdict  = Verdict::no_bite;
  double speed     = not_given;     ///< m/s, lowest crossing upward of the stand; nan unless Verdict::crossing
  double frequency = not_given;     ///< Hz there
  std::vector<Crossing> crossings;  ///< all of them, by speed
  /// Growth nearest to the other verdict, 1/s: the largest where all is stable, the smallest where all is unstable
  double margin       = not_given;  ///< 1/s; nan unless Verdict::stable or unstable
  double margin_speed = not_given;  ///< m/s, where that is
  double lowest_bite  = not_given;  ///< m/s, lowest speed of the range with a steady bite
  double highest_bite = not_given;  ///< m/s
  std::string below;                ///< why the bite ends just below lowest_bite; empty: end of the range
  std::string above;                ///< the same above highest_bite
  /// m/s, the last stable and the first unstable speed on both sides of speeds without an answer; nan unless
  /// Verdict::unstable_beyond_gap
  std::array<double, 2> gap{not_given, not_given};
  std::string gap_reason;          ///< why there is none just above gap[0]
  std::vector<SpeedPoint> points;  ///< by speed
};

/// Scans the range, halves the intervals in which a root may cross the axis twice unseen (judged by the bend of
/// its path at the ends), and solves for every crossing.  A rise and fall that is over within a step and leaves no
/// trace in the neighbouring slopes is not seen: a smaller step sees it.
///
/// Roots within 1e-9 of their modulus from the axis count as standing on it, not as growing: an undamped structure
/// has such.
///
/// @throws InputError  a range that is empty, not finite or not above zero
/// Cost: 70 to 90 calls of `roots` for 1 to 30 m/s.
CriticalSpeed crossings_of_roots(const RootsAtSpeed &roots, const SpeedRange &range = {});

/// The same for a matrix.
CriticalSpeed critical_speed(const MatrixAtSpeed &matrix, const SpeedRange &range = {});

/// What the search of a stand found, with its bite.
struct StandSpeed : CriticalSpeed {
  std::vector<bite::BiteState> states;  ///< by points; without a bite an empty state
  std::optional<WorkingPoint> at;       ///< at the critical speed
};

/// Critical speed of one stand: at every speed the steady bite with its flattening and film is solved again.
/// @param bite  its roll_speed is not read
/// Cost: 70 to 90 working points and eigenproblems, some 8 ms with six masses.
StandSpeed critical_speed(const ChatterStandModel &stand, const bite::RollBite &bite, Linearisation scheme,
                          const SpeedRange &range = {});

/// Matrix of a stand over its speed.
MatrixAtSpeed matrix_at_speed(const ChatterStandModel &stand, const bite::RollBite &bite, Linearisation scheme);

/// "unstable above 18.207 m/s (128.1 Hz)", with the margin when nothing crosses, and the edges of the bite
/// with their reason.
std::string sentence(const CriticalSpeed &critical, const SpeedRange &range);
}  // namespace mill::dynamics
