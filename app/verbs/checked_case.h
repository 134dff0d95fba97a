#pragma once
#include "app/review/case_review.h"
#include "core/model/case.h"

namespace mill {
struct CommandLine;

/// The case with all its errors that can be detected before anything is computed.
struct CheckedCase {
  Case the_case;
  CaseReview review;
};

/// Reads command.target and judges it, or hands the command over where its kind is not linked; but for the verb
/// check the program is started again where another BLAS is quicker, before records are read.
/// @throws InputError  with every problem found
CheckedCase checked_case(const CommandLine &command);
}  // namespace mill
