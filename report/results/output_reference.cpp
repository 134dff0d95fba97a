#include "report/results/output_reference.h"
#include "core/base/note.h"
#include "core/base/si_unit.h"
#include "core/base/warning.h"
#include "core/records/result_row.h"

namespace mill::report {
namespace {
std::string unit_on_page(const ResultRow &row)
{
  if (!*row.unit)
    return "of its key";
  return is_in(row.unit, SiUnit::one) ? "-" : row.unit;
}

std::string table_of(const RowGroup &group)
{
  std::string text = std::string("\n## ") + group.title + "\n\nTheory: [" + group.chapter + "](theory/" +
                     group.chapter + ".md)\n\n| name | meaning | unit | theory |\n| --- | --- | --- | --- |\n";
  for (const ResultRow *row : group.rows)
    for (const std::string &name : names_on_page(*row))
      text += "| `" + name + "` | " + meaning_of_result(name) + " | " + unit_on_page(*row) + " | " + row->theory +
              " |\n";
  return text;
}
}  // namespace

std::string warning_reference()
{
  std::string text =
      "\n## Warnings\n\nA run warns of what its reader needs to know. `warning_records` of `results.json` has a "
      "record for each: `id`, `subject` (what it is about), `fact`, `detail` (what follows from it), `remedy`, "
      "`concerns` (names of results, or their first part), `key` and `place` (file, line, column) of the case. "
      "`warnings` has the same as one text each.\n\n| id | meaning |\n| --- | --- |\n";
  for (const WarningRow &row : warning_rows())
    text += std::string("| `") + row.word + "` | " + row.meaning + " |\n";
  return text;
}

std::string note_reference()
{
  std::string text =
      "\n## Notes\n\n`note_records` of `advice.json`, `calibration.json`, `plan.json` and `analysis.json` has the "
      "notes "
      "that decide something, in the form of a warning; `notes` has all of them as one text each. An id is one of "
      "these, or that of a warning.\n\n| id | meaning |\n| --- | --- |\n";
  for (const NoteRow &row : note_rows())
    if (row.id != NoteId::remark)
      text += std::string("| `") + row.word + "` | " + row.meaning + " |\n";
  return text;
}

std::string output_reference()
{
  std::string text =
      "# Results\n\nEvery name in `results.json`, printed by `tests/bench/output-reference` from the rows of the "
      "results (`core/records/result_row.h`). Words in capitals and N stand for the names and numbers of a case: "
      "PASS, BEARING, MODE, MODEL, ROLL, PAIR, CONTACT, VARIANT, EXCITED, PLACE, SPRING; KEY is a key of the case "
      "with its dots; `upper/lower` stands for one of the two. A name of the case that holds `.` or `/` has `%2E` "
      "or "
      "`%2F` in place of it. Each result carries its "
      "value "
      "in SI units, source, load, error estimate, checks and the keys of the case that it depends on. The last "
      "column is the equation that defines the result, or the chapter where its definition is in words: "
      "[theory](theory.md).\n";
  for (const RowGroup &group : row_groups())
    text += table_of(group);
  return text + warning_reference() + note_reference();
}
}  // namespace mill::report
