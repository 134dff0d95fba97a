#include "core/case/given_instead.h"
#include <algorithm>

namespace mill {
const std::vector<BehindGiven> &behind_given()
{
  static const std::vector<BehindGiven> all{
      {{"K1"},
       "frame",
       {"upper_post_stiffness", "upper_beam_stiffness", "piston_stiffness", "upper_packing_stiffness"}},
      {{"M1"}, "frame", {"upper_post_mass", "upper_beam_mass", "upper_packing_mass", "piston_mass"}},
      {{"K2"}, "frame", {"oil_column_stiffness", "cylinder_body_stiffness", "upper_chock_stiffness"}},
      {{"M2"}, "frame", {"cylinder_mass", "balance_mass"}},
      {{"K6"}, "frame", {"lower_chock_stiffness"}},
      {{"K7"}, "frame", {"lower_post_stiffness", "lower_beam_stiffness", "lower_packing_stiffness"}},
      {{"M6"}, "frame", {"lower_post_mass", "lower_beam_mass", "load_cell_mass", "lower_packing_mass"}},
      {{"M2"}, "backup_roll", {"chock_mass_upper"}},
      {{"M5"}, "backup_roll", {"chock_mass_lower"}},
      {{"M2", "M5"}, "backup_roll", {"bearing_mass"}},
      {{"M3"}, "work_roll", {"chock_mass_upper"}},
      {{"M4"}, "work_roll", {"chock_mass_lower"}},
      {{"M3", "M4"}, "work_roll", {"bearing_mass"}},
      {{"Kzc1", "Kzc4"}, "backup_roll", {"bearing"}},
      {{"K_Zy"}, "backup_roll", {"bearing"}},
      {{"Kzc2", "Kzc3"}, "work_roll", {"bearing"}},
      {{"K4"}, "strip", {"entry_thickness", "exit_thickness", "friction", "flow_stress"}},
  };
  return all;
}

std::set<std::string> given_names(const Node &root)
{
  std::set<std::string> names;
  if (const Node::Entry *given = root.find("given"))
    for (const Node::Entry &entry : given->value.entries)
      names.insert(entry.key);
  return names;
}

namespace {
bool lies_behind(const BehindGiven &one, const std::string &section, const std::string &key)
{
  return one.section == section && std::find(one.keys.begin(), one.keys.end(), key) != one.keys.end();
}
}  // namespace

bool is_needless(const std::string &section, const std::string &key, const std::set<std::string> &given)
{
  const auto &all = behind_given();
  return std::any_of(all.begin(), all.end(), [&](const BehindGiven &one) {
    return lies_behind(one, section, key) &&
           std::all_of(one.given.begin(), one.given.end(),
                       [&](const std::string &name) { return given.count(name) > 0; });
  });
}

std::string given_instead(const std::string &section, const std::string &key)
{
  std::string text;
  for (const BehindGiven &one : behind_given()) {
    if (!lies_behind(one, section, key))
      continue;
    std::string names;
    for (const std::string &name : one.given)
      names += (names.empty() ? "" : " and ") + name;
    text += (text.empty() ? "" : ", or ") + names;
  }
  return text.empty() ? "" : text + (text.find(',') == std::string::npos ? " in [given]" : ", in [given]");
}
}  // namespace mill
