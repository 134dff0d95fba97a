#pragma once
#include "dynamics/chatter/chatter.h"
#include "dynamics/chatter/speed.h"
#include "dynamics/tandem/delay.h"
#include <string>
#include <vector>

// Several stands with the strip between them: shared tension, and waviness that arrives later.  theory.md 28
namespace mill::dynamics {
/// One stand of a tandem.
struct TandemStand {
  std::string name;          ///< "stand 4"
  StandStructure structure;  ///< n_i unknowns
  bite::RollBite bite;       ///< its roll_speed is not read
};

/// N >= 1 stands in the order of rolling.  The strip before the first and behind the last one ends at constant
/// speed.
struct TandemLine {
  std::vector<TandemStand> stands;
  std::vector<double> distance;   ///< (N - 1) m, between neighbours
  double entry_distance = 0;      ///< m, before the first stand
  double exit_distance  = 0;      ///< m, behind the last stand
  double strip_modulus  = 210e9;  ///< Pa
  Linearisation scheme  = Linearisation::sequential;
};

/// @throws InputError  no stand; distances that are missing or not above zero; thickness, tension or width that
/// differ by more than 1e-6 between neighbours.  All in one text.
void check_tandem(const TandemLine &line);

/// Steady state of all stands: mass flow ties their speeds.
struct TandemPoint {
  std::vector<WorkingPoint> stands;  ///< (N)
  std::vector<double> delay;         ///< (N - 1) s, from stand i to i + 1
};

/// @param speed  m/s, of the rolls of the last stand
/// @throws InputError, SolverError  as working_point, naming the stand and its speed
/// Cost: 6 steady bites per stand.
TandemPoint tandem_point(const TandemLine &line, double speed);

/// The tandem as a system with delays.  States: x, x' of the first stand, of the second, ..., then N + 1 tensions.
/// Signals: change of the thickness that leaves stand 1..N-1.
DelaySystem tandem_system(const TandemLine &line, const TandemPoint &point);

/// How much the stands know of each other.
enum class TandemCoupling {
  alone,     ///< strip between stands ends at constant speed on both sides
  tension,   ///< one tension between two stands; the thickness that enters is constant
  immediate  ///< with the thickness as it leaves the stand before, without transport: a limit, not a mill
};

/// Matrix of one stand at its place, the strip on both sides ending at constant speed: chatter_matrix.
Eigen::MatrixXd stand_alone(const TandemLine &line, const TandemPoint &point, std::size_t i);

/// Matrix without delay.  Alone: the stands in blocks, 2 n_i + 2 states each.
Eigen::MatrixXd tandem_matrix(const TandemLine &line, const TandemPoint &point, TandemCoupling coupling);

/// Rightmost root of the full tandem at a speed of the last stand, 1/s.
std::complex<double> tandem_root(const TandemLine &line, double speed);

/// What one stand does in a root.
struct TandemShare {
  std::string stand;
  double gap   = 0;  ///< -, amplitude of its gap over the largest one
  double phase = 0;  ///< deg, -180..180, against the largest one
};

/// Growth over speed of the last stand.  Where the roots with delay are not found, full, frequency and loop_gain
/// are nan and unstable is -1.
struct TandemCurves {
  Eigen::VectorXd speed;       ///< (k) m/s, of the rolls of the last stand; speeds without a bite are left out
  Eigen::MatrixXd roll_speed;  ///< (N, k) m/s
  Eigen::MatrixXd delay;       ///< (N - 1, k) s
  Eigen::VectorXd alone;       ///< (k) 1/s, largest of all stands
  Eigen::VectorXd tension;     ///< (k) 1/s, shared tension only
  Eigen::VectorXd full;        ///< (k) 1/s, with the thickness that arrives later
  Eigen::VectorXd frequency;   ///< (k) Hz, of the full root
  Eigen::VectorXd loop_gain;   ///< (k) -, of the regenerative loop: below one it is harmless for any delay
  Eigen::VectorXi unstable;    ///< (k) -, roots of the full tandem that grow, both of a pair
};

/// What the report shows of a tandem.
struct TandemStudy {
  std::vector<std::string> names;      ///< (N) of the stands
  std::vector<CriticalSpeed> stand;    ///< (N) each alone, in speed of the last stand's rolls
  CriticalSpeed tension;               ///< shared tension only
  CriticalSpeed full;                  ///< with transport
  double any_delay = not_given;        ///< m/s, up to which the tandem is stable for any distances; nan: nowhere
  std::vector<TandemShare> share;      ///< (N) at the full critical speed; empty where its root does not settle
  std::complex<double> critical_root;  ///< 1/s, there
  TandemPoint point;                   ///< steady state there; empty without a crossing
  TandemCurves curves;                 ///< over the range
  TandemCurves lobes;                  ///< some lobes around the full critical speed
  std::vector<std::string> sentences;  ///< what follows, with numbers
};

/// @param points  of the curves
TandemStudy tandem_study(const TandemLine &line, const SpeedRange &range = {}, int points = 60);
}  // namespace mill::dynamics
