#include "app/verbs/checked_case.h"
#include "app/command/command_line.h"
#include "app/command/linked_subjects.h"
#include "app/process/fast_blas.h"
#include "app/run/run_kind.h"
#include "app/stack/four_high_stack.h"
#include "app/stages/bearing/bearing_model.h"
#include "core/base/error_list.h"
#include "core/base/files.h"
#include "core/model/kind_of_case.h"

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

Case case_of_command(const CommandLine &command)
{
  if (command.text.empty())
    return read_case(command.target, command.sets);
  const std::string text = read_text(command.text);
  show_lines_of(command.target, text);
  return read_case_of(command.target, text, command.sets);
}

// --as stack: the same case in the place of its file.
Case case_as(const Case &written, const std::string &kind)
{
  if (kind != word_of(KindOfCase::stack))
    throw InputError("--as " + kind + ": a case of kind four-high can be taken as a stack, --as stack");
  const std::string text = four_high_as_stack(written);
  show_lines_of(written.path, text);
  return read_case_of(written.path, text);
}

CaseReview reviewed(const Case &the_case, const std::string &force)
{
  if (const auto check = run_kind(the_case).check)
    check(the_case);
  CaseReview review;
  if (const auto of_kind = run_kind(the_case).review)
    review = of_kind(the_case, force);
  if (!review.problems.empty())
    throw InputError(review.problems);
  return review;
}
}  // namespace

CheckedCase checked_case(const CommandLine &command)
{
  CheckedCase checked{case_of_command(command), {}};
  if (!command.as_kind.empty())
    checked.the_case = case_as(checked.the_case, command.as_kind);
  add_pass_of_record(checked.the_case, command.force);
  const Case &the_case = checked.the_case;
  require_linked(the_case, command);
  check_file_names(the_case);
  check_fits(the_case);
  if (command.verb != Verb::check)  // before records are read, which would be read twice
    use_fast_blas(command.arguments);
  checked.review = reviewed(the_case, command.force);
  return checked;
}

CheckedCase checked_text(const std::string &path, const std::string &text)
{
  CheckedCase checked{read_case_of(path, text), {}};
  check_file_names(checked.the_case);
  check_fits(checked.the_case);
  checked.review = reviewed(checked.the_case, "");
  return checked;
}

std::vector<Warning> remarks_of(const CheckedCase &checked)
{
  std::vector<Warning> remarks;
  for (const auto *list : {&checked.the_case.warnings, &checked.review.warnings, &checked.review.said_by_run})
    remarks.insert(remarks.end(), list->begin(), list->end());
  return remarks;
}

std::vector<std::string> facts_of(const CheckedCase &checked)
{
  std::vector<std::string> facts = said_of_bearings(checked.the_case);
  facts.insert(facts.end(), checked.review.facts.begin(), checked.review.facts.end());
  return facts;
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
