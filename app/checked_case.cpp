#include "app/checked_case.h"
#include "app/case_kinds.h"
#include "app/command_line.h"
#include "app/fast_blas.h"
#include "app/linked_subjects.h"
#include "app/stages/bearing_model.h"
#include "core/case/errors.h"

namespace mill {
CheckedCase checked_case(const CommandLine &command)
{
  CheckedCase checked{read_case(command.target, command.sets), {}};
  const Case &the_case = checked.the_case;
  require_linked(the_case, command);
  check_file_names(the_case);
  check_fits(the_case);
  if (command.verb != "check")  // before records are read, which would be read twice
    use_fast_blas(command.arguments);
  if (const auto check = run_kind(the_case).check)
    check(the_case);
  if (const auto review = run_kind(the_case).review)
    checked.review = review(the_case, command.force);
  if (!checked.review.problems.empty())
    throw InputError(checked.review.problems);
  return checked;
}
}  // namespace mill
