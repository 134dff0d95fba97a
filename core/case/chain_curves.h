#pragma once
#include "core/case/fields.h"
#include "core/model/chain_curves.h"
#include <vector>

// [curve] of a lumped model, and dynamics.contact = "curve" held against what a case knows.
namespace mill {
struct FourHigh;
struct Lumped;

const std::vector<Field<ChainCurves>> &chain_curve_rows();

/// [curve]; nothing without it.  Curves that do not rise become problems.
ChainCurves read_chain_curves(const Node &root, Reading &reading);

/// dynamics.contact = "curve" without a curve: a stiffness given as a number, a model in files.
void check_contact_curves(const FourHigh &stand, Reading &reading);
void check_contact_curves(const Lumped &lumped, Reading &reading);

/// "[curve]" and its lines, as a case has them; empty without any.
std::string chain_curves_toml(const ChainCurves &curves);
}  // namespace mill
