#include "app/kinds/kind_inputs.h"
#include "core/case/turning_keys.h"
#include "core/records/result_names.h"
#include <utility>

namespace mill {
bool begins(const std::string &name, const std::string &prefix)
{
  return name.rfind(prefix, 0) == 0;
}

bool ends(const std::string &name, const std::string &ending)
{
  return name.size() >= ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

std::optional<KeyList> bite_inputs(MovingKeys &keys, const std::size_t p, const BiteSetup &setup,
                                   const std::string &name, const std::string &pass)
{
  BiteReading reading;
  reading.path_trim        = name == "K4.path_plateau";
  const std::string prefix = "bite." + pass + ".";
  if (begins(name, "K4."))
    return bite_keys(keys, p, reading);
  if (begins(name, "bite.fit.") && !setup.fit.empty())
    return bite_keys(keys, p);
  if (!begins(name, prefix))
    return {};
  const std::string quantity = name.substr(prefix.size());
  if (quantity.find('.') != std::string::npos && !begins(quantity, "fe."))
    reading.by = BiteAnswers::compared;
  reading.whole_width = follows_width(quantity.substr(quantity.rfind('.') + 1));
  reading.speed       = ends(quantity, "_speed");
  return bite_keys(keys, p, reading);
}

std::optional<KeyList> response_inputs(const Results &results, const DynamicsSettings &dynamics, const Pass &pass,
                                       const std::size_t p, const std::string &name)
{
  const bool on_curves = is_of(name, result_name({family::nonlinear, pass.name}));
  if (!on_curves && !begins(name, pass.name + ".peak_g.") && !begins(name, pass.name + ".rms_g."))
    return {};
  KeyList keys;
  const auto follow = [&](const Half half) {
    for (const std::string &part : chain_parts(dynamics, half)) {
      const Parameter *of_pass = results.find(pass.name + "." + part), *first = results.find(part);
      if (of_pass || first)
        keys = joined(std::move(keys), (of_pass ? of_pass : first)->inputs);
    }
  };
  const bool upper     = ends(name, ".upper_work_roll"),
             one_chain = dynamics.model == StandModelKind::six_mass && !on_curves;
  if (upper || !one_chain)
    follow(Half::upper);
  if (!upper || !one_chain)
    follow(Half::lower);
  return joined(keys, response_keys(dynamics, pass, p));
}

std::optional<KeyList> turning_inputs(const Results &results, const std::size_t orders, const std::string &name)
{
  if (results.find(name))
    return {};
  if (is_of(name, family::frf))
    return frequency_response_keys();
  return is_of(name, family::campbell) ? std::optional<KeyList>(campbell_keys(orders)) : std::nullopt;
}
}  // namespace mill
