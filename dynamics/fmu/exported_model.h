#pragma once
#include "core/model/dynamics_settings.h"
#include "core/records/records.h"
#include "dynamics/fmu/runtime/model_data.h"
#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

namespace mill::fmu {
/// Rows of a run that the unit must reproduce before it is written: equal steps of a force that is linear over
/// each step, from rest under the first force.
struct CheckRun {
  double step = 0;               ///< s
  Eigen::VectorXd force;         ///< (k) N
  Eigen::MatrixXd acceleration;  ///< (k, points) m/s2
  Eigen::VectorXd load_cell;     ///< (k) N
  /// Kind "chatter" has these instead of the two: outputs of the unit by name, each relative to its own largest
  /// value.
  std::vector<std::string> names;  ///< (r)
  Eigen::MatrixXd values;          ///< (k, r)
  double agreement = 1e-9;         ///< -, largest relative difference that is allowed
};

/// What an exported unit is made of.
struct ExportedModel {
  ModelData data;          ///< its guid is made from the rest (model_text.h)
  std::string identifier;  ///< of C: "four_high_1400"
  std::string title;       ///< of the case
  std::string origin;      ///< "case four-high-1400, pass 1 at 976.2 kN"
  ForceMeaning force_meaning = ForceMeaning::measured;
  std::string method;                         ///< "six-mass chain"
  std::string program;                        ///< "millstand 0.1.0"
  std::map<std::string, std::string> source;  ///< by variable, where its start value comes from
  ForceRecord series;                         ///< that travels along; empty: none
  double step = 0;                            ///< s, proposed communication step
  CheckRun check;
};
}  // namespace mill::fmu
