#include "app/bite_stage.h"
#include "app/contact_stage.h"
#include "core/csv.h"
#include "dynamics/bite.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
Parameter solve_bite_stiffness(RunContext &run, const FourHigh &stand, const Pass &pass, const double force,
                               const bool write)
{
  StageTimer timer(run, "bite, " + pass.name);
  dynamics::RollBite bite;
  bite.strip = stand.strip;
  if (!std::isnan(pass.entry_thickness))
    bite.strip.entry_thickness = pass.entry_thickness;
  if (!std::isnan(pass.exit_thickness))
    bite.strip.exit_thickness = pass.exit_thickness;
  bite.roll_radius     = 0.5 * stand.work_roll.barrel_diameter;
  bite.roll            = stand.steel;
  const auto state     = dynamics::solve_bite(bite);
  const auto stiffness = dynamics::bite_stiffness(bite, state);

  Parameter k;
  k.unit   = "N/m";
  k.method = "slab model of Bland and Ford";
  k.at     = fmt::format("{}, {:.4g} -> {:.4g} mm, {:.1f} kN", pass.name, 1e3 * bite.strip.entry_thickness,
                         1e3 * bite.strip.exit_thickness, state.force / 1e3);
  k.inputs = {"strip.width",    "strip.entry_thickness",     "strip.exit_thickness", "strip.flow_stress",
              "strip.friction", "work_roll.barrel_diameter", "steel.youngs_modulus", "steel.poisson_ratio"};
  // What is not known about the slab model here: whether R' follows, and how far its force is from the recorded
  // one.
  const double following = std::abs(stiffness.plastic_slope_following / stiffness.plastic_slope - 1);
  const double against   = std::abs(state.force / force - 1);
  const auto quantity    = [&](const double value, const char *how, std::vector<Check> checks) {
    Parameter out = k;
    out.value     = value;
    out.method += how;
    out.error_estimate = std::max(following, against);
    out.checks         = std::move(checks);
    return out;
  };
  const double dh = bite.strip.entry_thickness - bite.strip.exit_thickness;
  const Parameter slope =
      quantity(stiffness.plastic_slope, ", -dF/dh at fixed R'",
               {
                   {"with R' following",                      stiffness.plastic_slope_following, "quasi-static rolls"},
                   {"F / reduction, upper rule of thumb",     state.force / dh,                  ""                  },
                   {"F / (2 reduction), lower rule of thumb", state.force / (2 * dh),            ""                  }
  });
  const Parameter flat      = quantity(stiffness.flattening, ", elastic flattening of one roll", {});
  const Parameter combined  = quantity(stiffness.combined, ", plastic slope in series with both rolls", {});
  Parameter bite_force      = k;
  bite_force.unit           = "N";
  bite_force.value          = state.force;
  bite_force.error_estimate = against;
  bite_force.checks         = {
              {"mean of the recorded force", force, ""}
  };
  run.results.add("bite." + pass.name + ".force", bite_force);
  if (write) {
    run.results.add("K4.plastic_slope", slope);
    run.results.add("K4.flattening", flat);
    run.results.add("K4.combined", combined);
    Table arc;
    arc.add("x", "m", state.position).add("pressure", "Pa", state.pressure).add("thickness", "m", state.thickness);
    run.out.write("curves/bite.csv", csv_text(arc));
    for (const std::string &note : state.notes)
      run.warn("bite: " + note);
    run.assume("strip.flow_stress and strip.friction give the slab model's force of " + in_kN(state.force) +
               " beside " + in_kN(force) + " recorded");
  }
  return combined;
}
}  // namespace mill
