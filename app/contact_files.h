#pragma once
#include "app/condensed_rolls.h"
#include "core/csv.h"
#include "core/records.h"
#include "fem/contact_solver.h"
#include "reduce/line_contact.h"

namespace mill
{
/// What both kinds of contact store.
Table curve_table(const ContactCurve &curve);
Table closed_table(const reduce::CylinderPair &pair, const Eigen::VectorXd &loads);

/// Displacement, stress and contact pressure on the companion mesh as VTU, mirrored state.
void write_fields(Session &session, const std::string &file, const CondensedPair &roll, const Material &steel,
                  const fem::ContactState &state);
} // namespace mill
