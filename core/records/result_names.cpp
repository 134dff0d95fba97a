#include "core/records/result_names.h"
#include "core/records/chain_number.h"
#include "core/records/contact_name.h"
#include <algorithm>
#include <limits>
#include <stdexcept>

namespace mill {
std::string result_name(const std::vector<std::string> &parts)
{
  std::string name;
  for (const std::string &part : parts)
    if (!part.empty())
      name += (name.empty() ? "" : ".") + part;
  return name;
}

std::string spring_of_contact(const std::string &contact)
{
  const auto name = choice_named<ContactName>(contact);
  return name == ContactName::upper   ? word_of(ChainNumber::K3)
         : name == ContactName::lower ? word_of(ChainNumber::K5)
                                      : result_name({family::contact, contact});
}

const char *name_of(const CheckId id)
{
  switch (id) {
  case CheckId::published:
    return "published";
  case CheckId::published_model:
    return "published model";
  case CheckId::published_total:
    return "published total";
  case CheckId::published_times_Z5:
    return "published per-roller values times Z/5";
  case CheckId::published_times_stribeck:
    return "published per-roller values times Z cos^2(alpha)/4.085";
  case CheckId::measured:
    return "measured";
  case CheckId::johnson_secant:
    return "Johnson, axis to axis (3.5a)";
  case CheckId::middle_section:
    return "mid-length section over the whole length";
  case CheckId::held_as_in_stand:
    return "rolls held as in the stand";
  case CheckId::closed_form_mass:
    return "shapes of the chain (4.14)-(4.16)";
  case CheckId::fe_integral_mass:
    return "finite-element axis shape, same integrals (22.14)";
  case CheckId::fe_solid_mass:
    return "all points of the finite elements (22.15)";
  case CheckId::stepped_beams:
    break;
  }
  return "rolls as stepped beams (4.4)-(4.10)";
}

Check check(const CheckId id, const double value, std::string note)
{
  return {name_of(id), value, std::move(note)};
}

const Check *find_check(const std::vector<Check> &checks, const CheckId id)
{
  const auto match =
      std::find_if(checks.begin(), checks.end(), [&](const Check &c) { return c.name == name_of(id); });
  return match == checks.end() ? nullptr : &*match;
}

const Check *find_published(const std::vector<Check> &checks)
{
  for (const Check &c : checks)
    for (const CheckId id : {CheckId::published, CheckId::published_model, CheckId::published_total,
                             CheckId::published_times_Z5, CheckId::published_times_stribeck})
      if (c.name == name_of(id))
        return &c;
  return nullptr;
}

double value_beside(const std::vector<Check> &checks, const CheckId id)
{
  const Check *check = find_check(checks, id);
  return check ? check->value : std::numeric_limits<double>::quiet_NaN();
}

std::string curve_path(const CurveKind &kind, const std::string &item, const std::string &quantity)
{
  std::string path = std::string("curves/") + kind.family;
  if (kind.has_item)
    path += "-" + item;
  if (*kind.ending || !quantity.empty())
    path += kind.joint;
  return path + kind.ending + quantity;
}

namespace {
// The item and what it is of, when `rest` of a path ends as the kind does.
std::optional<CurveName> as(const CurveKind &kind, const std::string &rest)
{
  const std::string ending = *kind.ending ? std::string("-") + kind.ending : "";
  if (ending.empty())
    return CurveName{&kind, rest, ""};
  if (ending.back() == '-') {
    const std::size_t begin = rest.rfind(ending);
    if (begin == std::string::npos || begin == 0 || begin + ending.size() == rest.size())
      return std::nullopt;
    return CurveName{&kind, rest.substr(0, begin), rest.substr(begin + ending.size())};
  }
  if (rest.size() <= ending.size() || rest.compare(rest.size() - ending.size(), ending.size(), ending) != 0)
    return std::nullopt;
  return CurveName{&kind, rest.substr(0, rest.size() - ending.size()), ""};
}
}  // namespace

std::optional<CurveName> curve_name(const std::string &path)
{
  std::optional<CurveName> best;
  for (const CurveKind *kind : curve::all) {
    const std::string start = std::string("curves/") + kind->family + "-";
    if (path.size() <= start.size() || path.compare(0, start.size(), start) != 0)
      continue;
    const auto name = as(*kind, path.substr(start.size()));
    if (name && (!best || name->item.size() < best->item.size()))  // the longest ending
      best = name;
  }
  return best;
}

void require_columns(const CurveKind &kind, const Table &table)
{
  std::size_t n = 0;
  for (; n < kind.columns.size() && *kind.columns[n].name; ++n)
    if (n >= table.names.size() || table.names[n] != kind.columns[n].name)
      throw std::logic_error(curve_path(kind) + " has no column " + kind.columns[n].name + " at place " +
                             std::to_string(n + 1));
  if (!kind.more && table.names.size() > n)
    throw std::logic_error(curve_path(kind) + " has a column " + table.names[n] +
                           " that no table of names contains");
}
}  // namespace mill
