#pragma once
#include "app/review/case_review.h"
#include "core/model/case.h"
#include <string>
#include <vector>

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

/// The same of a text that stands in the place of the file `path`, in this program: for those who hold the case
/// while it changes.
/// @throws InputError  with every problem found
CheckedCase checked_text(const std::string &path, const std::string &text);

/// What check remarks of a case without errors, in its order.
std::vector<Warning> remarks_of(const CheckedCase &checked);
/// And what it states: one sentence each.
std::vector<std::string> facts_of(const CheckedCase &checked);

/// A case with overrides, as one row of a table: checked like a case, without a look at its records.
/// @throws InputError  with every problem found
Case checked_row(const std::string &path, const std::vector<std::string> &sets);
}  // namespace mill
