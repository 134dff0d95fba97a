#include "core/case/kinds.h"
#include "core/case/stand_reader.h"
#include "core/case/stand_sections.h"

namespace mill {
Lumped read_lumped(const Node &root, Reading &reading)
{
  Lumped lumped;
  lumped.given  = read_given(root, "given", "lumped", reading);
  lumped.passes = read_passes(root, pass_rows(), reading);
  check_passes(lumped.passes, reading);
  lumped.dynamics = read_dynamics(root, chain_dynamics_rows(), reading);
  check_published_force(lumped.dynamics, lumped.given, reading);
  return lumped;
}

const CaseKind &case_kind(const Lumped *)
{
  static const CaseKind kind = [] {
    CaseKind k;
    k.name     = "lumped";
    k.title    = "lumped model";
    k.read     = [](const Node &root, Reading &reading) -> CaseSpec { return read_lumped(root, reading); };
    k.sections = {head_section(), given_section(lumped_given_rows(), true), pass_section(false),
                  dynamics_section(chain_dynamics_rows())};
    k.notes    = {
           {"pass", "", {{"synthetic", "true"}},      {"synthetic_range"}},
           {"pass",
            "",         {{"name", "\"pass 2\""},
             {"synthetic", "true"},
             {"synthetic_range", "[\"733.705 kN\", \"742.280 kN\"]"},
             {"synthetic_seed", "2"}},
            {}                                                           }
    };
    k.given = k.published = lumped_given_rows();
    k.repeated            = [](const CaseSpec &spec, const std::string &section) {
      const auto &own = std::get<Lumped>(spec);
      return section == "pass" ? numbers_to(own.passes.size()) : std::vector<std::string>();
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
