#include "core/case/mend_names.h"
#include "core/base/error_list.h"
#include "core/case/given.h"
#include "core/case/removed_keys.h"
#include "core/case/stand_reader.h"
#include <algorithm>
#include <iterator>
#include <map>

namespace mill {
namespace {
using Names = std::vector<std::string>;

bool holds_name(const Names &names, const std::string &name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool has_sections_only(const Node &node)
{
  return node.kind == Node::Kind::table && std::all_of(node.entries.begin(), node.entries.end(),
                                                       [](const Node::Entry &e) { return e.value.section; });
}

// Is the section there only because [strip.flow_stress] is, so that the values of [stripe] belong into it?
bool takes(const Node::Entry &there, const Node::Entry &stranger)
{
  return has_sections_only(there.value) && stranger.value.section && stranger.value.kind == Node::Kind::table &&
         std::none_of(stranger.value.entries.begin(), stranger.value.entries.end(),
                      [&](const Node::Entry &e) { return there.value.find(e.key); });
}

void join_sections_of_one_name(Node &table)
{
  for (std::size_t i = 0; i < table.entries.size(); ++i)
    for (std::size_t k = i + 1; k < table.entries.size(); ++k)
      if (table.entries[i].key == table.entries[k].key && table.entries[i].value.section) {
        auto &into = table.entries[i].value.entries, &from = table.entries[k].value.entries;
        std::move(from.begin(), from.end(), std::back_inserter(into));
        table.entries.erase(table.entries.begin() + std::ptrdiff_t(k--));
      }
}

void mend(Node &table, const Section &section, const Names &known, const bool values_only, Reading &reading)
{
  std::size_t strangers = 0;
  bool joins            = false;
  for (Node::Entry &entry : table.entries) {
    if (holds_name(known, entry.key) || (values_only && entry.value.section) || !removal_note(entry.key).empty())
      continue;
    if (++strangers > 2 * most_problems_shown)
      return;  // so many are not slips: a damaged file may have a hundred thousand names
    const std::string meant = nearest_word(entry.key, known);
    if (meant.empty())
      continue;
    const Node::Entry *there = table.find(meant);
    if (there && !takes(*there, entry))
      continue;
    joins = joins || there;
    report_unknown(entry, section, known, reading);
    entry.key = meant;
  }
  if (joins)
    join_sections_of_one_name(table);
}

// Below the root by "contact.upper"; nullptr when it is not there or no table.
Node *table_at(Node &root, const std::string &name)
{
  Node *node = &root;
  if (!name.empty())
    for (const std::string &part : split(name, ".")) {
      const auto match = std::find_if(node->entries.begin(), node->entries.end(),
                                      [&](const Node::Entry &entry) { return entry.key == part; });
      if (match == node->entries.end() || match->value.kind != Node::Kind::table)
        return nullptr;
      node = &match->value;
    }
  return node;
}

Names keys_of_rows(const std::vector<Row> &rows)
{
  Names keys;
  for (const Row &row : rows)
    keys.push_back(row.key);
  return keys;
}

// What may stand directly below each section that is there once; "" is the top.  A map is in the order in which a
// section comes before those below it.
std::map<std::string, Names> names_below(const std::string &kind)
{
  std::map<std::string, Names> below;
  const auto add = [&](const std::string &section, const std::string &name) {
    if (Names &names = below[section]; !holds_name(names, name))
      names.push_back(name);
  };
  for (const SectionRows &section : sections_of(kind)) {
    std::string parent;
    for (const std::string &part : split(section.name, ".")) {
      if (part.empty())
        continue;
      add(parent, part);
      parent += (parent.empty() ? "" : ".") + part;
    }
    if (section.repeat == SectionRows::Repeat::once)
      for (const Row &row : section.rows)
        add(section.name, row.key);
  }
  return below;
}

// [bearing.NAME] of rollers and of oil films, [[pass]].
void mend_repeated(Node &root, const SectionRows &section, Reading &reading)
{
  const auto all = std::find_if(root.entries.begin(), root.entries.end(),
                                [&](const Node::Entry &entry) { return entry.key == section.name; });
  if (all == root.entries.end())
    return;
  const Names known = keys_of_rows(section.rows);
  if (section.repeat == SectionRows::Repeat::list) {
    for (std::size_t i = 0; i < all->value.items.size(); ++i) {
      Node &node = all->value.items[i];
      mend(node, {&node, section.name + "." + std::to_string(i)}, known, false, reading);
    }
    return;
  }
  for (Node::Entry &entry : all->value.entries) {
    const bool of_this_type = section.name != "bearing" || section.type.empty() != is_oil_film(entry);
    if (entry.value.kind == Node::Kind::table && of_this_type)
      mend(entry.value, {&entry.value, section.name + "." + entry.key}, known, false, reading);
  }
}

// { value = "..", source = ".." } of [given] and [published].
void mend_given(Node &root, Reading &reading)
{
  for (const char *name : {"given", "published"})
    if (Node *given = table_at(root, name))
      for (Node::Entry &entry : given->entries)
        if (entry.value.kind == Node::Kind::table)
          mend(entry.value, {&entry.value, std::string(name) + "." + entry.key}, given_table_keys(), false,
               reading);
}
}  // namespace

void mend_head(Node &root, Reading &reading)
{
  mend(root, {&root, ""}, keys_of_rows(rows_of(head_rows())), true, reading);
}

void mend_names(Node &root, const std::string &kind, Reading &reading)
{
  for (const auto &[name, known] : names_below(kind))
    if (Node *table = table_at(root, name))
      mend(*table, {table, name}, known, false, reading);
  for (const SectionRows &section : sections_of(kind))
    if (section.repeat != SectionRows::Repeat::once)
      mend_repeated(root, section, reading);
  mend_given(root, reading);
}
}  // namespace mill
