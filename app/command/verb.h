#pragma once
#include "core/base/choice.h"

namespace mill {
/// First word of the command line, in the order of `millstand help`.
enum class Verb {
  new_case,
  check,
  run,
  stiffness,
  masses,
  modes,
  chatter,
  simulate,
  export_model,
  marks,
  analyse,
  calibrate,
  advise,
  live,
  studio,
  sweep,
  study,
  stack,
  trace,
  verify,
  report,
  help,
  schema,
  completion
};
constexpr auto words_of(Verb)
{
  return choice_words<Verb>("new", "check", "run", "stiffness", "masses", "modes", "chatter", "simulate", "export",
                            "marks", "analyse", "calibrate", "advise", "live", "studio", "sweep", "study", "stack",
                            "trace", "verify", "report", "help", "schema", "completion");
}
}  // namespace mill
