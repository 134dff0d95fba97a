#include "report/stack/section.h"
#include "core/records/stack_names.h"
#include "report/cluster/figures.h"
#include "report/page/curves.h"
#include "report/page/page.h"
#include "report/stack/figures.h"

namespace mill::report {
void stack_section(Page &page, const Run &run)
{
  if (run.manifest.kind != KindOfCase::stack)
    return;
  if (stored_curve(run, curve::stack_strip)) {
    page.section("stack", "Strip and rolls", Depth::manager);
    page.figure(
        {stack_section_drawing(run)},
        "The stack to scale with the resultant of every contact. The size of a dot follows its force; angles "
        "are those of the line of centres against the vertical.");
    page.figure(
        strip_drawings(run),
        "Profile, line load and flatness of the strip. A crowned strip is thinner at its edges. Flatness is "
        "without flow across the width, positive where fibres are longer.");
    page.figure(line_load_drawings(run), "Line load of the contacts of the upper half, on one scale.");
    page.figure(
        deflection_drawings(run),
        "Axes of the rolls of the upper half, from the unloaded stack, and the bending stress at their surface.");
    page.figure(
        influence_drawings(run),
        "Change of the thickness against the middle of the strip with one unit of each input, exact at the "
        "solved state. Rolls that are made of an upper one change with it.");
    page.figure(modulus_drawings(run), "Modulus and crown over the rolling force, by beams.");
    page.figure(
        {settings_drawing(run)},
        "Crown over bending force and shift. Without a dot all contacts are closed over their whole length.");
    page.figure(window_drawings(run),
                "Operating window over rolling force and width of the strip. A line ends where the stack has no "
                "equilibrium or the strip is wider than a barrel.");
  }
  const std::vector<std::string> modes = mode_drawings(run);
  const std::string named              = gap_table(run);
  if (modes.empty() && named.empty())
    return;
  page.section("stack-modes", "Modes of the stack");
  page.table(named, "Modes by what they do to the gap, with the strip between the work rolls and without.");
  page.figure(modes, "Axes of the rolls in the modes that open the gap most, upper half dark and lower half pale. "
                     "Each is scaled to its largest displacement.");
}
}  // namespace mill::report
