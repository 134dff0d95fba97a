#pragma once
#include "core/case/kinds.h"
#include "core/case/stand_rows.h"
#include "core/model/monitoring.h"
#include <string>
#include <vector>

// [monitoring] of a case: no run of a stand uses it, so it is not part of a Case.
namespace mill {
const std::vector<Field<Monitoring>> &monitoring_rows();
const std::vector<Field<BallBearing>> &ball_bearing_rows();
SectionRows monitoring_section();
SectionRows ball_bearing_section();  ///< [[monitoring.ball_bearing]]
TemplateNote monitoring_note();      ///< names of a recorder's channels have no default
TemplateNote ball_bearing_note();

/// Reads and checks the section; writes it to resolved.toml if the case has it.
Monitoring read_monitoring(const Node &root, Reading &reading);

/// The section of a case file that read_case() has accepted.
/// @throws InputError as read_case()
Monitoring monitoring_of(const std::string &path, const std::vector<std::string> &sets = {});
}  // namespace mill
