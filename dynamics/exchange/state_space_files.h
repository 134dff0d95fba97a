#pragma once
#include "dynamics/exchange/exchanged_stand.h"
#include <string>
#include <vector>

namespace mill::dynamics {
/// A file of a folder.
struct NamedText {
  std::string name;
  std::string text;
};

/// The first-order form for any program: A, B, C, D as CSV (numbers alone, one row a line) and as Matrix Market,
/// names.csv (of what, index, name, unit, meaning), about.txt.  theory.md (35.9)
std::vector<NamedText> state_space_files(const ExchangedStand &stand);

}  // namespace mill::dynamics
