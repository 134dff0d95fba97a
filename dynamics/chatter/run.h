#pragma once
#include "dynamics/chatter/history.h"
#include "reduce/bite/linear/unsteady_bite.h"
#include <string>
#include <vector>

// The vibrating stand in time with the whole bite: any amplitude, slack strip, lost contacts.  theory.md 26
namespace mill::dynamics {
/// Two rolls pressed together that can part.  The structure contains the spring; its force is preload + k row . x
/// and never below zero.
struct RollContact {
  std::string name;     ///< "upper backup roll on upper work roll"
  Eigen::VectorXd row;  ///< (n) -, row . x = approach of the two
  double stiffness;     ///< N/m
  double preload;       ///< N
};

/// Both contacts between work and backup rolls under the rolling force, as preload.
/// @param upper, lower  N/m, of the springs between work and backup roll
/// @throws InputError   the structure has no points of those names
std::vector<RollContact> roll_contacts(const StandStructure &structure, double upper, double lower,
                                       double rolling_force);

/// The same for a structure whose unknowns are the six bodies: the stiffnesses are read off its matrix.
/// @throws InputError  not six masses
std::vector<RollContact> roll_contacts(const StandStructure &six_masses, double rolling_force);

struct ChatterRunOptions {
  double duration      = 0.6;   ///< s
  double rate          = 10e3;  ///< Hz, of the moments of the record
  double tolerance     = 1e-8;  ///< -, relative error per step
  double strip_density = 7850;  ///< kg/m3, for a strip that no roll touches
  std::vector<RollContact> contacts;
};

/// What changes at an event.
enum class ChatterChange {
  entry_slack,
  entry_taut,
  exit_slack,
  exit_taut,
  strip_free,     ///< the gap opens beyond the strip
  strip_gripped,  ///< and closes on it again
  skid_exit,      ///< neutral point leaves the arc at the exit: strip slower than the rolls
  skid_entry,     ///< at the entry: strip faster than the rolls
  grip,           ///< neutral point back on the arc
  rolls_part,     ///< work and backup roll
  rolls_meet
};
const char *in_words(ChatterChange change);

struct ChatterEvent {
  double time;  ///< s
  ChatterChange change;
  int contact = -1;  ///< index of the roll contact, if it is one
};

/// Record, events and why it ended.
struct ChatterRun {
  ChatterHistory history;            ///< moments up to the end
  std::vector<ChatterEvent> events;  ///< in time; skidding from the start is an event at zero
  std::string stopped;               ///< empty: whole duration; else the reason with its numbers
  double end = 0;                    ///< s, reached
  long steps = 0;                    ///< of the integrator
  long bites = 0;                    ///< evaluations of the bite
};

/// Motion with the whole nonlinear bite: the flattened radius is that of the steady state.
/// CVODE (Adams, Newton with exact Jacobian) restarts at every event.
/// @param point  steady bite
/// @param start  (2n+2) state as displaced_rolls; a tension below zero in total is slack to be taken up
/// @throws InputError  duration, rate or tolerance not positive, a start without a bite
/// A run that cannot go on (strip torn, gap closed) is returned up to there with its reason.
/// Cost: 0.1 s per second of small motion of six masses, 0.3 to 0.7 s where every swing has edges.
ChatterRun nonlinear_run(const ChatterStandModel &stand, const WorkingPoint &point, Linearisation scheme,
                         const Eigen::VectorXd &start, const ChatterRunOptions &options = {});

/// What a run comes to.
struct LimitCycle {
  double amplitude = 0;             ///< m, half the gap's peak to peak over the last cycles
  double frequency = 0;             ///< Hz, of the last cycles; nan: no swings
  double drift     = 0;             ///< 1/s, relative growth of the amplitude between the two last windows
  bool settled     = false;         ///< |drift| below the limit given
  std::vector<std::string> limits;  ///< events of the last cycles, each once; empty: the smooth bite alone
};

/// @param cycles       in each of the two windows compared
/// @param settled_drift  1/s
LimitCycle limit_cycle(const ChatterRun &run, int cycles = 10, double settled_drift = 0.01);
}  // namespace mill::dynamics
