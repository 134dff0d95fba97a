#pragma once
#include "core/base/warning.h"
#include <string>
#include <vector>

// What a case and its records say about each other before anything long is computed.
namespace mill {
struct Case;
struct Pass;

struct CaseReview {
  std::vector<Problem> problems;     ///< what cannot be
  std::vector<Warning> warnings;     ///< what hardly is, or what a result will lack
  std::vector<Warning> said_by_run;  ///< the same, which a run says again from its own, better numbers
  std::vector<std::string> facts;    ///< what the records hold, one sentence each
};

/// Records of the passes (format, gaps, length against the lowest mode to be expected, sampling against the
/// highest) and loads against records, swept ranges and the slab theory of the bite.  theory.md 34.1
/// @param force_file  record that replaces those of the passes; empty: none
/// @throws InputError  a record that cannot be read
/// Cost: the records are read once, closed forms some 10 ms.
CaseReview review_stand(const Case &the_case, const std::string &force_file);
/// A pass that lacks keys of the search of its critical speed, as a run will say it.
void review_speed(const Pass &pass, const std::vector<std::string> &missing, CaseReview &review);

/// The records alone, with the modes of the given chain.
CaseReview review_lumped(const Case &the_case, const std::string &force_file);
}  // namespace mill
