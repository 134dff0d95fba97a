#pragma once
#include "core/base/warning.h"
#include "core/records/csv.h"
#include "core/records/records.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modal_model.h"
#include "dynamics/response/time_integration.h"
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace mill::dynamics {
/// A linear model of the stand as it is driven: its first-order form and what its outputs are.
struct DrivenModel {
  StateSpace system;                ///< outputs: accelerations of m points, then the change of the load-cell force
  std::vector<std::string> labels;  ///< (m) points; the first six are those of M1..M6
  double load_cell_share = 1;       ///< -, part of the mean bite force that the load cell shows
};
DrivenModel driven_model(const MillModel &model);
DrivenModel driven_model(const ModalModel &model);

/// Motion of the points of a stand under a force record, n output times.
struct Response {
  std::vector<std::string> labels;  ///< (m) what moves, columns of acceleration
  Eigen::VectorXd time;             ///< (n) s
  Eigen::VectorXd force;            ///< (n) N, bite force on the straight lines between its samples
  Eigen::MatrixXd acceleration;     ///< (n, m) m/s2, up positive
  Eigen::VectorXd load_cell;        ///< (n) N, force in the lower frame with its static share (6.8)
  HoldForm form;                    ///< how it was integrated
  std::string note;                 ///< why not as usual; empty
};

/// Drives a model with a force record from rest in the equilibrium under its first sample.  theory.md 7
/// @param force        N, the whole bite force; the displacements count from the state under its mean
/// @param output_rate  Hz
/// Errors and cost as first_order_hold.
Response mill_response(const DrivenModel &model, const ForceRecord &force, double output_rate,
                       HoldForm wanted = HoldForm::modal);
Response mill_response(const MillModel &model, const ForceRecord &force, double output_rate,
                       HoldForm wanted = HoldForm::modal);

/// Peak and rms of an acceleration.
struct Level {
  double peak;  ///< m/s2, largest absolute value
  double rms;   ///< m/s2, about zero
};
Level level(const Eigen::VectorXd &acceleration);

/// Sentence when the output is too coarse to show the peaks of the highest mode (fewer than 20 points per period:
/// a peak may be seen up to 1.2 % low); empty when it is fine.
std::optional<Warning> output_rate_warning(double output_rate, double highest_mode);

/// One roll, computed and measured.
struct RollComparison {
  Level computed;
  Level measured;
  double peak_ratio;  ///< -, computed / measured
  double rms_ratio;   ///< -, computed / measured
};

/// Computed and measured accelerations over the time that both records cover.
struct Comparison {
  double begin;  ///< s
  double end;    ///< s
  RollComparison upper_work_roll;
  RollComparison lower_work_roll;
};

/// @throws InputError  the two records share fewer than two samples of either
Comparison compare(const Response &response, const MeasuredRecord &measured);

/// The response as it is written: time [s], upper_work_roll [g], lower_work_roll [g], the other four masses [g],
/// further points [g], force [kN], load_cell [kN].
Table response_table(const Response &response);
}  // namespace mill::dynamics
