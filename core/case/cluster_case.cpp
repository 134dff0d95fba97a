#include "core/model/cluster_case.h"
#include "core/case/advice_rows.h"
#include "core/case/cluster_rows.h"
#include "core/case/cluster_variants.h"
#include "core/case/stand_reader.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace mill {
namespace {
// A twenty-high mill with saddles has some thirty bodies; forty held by guides take 5 s, and the time grows with
// the fifth power and more.
constexpr std::size_t most_rolls = 40;

bool is_given(const Reading &reading, const std::string &key)
{
  return reading.places.count(key) > 0;
}

// [[roll]], [[contact]] ..: every table of the list.
template <class T>
std::vector<T> read_list(const Node &root, const std::string &name, const std::vector<Field<T>> &rows,
                         const bool needed, Reading &reading)
{
  std::vector<T> all;
  const Node::Entry *entry = root.find(name);
  if (!entry) {
    if (needed)
      reading.add(Place{reading.file}, fmt::format("no [[{}]] is given; give at least one", name));
    return all;
  }
  if (entry->value.kind != Node::Kind::array) {
    reading.bad.insert(name);
    reading.add(entry->key_place,
                fmt::format("a {0} is written under [[{0}]], in double brackets, one for each", name));
    return all;
  }
  for (std::size_t i = 0; i < entry->value.items.size(); ++i) {
    const Node &node      = entry->value.items[i];
    const std::string key = fmt::format("{}.{}", name, i);
    if (node.kind != Node::Kind::table) {
      reading.add(node.place,
                  fmt::format("{} = {} is a value; a section [[{}]] is needed", key, shown(node), name));
      continue;
    }
    T one;
    read_and_echo(Section{&node, key}, "[[" + name + "]]", rows, one, reading);
    one.place = node.place;
    all.push_back(std::move(one));
  }
  return all;
}

std::string numbered(const char *list, const std::size_t i, const char *key)
{
  return fmt::format("{}.{}.{}", list, i, key);
}

void check_word(const std::string &key, const std::string &name, Reading &reading)
{
  const bool good = !name.empty() && std::all_of(name.begin(), name.end(), [](const unsigned char c) {
    return std::isalnum(c) || std::string_view("_.%/").find(char(c)) != std::string_view::npos;
  });
  if (!good && reading.usable({key}))
    contradict(reading, key, "is not a name; use letters, digits, _, . and /", {});
}

template <class List, class NameOf>
void check_unique(const char *list, const char *key, const List &all, const NameOf &name_of, Reading &reading)
{
  std::map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (const auto [other, is_new] = first.emplace(name_of(all[i]), i); !is_new)
      contradict(reading, numbered(list, i, key), "appears twice", {numbered(list, other->second, key)});
}

std::vector<std::string> roll_names(const ClusterStand &stand)
{
  std::vector<std::string> names;
  for (const ClusterRoll &roll : stand.rolls)
    if (std::find(names.begin(), names.end(), roll.name) == names.end())
      names.push_back(roll.name);
  return names;
}

void check_known(const std::string &key, const std::string &name, const std::string &what,
                 const std::vector<std::string> &known, Reading &reading)
{
  if (reading.usable({key}) && std::find(known.begin(), known.end(), name) == known.end())
    contradict(reading, key, fmt::format("names no {}{}", what, suggestion(name, known)), {});
}

void check_rolls(const ClusterStand &stand, Reading &reading)
{
  if (stand.rolls.size() > most_rolls)
    reading.add(stand.rolls[most_rolls].place,
                fmt::format("{} sections [[roll]] are given; a cluster has at most {} rolls", stand.rolls.size(),
                            most_rolls));
  for (std::size_t i = 0; i < stand.rolls.size(); ++i)
    check_word(numbered("roll", i, "name"), stand.rolls[i].name, reading);
  check_unique(
      "roll", "name", stand.rolls, [](const ClusterRoll &r) { return r.name; }, reading);
  const auto names = roll_names(stand);
  const auto strip = split(stand.stack.strip, "-");
  if (!reading.usable({"stack.strip"}))
    return;
  if (strip.size() > 2)
    contradict(reading, "stack.strip", "names more than two rolls; the strip lies below one, or between two", {});
  for (const std::string &name : strip)
    check_known("stack.strip", name, strip.size() == 1 ? "roll" : "roll '" + name + "'", names, reading);
  if (is_given(reading, "stack.strip_stiffness") && strip.size() != 2)
    contradict(reading, "stack.strip_stiffness", "needs a roll on either side of the strip, strip = \"S-T\"",
               {"stack.strip"});
}

// No other key may be given with `like`, because all of them are taken from there.
template <class Rows>
void check_like(const char *list, const std::size_t i, const Rows &rows, const std::set<std::string> &own_keys,
                const std::string &like, const std::vector<std::string> &known, Reading &reading)
{
  const std::string key = numbered(list, i, "like");
  check_known(key, like, list, known, reading);
  for (const auto &row : rows)
    if (!own_keys.count(row.key) && is_given(reading, numbered(list, i, row.key)))
      contradict(reading, numbered(list, i, row.key),
                 "is taken from the one that `like` names; leave one of the two out", {key});
}

void check_contacts(const ClusterStand &stand, Reading &reading)
{
  const auto names = roll_names(stand);
  std::vector<std::string> originals;
  for (const ClusterContact &c : stand.contacts)
    if (c.like.empty())
      originals.push_back(c.pair);
  check_unique(
      "contact", "pair", stand.contacts, [](const ClusterContact &c) { return c.pair; }, reading);
  for (std::size_t i = 0; i < stand.contacts.size(); ++i) {
    const ClusterContact &c = stand.contacts[i];
    const std::string pair  = numbered("contact", i, "pair");
    const auto rolls        = split(c.pair, "-");
    if (reading.usable({pair}) && (rolls.size() != 2 || rolls[0] == rolls[1])) {
      contradict(reading, pair, "is not a pair of two rolls, \"W-I\"", {});
      continue;
    }
    for (const std::string &name : rolls)
      check_known(pair, name, "roll '" + name + "'", names, reading);
    if (!c.like.empty()) {
      check_like("contact", i, cluster_contact_rows(), {"pair", "like"}, c.like, originals, reading);
      continue;
    }
    const std::string law = numbered("contact", i, "law"), stiffness = numbered("contact", i, "stiffness");
    if (c.law == ClusterLaw::spring && std::isnan(c.stiffness) && reading.usable({law, stiffness}))
      contradict(reading, law, "needs a stiffness, for example stiffness = \"1.5e10 N/m\"", {});
    if (c.law == ClusterLaw::spring && c.exponent != 1 && std::isnan(c.load) &&
        reading.usable({numbered("contact", i, "load"), numbered("contact", i, "exponent")}))
      contradict(reading, numbered("contact", i, "exponent"),
                 "bends the spring; give the load where its stiffness belongs", {});
    for (const char *key : {"stiffness", "load", "exponent"})
      if (c.law != ClusterLaw::spring && is_given(reading, numbered("contact", i, key)))
        contradict(
            reading, numbered("contact", i, key),
            fmt::format("is a key of law = \"spring\", and the law of this contact is \"{}\"; leave it out, or "
                        "change the law",
                        word_of(c.law)),
            {law});
  }
}

void check_supports(const ClusterStand &stand, Reading &reading)
{
  const auto names = roll_names(stand);
  std::vector<std::string> originals;
  for (const ClusterSupport &s : stand.supports)
    if (s.like.empty())
      originals.push_back(s.own_name());
  check_unique(
      "support", "roll", stand.supports, [](const ClusterSupport &s) { return s.own_name(); }, reading);
  for (std::size_t i = 0; i < stand.supports.size(); ++i) {
    const ClusterSupport &s = stand.supports[i];
    const auto key          = [&](const char *k) { return numbered("support", i, k); };
    check_known(key("roll"), s.roll, "roll", names, reading);
    if (!s.like.empty()) {
      check_like("support", i, cluster_support_rows(), {"roll", "name", "like", "against"}, s.like, originals,
                 reading);
      continue;
    }
    const auto needs = [&](const char *k, const bool missing, const char *example) {
      if (missing && reading.usable({key(k), key("type")}))
        reading.add(s.place, fmt::format("support.{} of type {} has no '{}'; add for example {} = \"{}\"", i,
                                         word_of(s.type), k, k, example));
    };
    needs("stiffness", std::isnan(s.stiffness), "1.08e10 N/m");
    const bool curved = s.exponent != 1 && (s.type == SupportType::radial || s.type == SupportType::isotropic);
    needs("load", curved && std::isnan(s.load), "1148 kN");
    if (s.type == SupportType::rollers) {
      needs("half_angle", std::isnan(s.half_angle), "36 deg");
      needs("preload", std::isnan(s.preload), "4.5 kN");
      needs("against", s.against.empty(), "W");
      if (!s.against.empty())
        check_known(key("against"), s.against, "roll", names, reading);
    }
  }
}

void check_schedule(ClusterStand &stand, Reading &reading)
{
  std::vector<Pass> names;
  for (std::size_t i = 0; i < stand.schedule.size(); ++i) {
    ClusterPass &pass = stand.schedule[i];
    const auto key    = [&](const char *k) { return numbered("pass", i, k); };
    names.push_back(pass);
    if (std::isnan(pass.load) && reading.usable({key("load")}))
      if (const char *entry = "entry_thickness", *exit = "exit_thickness";
          reading.usable({key(entry), key(exit)}) &&
          !(is_given(reading, key(entry)) && is_given(reading, key(exit))))
        reading.add(pass.place,
                    fmt::format("pass.{} has no 'load' and no '{}'; give the load, or {} and {} together "
                                "with [strip.flow_stress] and the friction of the strip",
                                i, is_given(reading, key(entry)) ? exit : entry, entry, exit));
    if (reading.usable({key("entry_thickness"), key("exit_thickness")}) &&
        pass.exit_thickness >= pass.entry_thickness)
      contradict(reading, key("exit_thickness"), "is not smaller than the entry thickness",
                 {key("entry_thickness")});
    if (is_given(reading, key("dynamic_force")) != is_given(reading, key("dynamic_frequency")) &&
        reading.usable({key("dynamic_force"), key("dynamic_frequency")}))
      reading.add(pass.place,
                  fmt::format("pass.{}: dynamic_force and dynamic_frequency belong together; give both or "
                              "none",
                              i));
    // Whole tension forces over the section of the strip.
    const auto stress = [&](double &tension, const double pull, const double thickness, const char *tension_key,
                            const char *pull_key) {
      if (is_given(reading, key(tension_key)) && is_given(reading, key(pull_key)))
        contradict(reading, key(tension_key), "is the same as the pull over the section; leave one of the two out",
                   {key(pull_key)});
      if (!is_given(reading, key(tension_key)))
        tension = pull / (stand.strip.width * thickness);
    };
    stress(pass.entry_tension, pass.entry_pull, pass.entry_thickness, "entry_tension", "entry_pull");
    stress(pass.exit_tension, pass.exit_pull, pass.exit_thickness, "exit_tension", "exit_pull");
  }
  check_pass_names(names, reading);
  for (std::size_t i = 0; i < names.size(); ++i)
    check_not_empty(numbered("pass", i, "name"), names[i].name, reading);
}

Strip read_cluster_strip(const Node &root, Reading &reading)
{
  StripInput strip;
  const Section section    = section_at(root, "strip", reading);
  const Node::Entry *entry = section.node ? section.node->find("friction") : nullptr;
  const bool has_law       = entry && entry->value.kind == Node::Kind::table;
  auto rows                = cluster_strip_rows();
  if (has_law)
    rows.pop_back();
  read_and_echo(section, section.header(), rows, strip, reading,
                has_law ? std::vector<std::string>{"flow_stress", "friction"}
                        : std::vector<std::string>{"flow_stress"});
  if (section.node && section.node->find("flow_stress"))
    strip.flow_stress = read_flow_stress(root, reading);
  else
    strip.flow_stress.k = not_given;
  strip.friction.coefficient = strip.coulomb;
  if (has_law)
    strip.friction = read_friction_law({&entry->value, "strip.friction"}, reading);
  return strip;
}

// Laws of the strip: whole where they stand, and there where a pass leaves its force to them.
void check_strip_laws(const ClusterStand &stand, Reading &reading)
{
  if (is_given(reading, "strip.flow_stress.law"))
    check_flow_and_friction(stand.strip, reading);
  const auto computed = std::find_if(stand.schedule.begin(), stand.schedule.end(), [](const ClusterPass &pass) {
    return std::isnan(pass.load) && pass.exit_thickness < pass.entry_thickness;
  });
  if (computed == stand.schedule.end())
    return;
  if (std::isnan(stand.strip.flow_stress.k) && reading.usable({"strip.flow_stress.law", "strip.width"}))
    reading.add(computed->place,
                fmt::format("pass \"{}\" has no 'load', and [strip.flow_stress] that a force could be "
                            "computed from is missing; give one of the two",
                            computed->name));
  if (stand.strip.friction.law == FrictionLaw::coulomb && std::isnan(stand.strip.friction.coefficient) &&
      reading.usable({"strip.friction"}))
    reading.add(computed->place,
                fmt::format("pass \"{}\" has no 'load', and the friction in its bite is not given; add "
                            "friction = 0.05 to [strip], or a section [strip.friction]",
                            computed->name));
}

// The flow stress of every pass of a stack is fitted to its load by the closed theories, whatever [bite] asks for.
void check_no_fit(const BiteSetup &setup, Reading &reading)
{
  for (const auto &[key, wanted] :
       {std::pair{"bite.fit", !setup.fit.empty()}, {"bite.fit_for", !setup.fit_for.empty()}})
    if (wanted && reading.usable({key}))
      contradict(reading, key,
                 "is not solved in kind = \"cluster\": each pass with a load has its flow stress fitted to that "
                 "load without it; "
                 "remove it, or fit friction and flow stress of the same passes in a case of kind = \"bite\"",
                 {});
}

void check_modes(const ClusterStand &stand, Reading &reading)
{
  check_unique(
      "mode", "name", stand.modes, [](const ClusterMode &m) { return m.name; }, reading);
  for (std::size_t i = 0; i < stand.modes.size(); ++i)
    check_not_empty(numbered("mode", i, "name"), stand.modes[i].name, reading);
}

// The passes as conditions that advice.condition may name.
std::vector<RollingCondition> rolled_passes(const ClusterStand &stand)
{
  std::vector<RollingCondition> all;
  for (const ClusterPass &pass : stand.schedule) {
    all.emplace_back();
    all.back().name  = pass.name;
    all.back().speed = not_given;
  }
  return all;
}

std::shared_ptr<const ClusterStand> read_stand_of(const Node &root, Reading &reading)
{
  auto stand          = std::make_shared<ClusterStand>();
  const Section steel = section_at(root, "steel", reading), stack = section_at(root, "stack", reading),
                response = section_at(root, "response", reading);
  read_and_echo(steel, steel.header(), steel_rows(), stand->steel, reading);
  read_and_echo(stack, stack.header(), cluster_stack_rows(), stand->stack, reading);
  stand->rolls    = read_list(root, "roll", cluster_roll_rows(), true, reading);
  stand->contacts = read_list(root, "contact", cluster_contact_rows(), false, reading);
  stand->supports = read_list(root, "support", cluster_support_rows(), true, reading);
  stand->strip    = read_cluster_strip(root, reading);
  stand->schedule = read_list(root, "pass", cluster_pass_rows(), true, reading);
  read_and_echo(response, response.header(), cluster_response_rows(), stand->response, reading);
  stand->modes    = read_list(root, "mode", cluster_mode_rows(), false, reading);
  stand->bite     = read_bite_setup(root, reading);
  stand->span     = read_stand_span(root, reading);
  stand->analysis = read_chatter_analysis(root, reading);
  stand->advice   = read_chatter_advice(root, rolled_passes(*stand), reading);
  check_rolls(*stand, reading);
  check_contacts(*stand, reading);
  check_supports(*stand, reading);
  check_schedule(*stand, reading);
  check_strip_laws(*stand, reading);
  check_no_fit(stand->bite, reading);
  check_modes(*stand, reading);
  stand->variants = read_list(root, "variant", cluster_variant_rows(), false, reading);
  check_variants(*stand, reading);
  return stand;
}
}  // namespace

ClusterCase read_cluster(const Node &root, Reading &reading)
{
  return {read_stand_of(root, reading)};
}
}  // namespace mill
