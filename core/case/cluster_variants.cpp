#include "core/case/cluster_variants.h"
#include "core/base/name_part.h"
#include "core/case/cluster_rows.h"
#include "core/case/stand_reader.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
struct KeyParts {
  std::string list, name, key;
};

std::string without_blanks(const std::string &text)
{
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// "contact.W-R.law", "stack.spin".
KeyParts parts_of_key(const std::string &text)
{
  const auto first = text.find('.'), last = text.rfind('.');
  if (first == std::string::npos)
    return {"", "", text};
  return {text.substr(0, first), first == last ? "" : name_part(text.substr(first + 1, last - first - 1)),
          text.substr(last + 1)};
}

template <class T, class NameOf> T *member_of(std::vector<T> &list, const std::string &name, const NameOf &name_of)
{
  const auto match = std::find_if(list.begin(), list.end(), [&](const T &one) { return name_of(one) == name; });
  return match == list.end() ? nullptr : &*match;
}

template <class T> const Field<T> *row_named(const std::vector<Field<T>> &rows, const std::string &key)
{
  const auto match = std::find_if(rows.begin(), rows.end(), [&](const Field<T> &row) { return key == row.key; });
  return match == rows.end() ? nullptr : &*match;
}

// Calls work(part, rows) with the part that the key belongs to; false where there is none.
template <class Work> bool visit_part(ClusterStand &stand, const KeyParts &key, const Work &work)
{
  const auto with = [&](auto *part, const auto &rows) {
    if (part)
      work(*part, rows);
    return part != nullptr;
  };
  if (key.list == "roll")
    return with(member_of(stand.rolls, key.name, [](const ClusterRoll &r) { return r.name; }),
                cluster_roll_rows());
  if (key.list == "contact")
    return with(member_of(stand.contacts, key.name, [](const ClusterContact &c) { return c.pair; }),
                cluster_contact_rows());
  if (key.list == "support")
    return with(member_of(stand.supports, key.name, [](const ClusterSupport &s) { return s.own_name(); }),
                cluster_support_rows());
  if (key.list == "stack" && key.name.empty())
    return with(&stand.stack, cluster_stack_rows());
  return false;
}

Node node_of_text(const std::string &value)
{
  Node node;
  node.kind = Node::Kind::text;
  node.text = value;
  if (value == "true" || value == "false") {
    node.kind = Node::Kind::flag;
    node.flag = value == "true";
    return node;
  }
  char *end           = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  if (end != value.c_str() && *end == '\0') {
    node.kind   = Node::Kind::real;
    node.number = number;
  }
  return node;
}

template <class T> void set_by_row(T &part, const Field<T> &row, const std::string &value)
{
  Node table;
  table.entries.push_back({row.key, {}, node_of_text(value)});
  Reading variant_reading;
  const auto read = read_row(row_of(row), {&table, ""}, variant_reading);
  if (!read)
    throw InputError(variant_reading.problems.empty() ? std::string("is refused")
                                                      : variant_reading.problems.front().message);
  set_member(row, *read, part);
}

std::vector<std::string> fitted_modes(const ClusterStand &stand, const ClusterVariant &variant)
{
  if (!variant.modes.empty())
    return variant.modes;
  std::vector<std::string> all;
  for (const ClusterMode &mode : stand.modes)
    if (!std::isnan(mode.frequency))
      all.push_back(mode.name);
  return all;
}

void check_fit_of(const ClusterStand &stand, ClusterStand &changed, const ClusterVariant &variant,
                  const std::size_t i, Reading &reading)
{
  const auto key = [&](const char *k) { return fmt::format("variant.{}.{}", i, k); };
  for (const std::string &unknown : variant.unknowns)
    if (!number_of(changed, unknown))
      contradict(reading, key("unknowns"),
                 fmt::format("names '{}', which is not a given number of the stack; for example "
                             "support.E.stiffness, contact.W-I.stiffness of a spring",
                             unknown),
                 {});
  for (const std::string &name : variant.modes) {
    const auto mode =
        std::find_if(stand.modes.begin(), stand.modes.end(), [&](const ClusterMode &m) { return m.name == name; });
    if (mode == stand.modes.end())
      contradict(reading, key("modes"), fmt::format("names '{}', which is not the name of a [[mode]]", name), {});
    else if (std::isnan(mode->frequency))
      contradict(reading, key("modes"), fmt::format("names '{}', which has no frequency to be fitted to", name),
                 {});
  }
  if (const std::size_t data = fitted_modes(stand, variant).size(); variant.unknowns.size() > data)
    contradict(
        reading, key("unknowns"),
        fmt::format("are {} numbers for {} frequencies; a fit needs at least as many frequencies as unknowns",
                    variant.unknowns.size(), data),
        {});
}
}  // namespace

double *number_of(ClusterStand &stand, const std::string &key)
{
  double *number       = nullptr;
  const KeyParts parts = parts_of_key(key);
  visit_part(stand, parts, [&](auto &part, const auto &rows) {
    if (const auto *row = row_named(rows, parts.key))
      if (auto *member = std::get_if<0>(&row->member))
        number = &(part.**member);
  });
  return number && !std::isnan(*number) ? number : nullptr;
}

void set_value(ClusterStand &stand, const std::string &set)
{
  const auto equals = set.find('=');
  if (equals == std::string::npos)
    throw InputError(fmt::format("'{}' has no '='; for example contact.W-R.law = spring", set));
  const KeyParts parts = parts_of_key(without_blanks(set.substr(0, equals)));
  bool known           = false;
  const bool part_is   = visit_part(stand, parts, [&](auto &part, const auto &rows) {
    if (const auto *row = row_named(rows, parts.key)) {
      set_by_row(part, *row, without_blanks(set.substr(equals + 1)));
      known = true;
    }
  });
  if (!part_is)
    throw InputError(
        fmt::format("'{}' names no part of the stack; contact.PAIR.KEY, support.NAME.KEY, roll.NAME.KEY "
                    "and stack.KEY do",
                    without_blanks(set.substr(0, equals))));
  if (!known)
    throw InputError(fmt::format("'{}' is not a key of [[{}]]", parts.key, parts.list));
}

ClusterStand with_variant(const ClusterStand &stand, const ClusterVariant &variant)
{
  ClusterStand changed = stand;
  for (const std::string &set : variant.set)
    set_value(changed, set);
  return changed;
}

void check_variants(const ClusterStand &stand, Reading &reading)
{
  for (std::size_t i = 0; i < stand.variants.size(); ++i) {
    const ClusterVariant &variant = stand.variants[i];
    const auto key                = [&](const char *k) { return fmt::format("variant.{}.{}", i, k); };
    check_not_empty(key("name"), variant.name, reading);
    for (std::size_t k = 0; k < i; ++k)
      if (stand.variants[k].name == variant.name)
        contradict(reading, key("name"), "appears twice", {fmt::format("variant.{}.name", k)});
    if (!variant.pass.empty() && std::none_of(stand.schedule.begin(), stand.schedule.end(),
                                              [&](const ClusterPass &p) { return p.name == variant.pass; }))
      contradict(reading, key("pass"), "is not a pass of the schedule", {});
    try {
      ClusterStand changed = with_variant(stand, variant);
      check_fit_of(stand, changed, variant, i, reading);
    } catch (const InputError &e) {
      contradict(reading, key("set"), "cannot be set: " + e.problems.front().message, {});
    }
  }
}
}  // namespace mill
