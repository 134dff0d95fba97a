#pragma once
#include <string>
#include <vector>

// What a case says of the strip that a bite of a four-high stand needs.
namespace mill {
struct Case;
struct FourHigh;

/// Keys that a steady bite needs and a case of kind four-high does not say; empty: it says enough.
std::vector<std::string> keys_missing_of_bite(const Case &the_case);
/// The same with commas.
std::string missing_of_bite(const Case &the_case);

/// Strip before and behind a stand.
struct FreeStrip {
  double entry_distance = 0, exit_distance = 0;  ///< m
  std::vector<std::string> assumed;              ///< what the case does not say, one sentence each
};
/// As the case says; 5 m where it does not.
FreeStrip free_strip(const FourHigh &stand);
}  // namespace mill
