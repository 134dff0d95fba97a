#pragma once
#include "app/stages/stand/model_stage.h"
#include "core/records/models_record.h"
#include <string>

namespace mill {
struct FourHigh;

/// One model with its modes below the limit and one beyond it.
/// @param in_chain  (modes) share of each that six masses can follow; empty: not known
ComparedModel compared_model(const reduce::StandWithModes &stand, const std::string &title,
                             const std::string &source, double limit, const Eigen::VectorXd &in_chain);

/// The modes of the other models compared with those of the six masses.
std::vector<ModePartners> mode_partners(const StandModels &models);

/// How alike the shapes of the two detailed models are.
MacTable mac_table(const StandModels &models, double limit);

/// M1..M6 by every method.
std::vector<MassRoutes> mass_routes(const FourHigh &stand, const reduce::LumpedStand &chain,
                                    const reduce::FeMasses &masses);
}  // namespace mill
