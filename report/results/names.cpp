#include "report/results/names.h"
#include "core/records/chain_number.h"
#include "core/records/chain_results.h"
#include "core/records/contact_name.h"
#include "core/records/open_rows.h"
#include "core/records/result_names.h"
#include "core/records/result_place.h"
#include "core/records/rows_of_contact.h"
#include "core/records/rows_of_stand.h"
#include "report/results/named_mode.h"
#include <algorithm>

namespace mill::report {
namespace {
void add(Group &group, const Result *result)
{
  if (result)
    group.results.push_back(result);
}

bool is_of_a_contact(const std::string &name)
{
  const auto id = result_id_or_open(name);
  return id && (id->is_of(row::contact::all) || id->is_of(row::space::all) || id->is_of(row::line::all) ||
                id->is_of(row::open::contact));
}
}  // namespace

std::string meaning_of(const std::string &name)
{
  return meaning_of_result(name);
}

const Result *chain_value(const Run &run, const std::string &name)
{
  if (const Result *result = run.find(name))
    return result;
  const auto solved = solved_result_of(name);
  return solved ? run.find(*solved) : nullptr;
}

std::vector<Group> short_groups(const Run &run)
{
  if (run.manifest.kind == KindOfCase::bearing)
    return bearing_groups(run);
  if (run.manifest.kind == KindOfCase::bite)
    return bite_groups(run);
  if (run.manifest.kind == KindOfCase::chatter)
    return chatter_groups(run);
  if (run.manifest.kind == KindOfCase::cluster)
    return cluster_groups(run);
  if (run.manifest.kind == KindOfCase::stack)
    return stack_groups(run);
  Group contact{"Contact", {}}, stiffness{"Stiffness", {}}, mass{"Equivalent mass", {}}, named{"", {}},
      chain{"", {}}, fit{"Fit to measured values", {}};
  if (run.manifest.kind == KindOfCase::two_cylinders || !chain_value(run, "K1"))
    for (const Result &result : run.results)
      if (is_of_a_contact(result.name))
        contact.results.push_back(&result);
  for (int i = 1; i <= 7; ++i)
    add(stiffness, chain_value(run, "K" + std::to_string(i)));
  for (int i = 1; i <= 4; ++i)
    add(stiffness, chain_value(run, "Kzc" + std::to_string(i)));
  for (const Result &result : run.results)  // of every pass
    if (is_made_by(row::stand::modulus_tangent, result.name) || is_made_by(row::stand::modulus_kiss, result.name))
      stiffness.results.push_back(&result);
  for (int i = 1; i <= 6; ++i)
    add(mass, run.find("M" + std::to_string(i)));
  // The modes of the best model lead, those of the six masses follow for comparison.
  const bool detailed = run.find("craig-bampton.f1") || run.find("beam.f1");
  for (const Result &result : run.results)
    if (const auto id = result_id(result.name);
        detailed && id && id->is_of(row::modes::frequency) && id->place("open").empty()) {
      named.title = "Natural frequency, " + named_mode(result).model;
      named.results.push_back(&result);
    }
  for (int i = 1; i <= 6; ++i)
    add(chain, run.find("f" + std::to_string(i)));
  for (const char *number : {"friction", "friction_factor", "flow_stress_factor"})
    add(fit, run.find(result_name({family::bite, bite_fit, number})));
  chain.title = detailed ? "Natural frequency, compared with six masses" : "Natural frequency";

  std::vector<Group> groups;
  for (Group &group :
       {std::ref(contact), std::ref(stiffness), std::ref(mass), std::ref(named), std::ref(chain), std::ref(fit)})
    if (!group.results.empty())
      groups.push_back(group);
  for (const Group &group : condition_groups(run))
    groups.push_back(group);
  return groups;
}

std::string contact_title(const std::string &contact)
{
  const auto name = choice_named<ContactName>(contact);
  if (!name)
    return "contact " + contact;
  switch (*name) {
  case ContactName::upper:
  case ContactName::lower:
    return result_place("contact").words(contact);
  case ContactName::line:
    return "line contact";
  case ContactName::space:
    break;
  }
  return "contact in space";
}
}  // namespace mill::report
