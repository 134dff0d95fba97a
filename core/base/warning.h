#pragma once
#include "core/base/each_member.h"
#include "core/base/errors.h"
#include <string>
#include <vector>

namespace mill {
/// Everything that a run may warn of; warning_rows() has a row for each, in this order.
enum class WarningId {
  text_only,
  // the case and its records
  value_doubtful,
  template_values,
  old_key,
  force_not_positive,
  record_gap,
  record_short,
  record_repaired,
  measured_record_coarse,
  load_off_record,
  pass_without_record,
  force_band,
  force_above_limit,
  output_rate,
  // chain, models, response
  given_in_chain_only,
  modulus_unusual,
  six_mass_gap_mode,
  mode_not_in_chain,
  one_damping_ratio,
  curve_slope,
  given_off_curve,
  curve_left,
  springs_not_linear,
  time_integration,
  marks_incomplete,
  // roll bite
  bite_force,
  bite_angle,
  bite_sticking,
  bite_flattening,
  bite_slip,
  bite_suction,
  bite_strip_model,
  bite_stress_mean,
  bite_foil,
  bite_model_refused,
  bite_arc_error,
  fit_refused,
  fit_one_number,
  fit_scatter,
  fit_at_edge,
  fit_interval_open,
  fit_by_slab,
  // contact of rolls
  contact_partly_open,
  contact_yield,
  contact_mesh,
  contact_bending,
  contact_held,
  half_space_limit,
  sharp_end,
  contact_law,
  // bearings
  bearing_arrangement,
  bearing_curve_ends,
  bearing_few_rollers,
  bearing_yield,
  bearing_far_row,
  bearing_pressure_map,
  oil_film_hot,
  // chatter
  critical_speed_not_searched,
  chatter_refused,
  no_steady_bite,
  chatters,
  growing_histories,
  slack_strip,
  oil_film_range,
  map_has_gaps,
  // roll stacks and contact stacks
  stack_engines,
  strip_at_barrel_end,
  support_preload,
  coupled_stack,
  history_stopped,
  variant_fit,
  // the program
  solver_failed,
  reference_blas,
  not_kept
};

/// A fact that the reader of a result needs to know.  What shows it picks its parts; text_of() joins them.
struct Warning {
  WarningId id = WarningId::text_only;
  std::string subject{};                ///< "pass 1", "bearing work"; empty: the stand, or the fact names it
  std::string fact{};                   ///< what is so: short, without full stop; the first screen shows it
  std::string detail{};                 ///< what follows from it; may be empty
  std::string remedy{};                 ///< what to change or to give; may be empty
  std::vector<std::string> concerns{};  ///< names of results, "K3", or their first part, "bite.pass 1"
  std::string key{};                    ///< of the case, "bearing.work.arrangement"; empty: no single one
  Place place{};                        ///< in a file; line 0: not known
  std::vector<Place> related{};         ///< the other places of a contradiction
};

/// Whatever the program says about an id is said here, once; docs/output.md prints it.
struct WarningRow {
  WarningId id;
  const char *word;     ///< "bearing-arrangement": in results.json, never changed
  const char *meaning;  ///< one sentence without full stop
};
const std::vector<WarningRow> &warning_rows();

const char *id_of(WarningId id);
/// @return text_only for a word that no row has: of a later version
WarningId warning_named(const std::string &word);

/// "bearing work: arrangement is not given: face-to-face is assumed; give bearing.work.arrangement"
std::string text_of(const Warning &warning);
std::vector<std::string> texts_of(const std::vector<Warning> &warnings);
/// A remark as `check` prints it, with place and related places.
Problem problem_of(const Warning &warning);
/// The whole of it where only a text was kept, in a run of an earlier version.
Warning warning_of_text(const std::string &text);

/// The same words, whatever the place.
bool operator==(const Warning &a, const Warning &b);

template <class Io, class R, if_record<R, Place> = 0> void each_member(Io &&io, R &record)
{
  auto &[file, line, column] = record;
  io("file", file);
  io("line", line);
  io("column", column);
}

template <class Io, class R, if_record<R, Warning> = 0> void each_member(Io &&io, R &record)
{
  auto &[id, subject, fact, detail, remedy, concerns, key, place, related] = record;
  std::string word                                                         = id_of(id);
  io("id", word);
  if constexpr (!std::is_const_v<R>)
    id = warning_named(word);
  io("subject", subject);
  io("fact", fact);
  io("detail", detail);
  io("remedy", remedy);
  io("concerns", concerns);
  io("key", key);
  io("place", place);
  io("related", related);
}
}  // namespace mill
