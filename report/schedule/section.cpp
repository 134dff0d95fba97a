#include "report/page/page.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/schedule/figures.h"
#include <cmath>

namespace mill::report {
namespace {
std::string law_sentence(const ScheduleData &data)
{
  std::string text;
  for (const ScheduleLaw &law : data.laws)
    text += std::string(text.empty() ? "" : "; ") + (law.flattened ? "flattened" : "rigid") +
            " rolls: Y = " + significant(law.Y / 1e6, 4) + " MPa" +
            (std::isnan(law.Y_deviation) ? "" : " \u00b1 " + percent(law.Y_deviation).substr(1)) +
            ", n = " + significant(law.n, 3) +
            (std::isnan(law.n_deviation) ? "" : " \u00b1 " + significant(law.n_deviation, 2)) + " from " +
            std::to_string(law.data) + " passes and " + std::to_string(law.unknowns) + " unknowns";
  return text;
}

std::string constant_sentence(const ScheduleData &data)
{
  std::string text;
  for (const DynamicForces &all : data.dynamics)
    text += std::string(text.empty() ? "" : ", ") + significant(1e6 * all.common, 3) + " mm\u00b2/s with " +
            (all.flattened ? "flattened" : "rigid") + " rolls, from " + std::to_string(all.data) + " forces";
  return text;
}
}  // namespace

void schedule_section(Page &page, const Run &run)
{
  const ScheduleData data = read_schedule(run.directory);
  if (!data.stored && data.problem.empty())
    return;
  page.section("pass-forces", "Rolling force of the passes");
  if (!data.stored) {
    page.html("<p class=\"absent\">" + escaped(data.problem) + "</p>");
    return;
  }
  page.figure(
      {force_drawing(data)},
      "The force that every pass was fitted to, and what the fitted flow stress gives by theories that differ in "
      "the shape of the arc. A rigid roll needs far less force: without the flattening the fitted flow stress is "
      "too high.");
  page.table(
      fit_table(data),
      "<b>Fits of one unknown</b>: the plane-strain flow stress <i>k</i> that returns the force of the pass at "
      "the friction of its law. One equation meets any force exactly, so that the agreement says nothing; what "
      "can be judged is whether a strip has such a stress. The column beyond 5.235 has the radius by the power "
      "that replaces Hitchcock's formula there.");
  page.table(factor_table(data),
             "At that stress with flattened rolls: Bland and Ford's pressure, the friction factor of "
             "Hu and Ehmann with the same force on the same arc (exact, and by the form as published, "
             "which drops two small terms), power and torque of homogeneous deformation, a lower "
             "bound.");
  if (const std::string table = hardening_table(data); !table.empty())
    page.table(
        table,
        "One hardening law <i>k</i>/2 = Y ln(h\u2080/h)\u207f for all passes, fitted to the stresses above; " +
            law_sentence(data) +
            ". A pass called blind is not in the fit; the last two columns leave each pass out of its own law.");
  if (const std::string table = dynamic_table(data); !table.empty())
    page.table(table,
               "Dynamic force of a strip that vibrates behind the stand. Its span, amplitude and mode are not "
               "known and enter as one constant, fitted to the published forces: " +
                   constant_sentence(data) +
                   ". The absolute force is not a prediction; its pattern over the passes is.");
  if (const std::string table = theory_table(data); !table.empty())
    page.table(table,
               "The same passes with the fitted flow stress of flattened rolls by every theory and by finite "
               "elements, and how far each is from the force of the fit. Figures of the arcs stand under the roll "
               "bite.");
}
}  // namespace mill::report
