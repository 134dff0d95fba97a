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
  lumped.dynamics           = read_dynamics(root, chain_dynamics_rows(), reading);
  lumped.frequency_response = read_frequency_response(root, reading);
  lumped.campbell           = read_campbell(root, chain_campbell_rows(), reading);
  lumped.drive              = read_drive_orders(root, reading);
  check_turning_shafts(lumped.campbell, lumped.drive, reading);
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
    k.sections = {head_section(),
                  given_section(lumped_given_rows(), true),
                  pass_section(false),
                  dynamics_section(chain_dynamics_rows()),
                  frequency_response_section(),
                  campbell_section(chain_campbell_rows()),
                  drive_order_section()};
    k.notes    = {
           drive_order_note(),
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
      if (section == "drive.order")
        return numbers_to(own.drive.size());
      return section == "pass" ? numbers_to(own.passes.size()) : std::vector<std::string>();
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
