#pragma once
#include "report/page/run.h"
#include "report/results/names.h"
#include <string>
#include <vector>

namespace mill::report {
/// A value with its unit on the mill floor; a stiffness also in N/m.  HTML.
std::string value_cell(const Result &result);

/// The source without its details: "computed: contact FEM, plane strain, ..." -> "computed: contact FEM".  The
/// full table says all of it.
std::string short_source(const std::string &source);

/// "±0.4 %", or a dash with the reason.  HTML.
std::string accuracy_cell(const Result &result);

/// The numbers one looks for first: value, source, load, accuracy, the first check and the published value.
std::string short_table(const std::vector<Group> &groups);

/// Every result with every check and, folded, its inputs.
std::string full_table(const Run &run);

/// Accelerations of every pass: this run compared with a published model and a measurement, as stored in the
/// checks of <pass>.peak_g.* (names that contain "published" or "measured").  Empty when the run holds no
/// accelerations.
std::string peak_table(const Run &run);

/// <pass>.<quantity>.<roll> by the pass's name or its slug; nullptr when absent.
const Result *pass_value(const Run &run, const PassInfo &pass, const std::string &quantity);

/// A peak or rms value in g whatever its stored unit.
double in_g(double value, const std::string &unit);

/// An acceleration in g as text: two decimals, below 0.1 g two significant digits.
std::string g_text(double value);
}  // namespace mill::report
