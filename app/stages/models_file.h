#pragma once
#include "app/stages/model_stage.h"
#include "reduce/chain/mass_breakdown.h"
#include "reduce/stand/masses_needed.h"
#include <string>
#include <vector>

namespace mill {
/// How the frequencies of the assembled stand settle with the modes that its parts keep.
struct KeptModes {
  std::vector<int> kept;      ///< (s) fixed-interface modes of each part
  Eigen::VectorXd frequency;  ///< (m) Hz, with all of them
  Eigen::MatrixXd error;      ///< (m, s) -, relative to those
};

/// What curves/models.json is made of.
struct ModelsFile {
  const FourHigh &stand;
  const reduce::LumpedStand &chain;
  const StandModels &models;
  const reduce::FeMasses &masses;
  std::vector<std::string> answer;
  std::vector<reduce::MassesRow> masses_needed;
  std::vector<reduce::MassBreakdown> breakdown;
  KeptModes kept;
  std::string source_beam, source_components;
};

/// Text of curves/models.json, which the report shows; SI, 10 digits.
std::string models_json(const ModelsFile &file);
}  // namespace mill
