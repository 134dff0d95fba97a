#pragma once
#include "dynamics/chatter/chatter.h"
#include <vector>

// The vibrating stand in time, linear and exact, and what a record of it determines.  theory.md 26
namespace mill::dynamics {
/// (2n+2) state z = (x, x', d sigma_e, d sigma_d) with both work rolls away from the strip by `distance` and all
/// else at rest.  Where the gap is the sum of the two points "upper work roll" and "lower work roll" (six masses)
/// it is the displacement of least kinetic norm x' M x with these two, i.e. x_2 = x_3 = distance and all other
/// bodies at zero; otherwise (modes) the one of least norm with the gap change 2 distance.  theory.md (26.5)
/// @param distance  m
Eigen::VectorXd displaced_rolls(const StandStructure &structure, double distance);

/// (2n+2) state of the mode that grows fastest, at the moment at which the gap is open widest, by `gap`.
/// @param gap  m
Eigen::VectorXd critical_mode(const ChatterStandModel &stand, const bite::LinearCoefficients &by, double gap);

/// A record of k moments.  All but time and points are changes from the steady bite.
struct ChatterHistory {
  Eigen::VectorXd time;           ///< (k) s, evenly spaced
  Eigen::VectorXd gap, gap_rate;  ///< (k) m, m/s
  Eigen::VectorXd force;          ///< (k) N
  Eigen::VectorXd entry_tension;  ///< (k) Pa
  Eigen::VectorXd exit_tension;   ///< (k) Pa
  Eigen::VectorXd friction;       ///< (k) -
  Eigen::MatrixXd point;          ///< (m, k) m, displacement of each point away from the strip
  Eigen::VectorXd last;           ///< (2n+2) state at the last moment, from which a run goes on
};

/// Linear motion, exact at every moment:  z(t + dt) = exp(A dt) z(t).
/// @param start     (2n+2) state, as displaced_rolls
/// @param duration  s
/// @param rate      Hz, of the moments
/// @throws InputError  duration or rate not positive
/// Cost: 0.1 ms and 0.5 us per moment for six masses.
ChatterHistory linear_history(const ChatterStandModel &stand, const bite::LinearCoefficients &by,
                              const Eigen::VectorXd &start, double duration, double rate = 10e3);

/// One exponential of a record:  amplitude e^(growth t) cos(2 pi frequency t + phase).
struct RecordMode {
  double growth    = 0;  ///< 1/s
  double frequency = 0;  ///< Hz
  double amplitude = 0;  ///< of the signal, at the first sample
};

/// Growth and frequency of the motions a record consists of, the strongest at its end first.
/// State-space fit: delayed copies of the signal, their dominant directions, the shift between neighbours, and a
/// regression of logarithm and phase of each motion over the record.  theory.md (26.7)
/// @param signal  (k) k >= 40 evenly spaced samples
/// @param step    s
/// @param noise   -, directions weaker than this share of the strongest are left out
/// Returns nothing for a signal that is zero or too short.
/// Cost: 10 ms for 10000 samples.
/// Source: Y. Hua, T. K. Sarkar, IEEE Trans. Acoust. Speech Signal Process. 38 (1990) 814.
std::vector<RecordMode> record_modes(const Eigen::VectorXd &signal, double step, double noise = 1e-7);

/// The motion nearest a frequency.
/// @throws SolverError  the record has none within a tenth of it
RecordMode mode_near(const std::vector<RecordMode> &modes, double frequency);
}  // namespace mill::dynamics
