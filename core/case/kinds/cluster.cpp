#include "core/case/advice_rows.h"
#include "core/case/cluster_rows.h"
#include "core/case/kinds.h"
#include "core/case/stand_reader.h"
#include "core/case/stand_sections.h"

namespace mill {
ClusterCase read_cluster(const Node &root, Reading &reading);

namespace {
using Values = std::map<std::string, std::string>;

TemplateNote note_of(const char *section, const Values &values, const std::vector<std::string> &shown = {})
{
  std::vector<std::string> keys = shown;
  for (const auto &[key, value] : values)
    keys.push_back(key);
  return {section, "", values, keys};
}

// The compact mill of cases/z-mill.toml, one pass.
std::vector<TemplateNote> cluster_notes()
{
  std::vector<TemplateNote> notes;
  const auto roll = [&](const char *name, const char *diameter, const char *position) {
    Values values{{"name", quoted(name)}, {"barrel_diameter", quoted(diameter)}};
    if (*position)
      values["position"] = position;
    notes.push_back(note_of("roll", values));
  };
  roll("W", "69.6 mm", R"(["0 mm", "34.8 mm"])");
  roll("I", "139.95 mm", "");
  roll("E", "450.31 mm", "");
  roll("R", "51 mm", "");
  roll("L", "51 mm", "");
  const auto contact = [&](const char *pair, const char *direction) {
    notes.push_back(note_of("contact", {{"pair", quoted(pair)}, {"direction", quoted(direction)}}));
  };
  contact("W-I", "90 deg");
  contact("I-E", "90 deg");
  contact("W-R", "0 deg");
  notes.push_back(note_of("contact", {{"pair", quoted("W-L")}, {"like", quoted("W-R")}}));
  notes.push_back(note_of("support", {{"roll", quoted("E")}}, {"stiffness", "load"}));
  notes.push_back(
      note_of("support", {{"roll", quoted("I")}, {"type", quoted("guide")}, {"stiffness", quoted("5e8 N/m")}}));
  notes.push_back(
      note_of("support", {{"roll", quoted("R")}, {"type", quoted("rollers")}, {"stiffness", quoted("1.93e8 N/m")}},
              {"half_angle", "preload", "against"}));
  notes.push_back(note_of("support", {{"roll", quoted("L")}, {"like", quoted("R")}}));
  notes.push_back(note_of("pass", {}, {"load", "entry_thickness", "exit_thickness", "speed"}));
  return notes;
}
const std::vector<DrawingValue> &cluster_drawing()
{
  static const std::vector<DrawingValue> values{
      {"stack", "strip", "section of the stand: the roll at the strip"},
      {"roll", "name", "section of the stand"},
      {"roll", "barrel_diameter", "roll drawing: ground diameter"},
      {"roll", "barrel_length", "roll drawing: length of the barrel"},
      {"roll", "position", "section of the stand; the first roll anywhere on its line"},
      {"contact", "pair", "section of the stand: rolls that touch"},
      {"contact", "direction", "section of the stand: angle of the line of centres"},
      {"support", "roll", "section of the stand: rolls in bearings, guides or on rollers"},
      {"support", "stiffness", "bearing catalogue or fit to a measured frequency"},
      {"strip", "width", "pass schedule"},
      {"pass", "name", "pass schedule"},
      {"pass", "load", "pass schedule or force meter: rolling force of both sides together"},
  };
  return values;
}
}  // namespace

const CaseKind &case_kind(const ClusterCase *)
{
  static const CaseKind kind = [] {
    CaseKind k;
    using Repeat = SectionRows::Repeat;
    k.name       = word_of(KindOfCase::cluster);
    k.title      = "stack of rolls";
    k.read       = [](const Node &root, Reading &reading) -> CaseSpec { return read_cluster(root, reading); };
    k.sections   = {
          head_section(),
          steel_section(),
          {"stack", Repeat::once, true, "what is common to the rolls", rows_of(cluster_stack_rows())},
          {"roll", Repeat::list, true, "one roll, of at most 40", rows_of(cluster_roll_rows())},
          {"contact", Repeat::list, false, "two rolls that touch", rows_of(cluster_contact_rows())},
          {"support", Repeat::list, true, "what holds a roll from the ground", rows_of(cluster_support_rows())},
          {"strip", Repeat::once, true, "the strip in the bite", rows_of(cluster_strip_rows())},
    };
    for (const SectionRows &section : strip_sections())
      if (section.name != "strip") {
        k.sections.push_back(section);
        k.sections.back().needed = false;
      }
    for (SectionRows &section : std::vector<SectionRows>{
             {"pass", Repeat::list, true, "one pass", rows_of(cluster_pass_rows())},
             {"response", Repeat::once, false, "damping, response and history", rows_of(cluster_response_rows())},
             {"mode", Repeat::list, false, "a motion that has a name", rows_of(cluster_mode_rows())},
             {"variant", Repeat::list, false, "the stack with other laws, and its fit",
              rows_of(cluster_variant_rows())},
         })
      k.sections.push_back(std::move(section));
    k.sections.push_back(bite_section());
    k.sections.push_back({"stand", Repeat::once, false, "the strip around the stand, for millstand chatter",
                          rows_of(stand_span_rows())});
    k.sections.push_back(
        {"analysis", Repeat::once, false, "how chatter is searched", rows_of(chatter_analysis_rows())});
    k.sections.push_back(chatter_advice_section());
    k.notes    = cluster_notes();
    k.drawing  = cluster_drawing();
    k.repeated = [](const CaseSpec &spec, const std::string &section) {
      const ClusterStand &stand = *std::get<ClusterCase>(spec).stand;
      const std::map<std::string, std::size_t> sizes{
          {"roll", stand.rolls.size()},    {"contact", stand.contacts.size()}, {"support", stand.supports.size()},
          {"pass", stand.schedule.size()}, {"mode", stand.modes.size()},       {"variant", stand.variants.size()}};
      const auto entry = sizes.find(section);
      return entry == sizes.end() ? std::vector<std::string>() : numbers_to(entry->second);
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
