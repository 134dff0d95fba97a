#include "app/verbs/checked_case.h"
#include "app/command/command_line.h"
#include "app/command/linked_subjects.h"
#include "app/process/fast_blas.h"
#include "app/run/run_kind.h"
#include "app/stages/bearing/bearing_model.h"
#include "core/base/errors.h"

namespace mill {
namespace {
/// A lumped stand without [[pass]], driven by the record of --force: the record is its only pass.
void add_pass_of_record(Case &the_case, const std::string &force_file)
{
  auto *lumped = std::get_if<Lumped>(&the_case.spec);
  if (force_file.empty() || !lumped || !lumped->passes.empty())
    return;
  Pass pass;
  pass.name       = "record";
  pass.place      = {the_case.path, 0, 0};
  pass.force_file = force_file;
  lumped->passes.push_back(pass);
}
}  // namespace

CheckedCase checked_case(const CommandLine &command)
{
  CheckedCase checked{read_case(command.target, command.sets), {}};
  add_pass_of_record(checked.the_case, command.force);
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

Case checked_row(const std::string &path, const std::vector<std::string> &sets)
{
  Case the_case = read_case(path, sets);
  check_file_names(the_case);
  check_fits(the_case);
  if (const auto check = run_kind(the_case).check)
    check(the_case);
  return the_case;
}
}  // namespace mill
