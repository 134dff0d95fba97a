#include "dynamics/fmu/description.h"
#include <fmt/format.h>
#include <utility>

namespace mill::fmu {
namespace {
// A variable of a terminal, and what it is called there.
using Member = std::pair<std::string, const char *>;

struct Terminal {
  std::string name, text;
  std::vector<Member> members;
  bool left = true;  // side of the picture
};

std::vector<Terminal> driven_terminals()
{
  return {{"rolling_force",
           "force of the bite on the work rolls, and what the load cell shows",
           {{"F_roll", "force"}, {"F_cell", "load_cell"}},
           true}};
}

std::vector<Terminal> chatter_terminals()
{
  return {{"entry",
           "strip before the bite",
           {{"entry_thickness", "thickness"},
            {"dh_entry", "thickness_change"},
            {"entry_tension", "steady_tension"},
            {"sigma_entry", "tension"}},
           true},
          {"drive", "drive of the work rolls", {{"roll_speed", "speed"}}, true},
          {"bite",
           "roll gap and rolling force",
           {{"F_disturbance", "disturbance"}, {"F", "force"}, {"dF", "force_change"}, {"dh", "gap_change"}},
           true},
          {"exit",
           "strip behind the bite",
           {{"exit_thickness", "thickness"}, {"exit_tension", "steady_tension"}, {"sigma_exit", "tension"}},
           false}};
}

std::vector<Terminal> terminals_of(const ExportedModel &model)
{
  std::vector<Terminal> all = model.data.kind == StandKind::chatter ? chatter_terminals() : driven_terminals();
  for (const std::string &point : model.data.points)
    all.push_back(
        {point, "motion of one point", {{"a_" + point, "acceleration"}, {"y_" + point, "displacement"}}, false});
  return all;
}

// Terminals of a side have equal distances; each is a square of 10 in a picture from -100 to 100.
std::string text_of(const Terminal &terminal, const std::size_t place, const std::size_t of)
{
  std::string text = "    " +
                     Attributes()
                         .add("name", terminal.name)
                         .add("matchingRule", "bus")
                         .add("description", terminal.text)
                         .opening("Terminal") +
                     "\n";
  for (const auto &[variable, member] : terminal.members)
    text += "      " +
            Attributes()
                .add("variableName", variable)
                .add("memberName", member)
                .add("variableKind", "signal")
                .element("TerminalMemberVariable") +
            "\n";
  const double x = terminal.left ? -100 : 100, y = 100 - 200 * (double(place) + 0.5) / double(of);
  return text + "      " +
         Attributes()
             .add("x1", x - 5)
             .add("y1", y - 5)
             .add("x2", x + 5)
             .add("y2", y + 5)
             .add("iconBaseName", terminal_icon)
             .element("TerminalGraphicalRepresentation") +
         "\n    </Terminal>\n";
}
}  // namespace

std::string terminals_and_icons(const ExportedModel &model)
{
  const std::vector<Terminal> all = terminals_of(model);
  std::size_t count[2] = {0, 0}, place[2] = {0, 0};
  for (const Terminal &terminal : all)
    ++count[terminal.left];
  std::string text   = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiTerminalsAndIcons fmiVersion=\"3.0\">\n"
                       "  <GraphicalRepresentation>\n    ";
  const auto corners = [] { return Attributes().add("x1", -100).add("y1", -100).add("x2", 100).add("y2", 100); };
  text += corners().add("suggestedScalingFactorTo_mm", 0.1).element("CoordinateSystem") + "\n    " +
          corners().element("Icon") + "\n  </GraphicalRepresentation>\n  <Terminals>\n";
  for (const Terminal &terminal : all)
    text += text_of(terminal, place[terminal.left]++, count[terminal.left]);
  return text + "  </Terminals>\n</fmiTerminalsAndIcons>\n";
}
}  // namespace mill::fmu
