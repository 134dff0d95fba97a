#include "app/stages/result_inputs.h"
#include "core/case/stand_rows.h"
#include "core/records/provenance.h"
#include <fmt/format.h>
#include <optional>

namespace mill {
namespace {
bool begins(const std::string &name, const std::string &prefix)
{
  return name.rfind(prefix, 0) == 0;
}

bool ends(const std::string &name, const std::string &ending)
{
  return name.size() >= ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

// K3.* and contact.upper.*, or the same of the lower rolls.
std::optional<KeyList> contact_inputs(const FourHigh &stand, const std::string &name, const std::size_t p)
{
  const bool upper = begins(name, "K3.") || begins(name, "contact.upper.");
  if (!upper && !begins(name, "K5.") && !begins(name, "contact.lower."))
    return {};
  const std::string which = upper ? "upper" : "lower";
  const KeyList keys      = contact_keys(stand, which, p);
  if (ends(name, ".friction_tangent"))
    return joined(keys, keys_in("contact." + which, "friction"));
  return ends(name, ".path_plateau") ? joined(keys, keys_in("contact." + which, "path_trim")) : keys;
}

// K4.* and bite.PASS.*; those of one model have its name before theirs.
std::optional<KeyList> bite_inputs(const BiteRun &bite, const std::string &name, const std::string &pass)
{
  const std::string own = "bite." + pass + ".";
  if (name == "K4.path_plateau")
    return joined(bite_keys(bite), keys_in("bite", "path_trim"));
  if (begins(name, "K4."))
    return bite_keys(bite);
  if (!begins(name, own))
    return {};
  const std::string quantity = name.substr(own.size());
  const KeyList speed = ends(quantity, "_speed") ? keys_in(fmt::format("pass.{}", bite.pass), "speed") : KeyList{};
  const bool beside   = quantity.find('.') != std::string::npos && !begins(quantity, "fe.");
  BiteRun asked       = bite;
  asked.whole_width   = follows_width(quantity.substr(quantity.rfind('.') + 1));
  return joined(beside ? slab_keys(asked) : bite_keys(asked), speed);
}

// PASS.peak_g.* and PASS.rms_g.*: the numbers of the chain that drives the work roll, and what is done with them.
std::optional<KeyList> response_inputs(const Results &results, const DynamicsSettings &dynamics, const Pass &pass,
                                       const std::size_t p, const std::string &name)
{
  if (!begins(name, pass.name + ".peak_g.") && !begins(name, pass.name + ".rms_g."))
    return {};
  KeyList keys;
  const auto follow = [&](const Half half) {
    for (const std::string &part : chain_parts(dynamics, half)) {
      const Parameter *own = results.find(pass.name + "." + part), *first = results.find(part);
      if (own || first)
        keys = joined(keys, (own ? own : first)->inputs);
    }
  };
  const bool upper = ends(name, ".upper_work_roll"), one_chain = dynamics.model == "six-mass";
  if (upper || !one_chain)
    follow(Half::upper);
  if (!upper || !one_chain)
    follow(Half::lower);
  return joined(keys, response_keys(dynamics, pass, p));
}

std::optional<KeyList> inputs_of(const FourHigh &stand, const Results &results, const std::string &full)
{
  for (std::size_t p = 0; p < stand.passes.size(); ++p) {
    const Pass &pass = stand.passes[p];
    if (const auto keys = response_inputs(results, stand.dynamics, pass, p, full))
      return keys;
    const BiteRun bite{stand.strip, stand.bite, p, "work_roll.barrel_diameter"};
    if (begins(full, "bite."))
      if (const auto keys = bite_inputs(bite, full, pass.name))
        return keys;
    const std::string prefix = p == 0 ? "" : pass.name + ".";
    const std::string name   = begins(full, prefix) ? full.substr(prefix.size()) : "";
    if (const auto keys = contact_inputs(stand, name, p))
      return keys;
    if (begins(name, "K4."))
      return bite_inputs(bite, name, pass.name);
    for (std::size_t i = 0; i < 4; ++i)
      if (begins(name, fmt::format("Kzc{}.", i + 1)))
        return seat_keys(stand, i, p);
  }
  return {};
}

std::optional<KeyList> inputs_of(const Lumped &lumped, const Results &results, const std::string &name)
{
  for (std::size_t p = 0; p < lumped.passes.size(); ++p)
    if (const auto keys = response_inputs(results, lumped.dynamics, lumped.passes[p], p, name))
      return of_kind(*keys, "lumped");
  const Parameter *made = results.find(name);
  return made ? std::optional<KeyList>(of_kind(made->inputs, "lumped")) : std::nullopt;
}

std::optional<KeyList> inputs_of(const TwoCylinders &, const Results &, const std::string &name)
{
  return cylinder_keys(name);
}

std::optional<KeyList> inputs_of(const BearingCase &spec, const Results &, const std::string &name)
{
  const KeyList keys = bearing_case_keys(spec);
  if (!begins(name, "Kzc.motion."))
    return keys;
  KeyList motion = keys_in("load", "loads samples");  // the mass swings on the curve
  for (const Row &row : rows_of(bearing_motion_rows()))
    motion.push_back("dynamics." + row.key);
  return joined(keys, motion);
}

std::optional<KeyList> inputs_of(const BiteCase &spec, const Results &, const std::string &name)
{
  for (std::size_t p = 0; p < spec.passes.size(); ++p)
    if (const auto keys = bite_inputs({spec.strip, spec.bite, p, "work_roll.diameter"}, name, spec.passes[p].name))
      return keys;
  return {};
}

std::optional<KeyList> inputs_of(const ChatterCase &spec, const Results &, const std::string &name)
{
  for (std::size_t i = 0; i < spec.conditions.size(); ++i) {
    const std::string &condition = spec.conditions[i].name;
    const KeyList speed          = keys_in(fmt::format("condition.{}", i), "speed");
    if (begins(name, "bite." + condition + "."))
      return joined(chatter_bite_keys(spec, i), speed);
    const KeyList searched =
        joined(chatter_bite_keys(spec, i), chatter_stand_keys(spec), keys_in("analysis", "speeds"));
    if (name == "chatter." + condition + ".critical_speed" || name == "chatter." + condition + ".frequency")
      return searched;
  }
  return {};
}
}  // namespace

void set_inputs(Results &results, const Case &the_case)
{
  for (auto &[name, parameter] : results.values)
    if (const auto keys = std::visit(
            [&, &full = name](const auto &spec) { return inputs_of(spec, results, full); }, the_case.spec))
      parameter.inputs = *keys;
}

std::vector<std::string> beside_the_chain(const Case &the_case, const std::string &key)
{
  std::vector<std::string> names{"K3.friction_tangent", "K3.path_plateau", "K5.friction_tangent",
                                 "K5.path_plateau",     "K4.path_plateau", "Kzc.motion.frequency"};
  std::vector<std::string> found;
  for (const std::string &name : names) {
    const auto keys =
        std::visit([&](const auto &spec) { return inputs_of(spec, Results(), name); }, the_case.spec);
    if (keys && holds(*keys, key))
      found.push_back(name);
  }
  return found;
}

void set_inputs(reduce::ChainInputs &springs, const FourHigh &stand, const std::size_t pass)
{
  springs.K3.inputs = contact_keys(stand, "upper", pass);
  springs.K5.inputs = contact_keys(stand, "lower", pass);
  springs.K4.inputs = bite_keys({stand.strip, stand.bite, pass, "work_roll.barrel_diameter"});
  const auto solved = [&](const std::size_t seat) { return !stand.given.count(fmt::format("Kzc{}", seat + 1)); };
  for (std::size_t i = 0; i < springs.Kzc.size(); ++i)
    if (solved(i)) {
      springs.Kzc[i].inputs        = seat_keys(stand, i, pass);
      springs.Kzc_across[i].inputs = seat_across_keys(stand, i, pass);
    }
  if (solved(0))
    springs.K_Zy_upper.inputs = seat_keys(stand, 0, pass);
  if (solved(3))
    springs.K_Zy_lower.inputs = seat_keys(stand, 3, pass);
}
}  // namespace mill
