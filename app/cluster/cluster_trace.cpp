#include "app/cluster/cluster_stage.h"
#include "app/trace/closed_form_parts.h"
#include "core/model/case.h"
#include "core/records/cluster_names.h"
#include <fmt/format.h>

namespace mill {
namespace {
ClosedFormResult result_of(const KeyList &keys, const std::string &name, const double value, const char *unit,
                           const double force)
{
  ClosedFormResult r;
  r.name             = name;
  r.parameter.value  = value;
  r.parameter.unit   = unit;
  r.parameter.method = "equilibrium and modes of the stack";
  r.parameter.at     = fmt::format("{:.5g} kN", 1e-3 * force);
  r.parameter.inputs = keys;
  r.closed           = keys;
  r.relation         = "balance of all rolls";
  r.file             = "cluster/equilibrium";
  r.equation         = "(38.11)";
  return r;
}
}  // namespace

// The run's own functions; a computed contact is a line contact by Johnson here.
std::vector<ClosedFormResult> closed_form_cluster(const Case &the_case)
{
  const ClusterStand &stand = *std::get<ClusterCase>(the_case.spec).stand;
  std::vector<ClosedFormResult> all;
  for (std::size_t p = 0; p < stand.schedule.size(); ++p) {
    const ClusterPass &pass = stand.schedule[p];
    const double force      = cluster_force(stand, pass).value;
    const auto state        = cluster::pass_state(stand, pass, force);
    const KeyList keys      = cluster_keys(the_case, p, false);
    const auto add = [&](const std::string &what, const std::string &more, const double value, const char *unit) {
      all.push_back(result_of(keys, result_name({family::cluster, pass.name, what, more}), value, unit, force));
    };
    add("force", "", force, "N");
    for (std::size_t i = 0; i < state.stack.contacts.size(); ++i) {
      const cluster::Contact &c = state.stack.contacts[i];
      const double f            = state.rest.contact_loads[i],
                   d            = cluster::contact_state(state.stack, c, state.rest.u).approach;
      add(c.name, "force", f, "N");
      if (!c.one_sided || f <= 0)
        continue;
      add(c.name, "approach", d, "m");
      add(c.name, "tangent", cluster::contact_tangent(c, d), "N/m");
      add(c.name, "secant", f / d, "N/m");
    }
    for (std::size_t i = 0; i < stand.rolls.size(); ++i)
      for (const int k : {0, 1})
        add(stand.rolls[i].name, k ? "y" : "x", state.rest.u[2 * Eigen::Index(i) + k], "m");
    for (std::size_t k = 0; k < state.modes.size(); ++k) {
      add(fmt::format("f{}", k + 1), "", state.modes[k].frequency, "Hz");
      all.back().relation = "eigenvalue of the tangent";
      all.back().file     = "cluster/modes";
      all.back().equation = "(38.13)";
    }
  }
  return all;
}
}  // namespace mill
