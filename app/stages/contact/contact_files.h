#pragma once
#include "app/stages/contact/condensed_rolls.h"
#include "core/records/csv.h"
#include "core/records/records.h"
#include "fem/contact/problem.h"
#include "reduce/chain/line_contact.h"

namespace mill {
/// What both kinds of contact store.  `force` and `stiffness` are the units: "N" and "N/m", or "N/m" and "N/m2"
/// where everything is per metre of length.
Table curve_table(const ContactCurve &curve, const std::string &force, const std::string &stiffness);
Table closed_table(const reduce::CylinderPair &pair, const Eigen::VectorXd &loads, const std::string &force,
                   const std::string &stiffness);

Table barrel_table(const BarrelProfile &profile);

/// Displacement, stress and contact pressure on the companion mesh as VTU, mirrored state.
void write_fields(RunContext &run, const std::string &file, const CondensedPair &roll, const Material &steel,
                  const contact::State &state);
}  // namespace mill
