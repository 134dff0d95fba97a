#include "core/base/warning.h"
#include <algorithm>
#include <stdexcept>

namespace mill {
namespace {
void append(std::string &text, const std::string &more, const char *mark)
{
  if (!more.empty())
    text += (text.empty() ? "" : mark) + more;
}
}  // namespace

const std::vector<WarningRow> &warning_rows()
{
  using Id = WarningId;
  static const std::vector<WarningRow> rows{
      {Id::text_only, "text-only", "a warning of a run by an earlier version, which kept the text alone"},
      {Id::value_doubtful, "value-doubtful", "a value is possible, but unusual next to another one of the case"},
      {Id::template_values, "template-values", "values are still those of the template"},
      {Id::old_key, "old-key", "a key has its old name"},
      {Id::force_not_positive, "force-not-positive", "the mean of a force record is not positive"},
      {Id::record_gap, "record-gap", "samples of a record are missing"},
      {Id::record_short, "record-short", "a force record is too short for the lowest mode"},
      {Id::record_repaired, "record-repaired", "what the reader did to understand a record"},
      {Id::measured_record_coarse, "measured-record-coarse",
       "a measured record is sampled too slowly for the highest mode"},
      {Id::load_off_record, "load-off-record", "load of the pass and mean of its force record differ"},
      {Id::pass_without_record, "pass-without-record", "nothing was simulated: the pass has no force record"},
      {Id::force_band, "force-band", "the force record ends below the highest mode"},
      {Id::force_above_limit, "force-above-limit", "the force reaches beyond dynamics.frequency_limit"},
      {Id::output_rate, "output-rate", "too few points on a period of the highest mode"},
      {Id::given_in_chain_only, "given-in-chain-only", "a given value replaces a number of the six masses only"},
      {Id::modulus_unusual, "modulus-unusual", "the mill modulus is outside the usual range"},
      {Id::six_mass_gap_mode, "six-mass-gap-mode", "six masses put a gap mode at another frequency"},
      {Id::mode_not_in_chain, "mode-not-in-chain", "the force excites modes that six masses do not have"},
      {Id::one_damping_ratio, "one-damping-ratio", "an exported stand has one damping ratio for all modes"},
      {Id::curve_slope, "curve-slope", "a stiffness differs from the slope of its curve at the load"},
      {Id::given_off_curve, "given-off-curve", "a given stiffness differs from the slope of the given curve"},
      {Id::curve_left, "curve-left", "a force leaves the samples of the curve of its contact or bearing"},
      {Id::springs_not_linear, "springs-not-linear", "linear springs were not enough at this load"},
      {Id::time_integration, "time-integration", "the response was integrated in another way than by modes"},
      {Id::marks_incomplete, "marks-incomplete", "a part of the comparison of marks could not be determined"},
      {Id::bite_force, "bite-force", "flow stress and friction give another force than the pass has"},
      {Id::bite_angle, "bite-angle", "the strip has to be pushed in at its head"},
      {Id::bite_sticking, "bite-sticking", "the strip would stick, which the friction law does not know"},
      {Id::bite_flattening, "bite-flattening", "the rolls flatten beyond what Hitchcock's circular arc holds for"},
      {Id::bite_slip, "bite-slip", "the slip between strip and roll has no neutral point, or several"},
      {Id::bite_suction, "bite-suction", "roll and strip pull at each other in the finite-element bite"},
      {Id::bite_strip_model, "bite-strip-model", "the rigid-plastic strip is a poor model for an elastic roll"},
      {Id::bite_stress_mean, "bite-stress-mean", "a theory takes one flow stress, the mean over the arc"},
      {Id::bite_foil, "bite-foil", "strip so thin that strip and roll stick"},
      {Id::bite_model_refused, "bite-model-refused", "a model of the bite has no answer; which other one is used"},
      {Id::bite_arc_error, "bite-arc-error", "what the error estimate says of the arc that is not a circle"},
      {Id::fit_refused, "fit-refused", "flow stress or law could not be fitted"},
      {Id::fit_one_number, "fit-one-number", "the measured values give fewer numbers than were asked for"},
      {Id::fit_scatter, "fit-scatter", "the measured values do not fit together"},
      {Id::fit_at_edge, "fit-at-edge", "the best fit lies where the rolls no longer take the pass"},
      {Id::fit_interval_open, "fit-interval-open", "the measured values do not bound a fitted number"},
      {Id::fit_by_slab, "fit-by-slab", "the fit is that of Karman's slab, not of the model of the run"},
      {Id::contact_partly_open, "contact-partly-open", "rolls do not touch over their whole length"},
      {Id::contact_yield, "contact-yield", "a contact pressure is beyond what elastic steel carries"},
      {Id::contact_mesh, "contact-mesh", "the contact is narrow for the elements at the working load"},
      {Id::contact_bending, "contact-bending", "the bending forces exceed the load of the contact"},
      {Id::contact_held, "contact-held", "held as in the stand the rolls have another stiffness"},
      {Id::half_space_limit, "half-space-limit", "the contact is wide for its bodies; half spaces are off"},
      {Id::sharp_end, "sharp-end", "the pressure grows without limit at a sharp end of a face"},
      {Id::contact_law, "contact-law", "the law of a line contact misses the computed samples"},
      {Id::bearing_arrangement, "bearing-arrangement", "the arrangement of the rows is assumed"},
      {Id::bearing_curve_ends, "bearing-curve-ends", "the load curve of a bearing ends before its largest load"},
      {Id::bearing_few_rollers, "bearing-few-rollers",
       "so few rollers carry that the position of the cage matters"},
      {Id::bearing_yield, "bearing-yield", "a raceway is pressed beyond its elastic limit"},
      {Id::bearing_far_row, "bearing-far-row", "the tilt loads a row on its far side"},
      {Id::bearing_pressure_map, "bearing-pressure-map", "the heaviest roller is beyond the mesh of its contact"},
      {Id::oil_film_hot, "oil-film-hot", "the oil film is above 90 degC"},
      {Id::critical_speed_not_searched, "critical-speed-not-searched", "why a critical speed is missing"},
      {Id::chatter_refused, "chatter-refused", "a rolling condition has no answer"},
      {Id::no_steady_bite, "no-steady-bite", "no steady bite exists at the working speed"},
      {Id::chatters, "chatters", "vibration grows at the working speed"},
      {Id::growing_histories, "growing-histories", "the disturbance of the histories is large for the draft"},
      {Id::slack_strip, "slack-strip", "a strip without tension goes slack, which the linear model does not know"},
      {Id::oil_film_range, "oil-film-range", "the oil film is outside the range of the friction law"},
      {Id::map_has_gaps, "map-has-gaps", "points of a stability map have no steady bite"},
      {Id::stack_engines, "stack-engines", "the two engines of a roll stack differ"},
      {Id::strip_at_barrel_end, "strip-at-barrel-end", "the edge of the strip is close to the end of a barrel"},
      {Id::support_preload, "support-preload", "a support has lost its preload"},
      {Id::coupled_stack, "coupled-stack", "a coupled stack has no history"},
      {Id::history_stopped, "history-stopped", "a history ended early: contacts open and close too often"},
      {Id::variant_fit, "variant-fit", "a variant has no fit, or not a whole one"},
      {Id::solver_failed, "solver-failed", "the run ended with a numerical failure"},
      {Id::reference_blas, "reference-blas", "the slow BLAS is in use"},
      {Id::not_kept, "not-kept", "a part could not be kept for the next run"},
  };
  return rows;
}

const char *id_of(const WarningId id)
{
  const auto &rows = warning_rows();
  const auto i     = std::size_t(id);
  if (i >= rows.size() || rows[i].id != id)
    throw std::logic_error("the rows of the warnings are not in the order of their ids");
  return rows[i].word;
}

WarningId warning_named(const std::string &word)
{
  const auto &rows = warning_rows();
  const auto match = std::find_if(rows.begin(), rows.end(), [&](const WarningRow &r) { return word == r.word; });
  return match == rows.end() ? WarningId::text_only : match->id;
}

std::string text_of(const Warning &warning)
{
  std::string text = warning.subject;
  append(text, warning.fact, ": ");
  append(text, warning.detail, ": ");
  append(text, warning.remedy, "; ");
  return text;
}

std::vector<std::string> texts_of(const std::vector<Warning> &warnings)
{
  std::vector<std::string> texts;
  for (const Warning &warning : warnings)
    texts.push_back(text_of(warning));
  return texts;
}

Problem problem_of(const Warning &warning)
{
  return {warning.place, text_of(warning), warning.related};
}

Warning warning_of_text(const std::string &text)
{
  Warning warning;
  warning.fact = text;
  return warning;
}

bool operator==(const Warning &a, const Warning &b)
{
  return a.id == b.id && text_of(a) == text_of(b);
}
}  // namespace mill
