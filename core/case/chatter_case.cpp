#include "core/base/files.h"
#include "core/case/advice_rows.h"
#include "core/case/given.h"
#include "core/case/lumped_model_toml.h"
#include "core/case/monitoring.h"
#include "core/case/plant.h"
#include "core/case/stand_reader.h"
#include "core/model/case.h"
#include "core/model/lumped.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace mill {
namespace {
// Quantities of [stand] in addition to 'from' would give two values for one thing.
const std::vector<std::string> body_keys{"masses", "stiffnesses", "dampings"};

bool given(const Reading &reading, const std::string &section, const std::string &key)
{
  return reading.places.count(section + "." + key) > 0;
}

// The lumped model that [stand] starts from; problems of its own file are reported at the key that names it.
void read_model(ChatterCase &spec, const std::string &section, Reading &reading)
{
  const std::string key = section + ".from";
  const auto refuse     = [&](const std::string &why) { reading.add(reading.place(key), why); };
  try {
    // The kind first: a chatter case that names itself would be read without end.
    const Node file         = read_case_file(spec.stand.from);
    const Node::Entry *kind = file.find("kind");
    if (kind && kind->value.text != "lumped")
      return refuse(fmt::format("{} is a case of kind \"{}\"; a lumped model is needed, for example the "
                                "lumped_model.toml of a run of a four-high stand",
                                reading.as_written(key), kind->value.text));
    const Case model   = read_case(spec.stand.from);
    const auto &lumped = std::get<Lumped>(model.spec);
    spec.modal_damping = lumped.dynamics.modal_damping;
    if (!lumped.detailed)
      spec.model = lumped_model_of(model);
    else if (lumped.dynamics.force_meaning != ForceMeaning::measured)
      refuse(fmt::format("{} cannot be used: its matrices hold the spring of the bite (dynamics.force_meaning = "
                         "\"{}\"), which the bite adds here; run the stand with force_meaning = \"measured\"",
                         reading.as_written(key), word_of(lumped.dynamics.force_meaning)));
    else if (given(reading, section, "dampings"))
      contradict(reading, section + ".dampings", "are those of six bodies, and the model has other bodies", {key});
    else
      spec.files = lumped.model;
  } catch (const InputError &e) {
    const Problem &first = e.problems.front();
    refuse(fmt::format("{} cannot be used: {}", reading.as_written(key), first.message));
  }
}

void check_stand(const ChatterStand &stand, Reading &reading)
{
  const bool from = !stand.from.empty();
  for (const char *key : {"masses", "stiffnesses"}) {
    const std::string full = "stand." + std::string(key);
    if (from && given(reading, "stand", key))
      contradict(reading, full, "is also given by the lumped model; leave one of the two out", {"stand.from"});
    if (!from && !given(reading, "stand", key) && reading.usable({full, "stand.from"}))
      reading.add(
          reading.place("stand"),
          fmt::format("[stand] has no '{}'; give masses, stiffnesses and dampings of the six bodies, or 'from' "
                      "with the lumped_model.toml of a run",
                      key));
  }
  if (!from && !given(reading, "stand", "dampings") && reading.usable({"stand.dampings", "stand.from"}))
    reading.add(reading.place("stand"), "[stand] has no 'dampings'; without them the stand dissipates no energy "
                                        "of its vibration; give six, zeros if that is intended");
  for (const char *key : {"entry_distance", "exit_distance"})
    if (!given(reading, "stand", key) && reading.usable({std::string("stand.") + key}))
      reading.add(reading.place("stand"),
                  fmt::format("[stand] has no '{}'; the strip between the stands is a spring whose length decides "
                              "about the critical speed; add for example {} = \"4.95 m\"",
                              key, key));
}

ChatterStand read_stand(const Node &root, Reading &reading)
{
  ChatterStand stand;
  const Section section = section_at(root, "stand", reading);
  read_and_echo(section, section.header(), chatter_stand_rows(), stand, reading);
  if (!section.node) {
    if (!section.refused)
      reading.add(Place{reading.file},
                  "the section [stand] is missing; it needs masses, stiffnesses and dampings of "
                  "the six bodies (or 'from', a lumped model), entry_distance and exit_distance");
    return stand;
  }
  reading.places["stand"] = section.node->place;
  check_stand(stand, reading);
  return stand;
}

ChatterVariant read_variant(const Node::Entry &entry, const ChatterCase &spec, Reading &reading)
{
  ChatterVariant variant{entry.key, {}, entry.value.place};
  const std::string name = "variant." + entry.key;
  read(Section{&entry.value, name}, chatter_stand_rows(), variant.stand, reading);
  reading.echo += fmt::format("\n[variant.{}]\n{}", key_text(entry.key),
                              resolved_lines(name, chatter_stand_rows(), variant.stand, reading));
  if (given(reading, name, "from"))
    reading.add(reading.place(name + ".from"),
                "a variant changes numbers of [stand]; another lumped model needs a separate case");
  if (spec.model)
    for (const std::string &key : body_keys)
      if (given(reading, name, key))
        contradict(reading, name + "." + key, "replaces bodies that [stand] takes from a lumped model",
                   {"stand.from"});
  return variant;
}

void read_variants(const Node &root, ChatterCase &spec, Reading &reading)
{
  const Section all = section_at(root, "variant", reading);
  if (!all.node)
    return;
  std::map<std::string, std::string> named;  // what tells results apart -> variant
  for (const Node::Entry &entry : all.node->entries)
    if (entry.value.kind == Node::Kind::table) {
      spec.variants.push_back(read_variant(entry, spec, reading));
      if (const auto [other, is_new] = named.emplace(slug(entry.key), entry.key); !is_new)
        reading.add(entry.key_place,
                    fmt::format("variant.{} and variant.{} name the same results; names are distinguished by "
                                "letters of the Latin alphabet and digits only, not by upper and lower case",
                                entry.key, other->second));
    } else
      reading.add(entry.value.place, fmt::format("variant.{} = {} is a value; a section [variant.{}] is needed",
                                                 entry.key, shown(entry.value), entry.key));
}

// [oil] and what it says about friction; or [strip] friction.
void read_friction_law(const Node &root, ChatterCase &spec, const bool strip_has_friction, Reading &reading)
{
  const Section section = section_at(root, "oil", reading);
  if (section.refused)
    return;
  if (!section.node) {
    if (!strip_has_friction)
      reading.add(Place{reading.file}, "the friction is not given; give [oil] with its film law, or a number "
                                       "under strip.friction");
    return;
  }
  OilInput oil;
  read_and_echo(section, section.header(), oil_rows(), oil, reading, {"friction"});
  const Section law = section_at(root, "oil.friction", reading);
  read_and_echo(law, law.header(), oil_friction_rows(), oil, reading);
  if (strip_has_friction)
    contradict(reading, "strip.friction", "is also given by the film of [oil]; leave one of the two out",
               {"oil.viscosity"});
  if (reading.usable({"oil.film_range"}) && !std::isnan(oil.film_range[0]) &&
      oil.film_range[0] >= oil.film_range[1])
    contradict(reading, "oil.film_range", "does not run from the thinner to the thicker film", {});
  spec.strip.friction     = oil;
  spec.strip.friction.law = FrictionLaw::film;
  spec.oiled              = true;
  spec.film_range         = oil.film_range;
}

// [strip] of this kind: the conditions hold thicknesses, tensions and width.  True if it says the friction.
bool read_strip_of_chatter(const Node &root, ChatterCase &spec, Reading &reading)
{
  StripInput strip;
  const Section section    = section_at(root, "strip", reading);
  const Node::Entry *entry = section.node ? section.node->find("friction") : nullptr;
  const bool has_law       = entry && entry->value.kind == Node::Kind::table;
  auto rows                = chatter_strip_rows();
  if (has_law)
    rows.pop_back();
  std::vector<std::string> sections{"flow_stress"};
  if (has_law)
    sections.push_back("friction");
  read_and_echo(section, section.header(), rows, strip, reading, sections);
  if (!section.node && !section.refused)
    reading.add(Place{reading.file}, "the section [strip] is missing; it needs flow_stress");
  strip.flow_stress          = read_flow_stress(root, reading);
  strip.friction.coefficient = strip.coulomb;
  if (has_law)
    strip.friction = read_friction_law({&entry->value, "strip.friction"}, reading);
  spec.strip = strip;
  check_flow_and_friction(spec.strip, reading);
  if (has_law && !slides(strip.friction))
    contradict(reading, "strip.friction.law", "has no Coulomb coefficient; chatter takes coulomb, speed or film",
               {});
  return entry != nullptr;
}

// Conditions before the one that is checked, by name and by the name of their files.
struct EarlierConditions {
  std::map<std::string, std::size_t> by_name, by_slug;
};

void check_condition(const std::vector<RollingCondition> &all, const std::size_t i, const ChatterCase &spec,
                     EarlierConditions &earlier, Reading &reading)
{
  const RollingCondition &c = all[i];
  const auto key            = [&](const char *k) { return fmt::format("condition.{}.{}", i, k); };
  if (reading.usable({key("entry_thickness"), key("exit_thickness")}) && c.exit_thickness >= c.entry_thickness)
    contradict(reading, key("exit_thickness"), "is not smaller than the entry thickness",
               {key("entry_thickness")});
  if (reading.usable({key("entry_thickness"), "strip.initial_thickness"}) &&
      spec.strip.initial_thickness < c.entry_thickness)
    contradict(reading, key("entry_thickness"), "is thicker than the strip before all rolling",
               {"strip.initial_thickness"});
  if (!reading.usable({key("name")}))
    return;
  check_not_empty(key("name"), c.name, reading);
  if (c.name.size() > 100)
    contradict(reading, key("name"), "is longer than 100 characters; it names files", {});
  if (c.name == "tandem")
    contradict(reading, key("name"), "is kept for the results of several stands together; take another name", {});
  const auto after            = earlier.by_name.find(c.after);
  const auto [same, is_new]   = earlier.by_name.emplace(c.name, i);
  const auto [file, own_file] = earlier.by_slug.emplace(slug(c.name), i);
  if (!is_new)
    contradict(reading, key("name"), "is the name of an earlier condition as well",
               {fmt::format("condition.{}.name", same->second)});
  else if (!own_file)
    contradict(reading, key("name"),
               "names the same files as an earlier condition, chatter-" + slug(c.name) +
                   "*: only letters of the Latin alphabet and digits tell file names apart",
               {fmt::format("condition.{}.name", file->second)});
  if (c.after.empty() || !reading.usable({key("after")}))
    return;
  if (after == earlier.by_name.end() || after->second == i) {
    contradict(reading, key("after"), "is not the name of an earlier condition", {});
    return;
  }
  const std::size_t before = after->second;
  const auto match         = [&](const char *mine, const double here, const char *other, const double there,
                         const std::string &what) {
    const std::string theirs = fmt::format("condition.{}.{}", before, other);
    if (reading.usable({key(mine), theirs}) && std::abs(here - there) > 1e-9 * std::abs(there))
      contradict(reading, key(mine), "does not continue the " + what + " that leaves the stand before", {theirs});
  };
  match("entry_thickness", c.entry_thickness, "exit_thickness", all[before].exit_thickness, "thickness");
  match("entry_tension", c.entry_tension, "exit_tension", all[before].exit_tension, "tension");
  match("width", c.width, "width", all[before].width, "width");
}

// One strip runs through one line of stands.
void check_one_tandem(const std::vector<RollingCondition> &all, Reading &reading)
{
  std::string last, last_key;
  std::set<std::string> names;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string key = fmt::format("condition.{}.after", i);
    const bool known      = names.count(all[i].after) > 0;
    names.insert(all[i].name);
    if (all[i].after.empty() || !known || !reading.usable({key}))
      continue;
    if (!last.empty() && all[i].after != last)
      contradict(reading, key, "begins a second line of stands; the first one continues after \"" + last + "\"",
                 {last_key});
    last     = all[i].name;
    last_key = key;
  }
}

void read_conditions(const Node &root, ChatterCase &spec, Reading &reading)
{
  const Node::Entry *entry = root.find("condition");
  if (!entry) {
    reading.add(Place{reading.file},
                "no [[condition]] is given; give at least one with its thicknesses, tensions, "
                "width and speed");
    return;
  }
  if (entry->value.kind != Node::Kind::array) {
    reading.add(entry->key_place, "a condition is written under [[condition]], in double brackets, one for each");
    return;
  }
  for (std::size_t i = 0; i < entry->value.items.size(); ++i) {
    const Node &node       = entry->value.items[i];
    const std::string name = fmt::format("condition.{}", i);
    if (node.kind != Node::Kind::table) {
      reading.add(node.place,
                  fmt::format("{} = {} is a value; a section [[condition]] is needed", name, shown(node)));
      continue;
    }
    RollingCondition condition;
    condition.place = node.place;
    read_and_echo({&node, name}, "[[condition]]", condition_rows(), condition, reading);
    spec.conditions.push_back(condition);
  }
  EarlierConditions earlier;
  for (std::size_t i = 0; i < spec.conditions.size(); ++i)
    check_condition(spec.conditions, i, spec, earlier, reading);
  check_one_tandem(spec.conditions, reading);
}
}  // namespace

ChatterAnalysis read_chatter_analysis(const Node &root, Reading &reading)
{
  ChatterAnalysis analysis;
  const Section section = section_at(root, "analysis", reading);
  read_and_echo(section, section.header(), chatter_analysis_rows(), analysis, reading);
  if (reading.usable({"analysis.speeds"}) && analysis.speeds[0] >= analysis.speeds[1])
    contradict(reading, "analysis.speeds", "does not run from the lower to the higher speed", {});
  return analysis;
}

StandSpan read_stand_span(const Node &root, Reading &reading)
{
  StandSpan span;
  const Section section = section_at(root, "stand", reading);
  read_and_echo(section, section.header(), stand_span_rows(), span, reading);
  return span;
}

ChatterCase read_chatter(const Node &root, Reading &reading)
{
  ChatterCase spec;
  BiteRollInput roll;
  const Section steel = section_at(root, "steel", reading), work_roll = section_at(root, "work_roll", reading);
  read_and_echo(steel, steel.header(), chatter_steel_rows(), spec.steel, reading);
  read_and_echo(work_roll, work_roll.header(), bite_roll_rows(), roll, reading);
  spec.roll_diameter     = roll.diameter;
  const bool strip_tells = read_strip_of_chatter(root, spec, reading);
  read_friction_law(root, spec, strip_tells, reading);
  spec.stand = read_stand(root, reading);
  if (!spec.stand.from.empty())
    read_model(spec, "stand", reading);
  read_variants(root, spec, reading);
  read_conditions(root, spec, reading);
  spec.analysis = read_chatter_analysis(root, reading);
  read_plant(root, reading);
  read_monitoring(root, reading);  // checked here, used by those who read records
  spec.advice = read_chatter_advice(root, spec.conditions, reading);
  return spec;
}
}  // namespace mill
