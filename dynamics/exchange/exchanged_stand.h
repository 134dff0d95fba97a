#pragma once
#include "core/records/records.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modal_model.h"
#include "dynamics/response/response.h"
#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

// The driven stand as matrices for other programs.  theory.md 35.7
namespace mill::dynamics {
/// M q'' + C q' + K q = b (F - F_mean) with n unknowns: the masses of a chain, or the modes of a detailed stand.
/// m points are looked at:  y = point q,  a = point q'',  F_cell = load_cell . q + load_cell_share F_mean.
struct ExchangedStand {
  std::string name;                   ///< an identifier: package, function, name of the folder
  std::string title, origin, method;  ///< of the case; "case four-high-1400, pass 1"; "chain of six masses"
  std::string program;                ///< "millstand 0.1.0"
  std::string force_text;             ///< what F is, and which way it pushes
  bool modal = false;                 ///< unknowns are modes: M is the identity, K is diagonal
  std::vector<std::string> unknowns;  ///< (n) identifiers: "upper_work_roll", "mode_1"
  Eigen::VectorXd frequency;          ///< (n) Hz, undamped, ascending
  double leading_frequency = 0;       ///< Hz, of the mode that yields most under the rolling force
  Eigen::MatrixXd M, C, K;            ///< (n, n) kg, N s/m, N/m; of modes -, 1/s, 1/s^2
  Eigen::VectorXd b;                  ///< (n) -; of modes kg^-1/2
  std::vector<std::string> points;    ///< (m) identifiers
  Eigen::MatrixXd point;              ///< (m, n) -; of modes kg^-1/2
  Eigen::VectorXd load_cell;          ///< (n) N/m; of modes N/m kg^-1/2
  double load_cell_share = 1;         ///< -
  double mean_force      = 0;         ///< N
  double modal_damping   = 0;         ///< -, ratio of critical of every mode; is part of C
  double gap_damper      = 0;         ///< N s/m, between the work rolls; is part of C
  Eigen::MatrixXd dampers;            ///< (r, n) rows of the dampers of oil films in modes, part of C; empty: none
  std::vector<Spring> springs;        ///< of a chain
  std::map<std::string, std::string> source;  ///< where M1.., K1.., C, modal_damping, F_mean come from
  ForceRecord series;                         ///< recorded force; empty: none
  double step         = 0;                    ///< s, between output times
  double step_force   = 0;                    ///< N, of the test in which the force jumps
  double step_peak[2] = {0, 0};  ///< m/s2, largest acceleration of the work rolls in it, upper and lower
};

/// Matrices, points and load cell of a chain or of modes; names, sources, mean force and record are the caller's.
ExchangedStand exchanged(const MillModel &chain, const DynamicsSettings &settings, double gap_damper);
ExchangedStand exchanged(const ModalModel &modes);

/// A state, an input or an output of the first-order form.
struct Signal {
  std::string name;  ///< "v_upper_work_roll"
  std::string unit;  ///< "m/s"
  std::string text;
};
std::vector<Signal> states_of(const ExchangedStand &stand);   ///< (2n) q, then q'
std::vector<Signal> outputs_of(const ExchangedStand &stand);  ///< (2m+1) accelerations, displacements, load cell
Signal input_of(const ExchangedStand &stand);                 ///< F - F_mean

/// x = (q, q'):  A = [0 I; -M^-1 K  -M^-1 C],  B = [0; M^-1 b],  outputs a, y and the change of F_cell.  (35.9)
StateSpace first_order_form(const ExchangedStand &stand);

/// Largest difference of a first-order form from our own model: of frequency and damping of every pole over its
/// frequency, and of the response of accelerations and load cell over the largest of its row, from a tenth of the
/// lowest mode to three times the highest one.  theory.md 35.7
/// @param form  outputs as outputs_of()
/// @param own   the model that simulate drives
double difference_from(const StateSpace &form, const DrivenModel &driven, const Eigen::VectorXd &frequency);
constexpr double exchange_agreement = 1e-8;

/// Fills step_force and step_peak: the force jumps once from the equilibrium under its mean.
void add_step_test(ExchangedStand &stand, const DrivenModel &driven);
constexpr double step_test_begin = 0.01, step_test_end = 0.11;  // s
}  // namespace mill::dynamics
