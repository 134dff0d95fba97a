#include "core/records/result_names.h"
#include "report/marks/figures.h"
#include "report/page/page.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"

namespace mill::report {
bool holds_marks(const Run &run)
{
  return run.find(result_name({marks_family, "frequency"})) != nullptr;
}

void marks_section(Page &page, const Run &run)
{
  const MarksData data = read_marks(run.directory);
  if (!data.stored && data.problem.empty())
    return;
  page.section("marks", "Marks on the strip");
  if (!data.stored) {
    page.html("<p class=\"absent\">" + escaped(data.problem) + "</p>");
    return;
  }
  page.paragraph(escaped(marks_sentence(data)) + ".");
  page.table(
      marks_table(data),
      "The spacing laid around what turns. A number within " + percent(data.question.accuracy).substr(1) +
          " of a whole one is accepted as whole; where a random spacing would be accepted in more than half of "
          "all cases the candidates are not distinguishable, and spacing and diameters must be known better.");
  if (const std::string table = marks_mode_table(data); !table.empty())
    page.table(table,
               "Modes " + escaped(data.model) +
                   " against the marks. A mode makes this spacing at the speed in the fourth column, and is "
                   "excited by whole waves around a roll at the speeds that follow, next to the one asked for. "
                   "A frequency that stays when the speed changes is a mode, a number of waves that stays is a "
                   "roll.");
  page.table(side_band_table(data), "Side bands of the frequency of the marks that a change once per turn causes. "
                                    "The distance of side bands is not the spacing of the marks.");
  for (const MarkMap &map : data.maps)
    if (const std::string drawing = marks_map(data, map); !drawing.empty())
      page.figure({drawing},
                  "How much a mode magnifies waves around the " + escaped(map.roll) +
                      ", over its static deflection, at " + percent(data.damping).substr(1) +
                      " of critical damping. Dark lines are speeds to pass quickly with a roll that carries "
                      "so many waves; which waves grow is a question of chatter.");
}
}  // namespace mill::report
