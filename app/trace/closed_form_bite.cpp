#include "app/stages/bite/bite_stage.h"
#include "app/stages/bite/bite_study.h"
#include "app/stages/bite/fit_stage.h"
#include "app/trace/closed_form_parts.h"
#include "core/case/moving_keys.h"
#include "core/model/bite_case.h"
#include "core/records/rows_of_bite.h"
#include <algorithm>
#include <fmt/format.h>

// The bite by a slab theory, for the closed-form model.
namespace mill {
namespace {
// What a number of the bite belongs to: to the whole width as a force does, or to any part of it.
enum class BiteSpan { whole_width, any_part };

// One number of the bite with what is known before it is solved.
ClosedFormResult bite_result(const std::string &name, const BiteSpan span, const BiteSetup &setup, const int pass,
                             MovingKeys *keys)
{
  const bool elements = setup.method == BiteMethod::fe;
  ClosedFormResult r;
  r.name = name;
  if (keys) {
    BiteReading reading;
    reading.whole_width = span == BiteSpan::whole_width;
    r.parameter.inputs  = bite_keys(*keys, std::size_t(pass), reading);
    // An arc of any shape is Hitchcock's here, without the elastic zones that make it one.
    reading.by = BiteAnswers::closed_form;
    r.closed   = bite_keys(*keys, std::size_t(pass), reading);
  }
  r.relation   = "roll bite";
  r.file       = elements ? "fem/strip/rigid_plastic/strip_flow" : "reduce/bite/slab/slab_bite";
  r.equation   = "(8.13)";
  r.stands_for = elements ? "finite elements of the strip, fem/strip/rigid_plastic/strip_flow" : "";
  return r;
}

struct SlabAnswer {
  bite::BiteState state;
  bite::BiteStiffness stiffness;
  std::string method;
};

// The slab theory of [bite], or Karman's for finite elements, which know no theory; an arc of any shape needs the
// section of the roll, so Hitchcock's represents it.
SlabAnswer solve_bite(const bite::RollBite &bite, const BiteSetup &setup)
{
  bite::SlabModel model = fem::slab_model(setup);
  if (setup.method == BiteMethod::fe)
    model.theory = bite::Theory::karman;
  if (model.arc == bite::Arc::elastic)
    model.arc = bite::Arc::hitchcock;
  model.curve_points = 0;
  SlabAnswer answer;
  answer.state     = bite::solve_slab(bite, model);
  answer.stiffness = bite::slab_stiffness(bite, answer.state);
  answer.method    = bite::model_name(model) + ", reduce/bite/slab/slab_bite (8.13)";
  return answer;
}
}  // namespace

ClosedFormResult closed_form_bite(const FourHigh &stand, const int pass, MovingKeys *keys)
{
  const auto bite =
      bite_of(stand.strip, stand.passes[std::size_t(pass)], stand.work_roll.barrel_diameter, stand.steel);
  ClosedFormResult r = bite_result("K4", BiteSpan::whole_width, stand.bite, pass, keys);
  r.parameter.unit   = "N/m";
  try {
    const SlabAnswer answer = solve_bite(bite, stand.bite);
    r.parameter.value       = answer.stiffness.combined;
    r.parameter.method      = answer.method;
  } catch (const InputError &e) {
    r.parameter.method = "no answer: " + e.problems.front().message;
  } catch (const SolverError &e) {
    r.parameter.method = "no answer: " + e.report.what;
  }
  return r;
}

std::optional<bite::BiteStiffness> closed_form_bite_stiffness(const FourHigh &stand, const int pass)
{
  try {
    return solve_bite(
               bite_of(stand.strip, stand.passes[std::size_t(pass)], stand.work_roll.barrel_diameter, stand.steel),
               stand.bite)
        .stiffness;
  } catch (const InputError &) {
  } catch (const SolverError &) {
  }
  return {};
}

std::vector<ClosedFormResult> closed_form_bite_case(const BiteCase &spec, MovingKeys *keys)
{
  std::vector<ClosedFormResult> all;
  const Strip strip = quickly_fitted_strip(fit_question(spec));
  for (std::size_t p = 0; p < spec.passes.size(); ++p) {
    const auto bite         = bite_of(strip, spec.passes[p], spec.roll_diameter, spec.steel);
    const SlabAnswer answer = solve_bite(bite, spec.bite);
    const auto add = [&](const std::string &name, const BiteSpan span, const char *unit, const double value,
                         const char *equation) {
      ClosedFormResult r = bite_result(name, span, spec.bite, int(p), keys);
      r.parameter.unit   = unit;
      r.parameter.value  = value;
      r.parameter.method = answer.method;
      r.equation         = equation;
      all.push_back(r);
    };
    const std::string &pass = spec.passes[p].name;
    add(row::bite::force.of(pass), BiteSpan::whole_width, "N", answer.state.force, "(8.8)");
    add(row::bite::torque.of(pass), BiteSpan::whole_width, "N m", answer.state.torque, "(8.19)");
    add(row::bite::forward_slip.of(pass), BiteSpan::any_part, "1", answer.state.forward_slip, "(8.7)");
    add(row::bite::peak_pressure.of(pass), BiteSpan::any_part, "Pa", answer.state.peak_pressure, "(8.4)");
    if (p > 0)
      continue;  // as in a run: the spring is that of the first pass
    add(row::bite_spring::plastic_slope.of(), BiteSpan::whole_width, "N/m", answer.stiffness.plastic_slope,
        "(8.10)");
    add(row::bite_spring::flattening.of(), BiteSpan::whole_width, "N/m", answer.stiffness.flattening, "(8.12)");
    add(row::bite_spring::combined.of(), BiteSpan::whole_width, "N/m", answer.stiffness.combined, "(8.13)");
  }
  return all;
}

}  // namespace mill
