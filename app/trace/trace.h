#pragma once
#include "app/trace/closed_form_chain.h"
#include "app/trace/trace_key.h"
#include <string>
#include <utility>
#include <vector>

namespace mill {
/// What `millstand trace` was asked for.
struct TraceOptions {
  std::string case_file;
  std::string key;
  std::vector<std::string> sets;  ///< --set
  std::string folder;             ///< of the last run; empty: out/<case name>
  bool from_run = false;  ///< --full: springs as the last run stored them, closed forms only for their change
};

/// How far one result follows the key.
struct TraceLine {
  ClosedFormResult result;
  std::vector<std::string> through;  ///< of the results it is made of those that the key reaches
  bool direct     = true;            ///< the key also enters without them
  bool moves      = true;            ///< false: only finite elements follow this key
  double slope    = not_given;       ///< percent per percent; percent per unit of a key whose value is zero
  double slope_up = not_given, slope_down = not_given;  ///< the same to each side
  std::vector<std::pair<std::string, double>> words;    ///< percent, with another word instead
};

/// Percent per percent of the key, not per unit of it.
constexpr bool is_relative(const std::string_view per)
{
  return per == "%";
}

/// Which results one input reaches.  theory.md 24
struct Trace {
  TraceKey key;
  std::string per;               ///< "%": percent per percent; "um": percent per um; "": no elasticity
  std::string steps;             ///< "1435.5 mm .. 1464.5 mm": between which values the differences were taken
  std::string reason;            ///< why there is no elasticity
  std::vector<TraceLine> lines;  ///< in the order of the relations
  std::vector<std::string> only_in_a_run;  ///< without a line: results that only a run has and that state this key
  std::vector<ClosedFormResult> base;      ///< every result of the case
  std::string run_folder;                  ///< the last stored run; empty: none
  bool same_inputs = true;                 ///< it was made from this very case
  bool from_run    = false;
  std::vector<std::pair<std::string, double>> run;  ///< its values by name, of the results above
};

/// Traces one input through the closed-form model: two more evaluations with the key changed by a hundredth (a
/// count by one, a zero by a hundredth of its unit) in the way of --set, so with the same checks.  Where a check
/// refuses a hundredth a smaller step is taken, or one side only.
/// @throws InputError   unknown key, with the nearest known one; errors of the case; --full without a run
/// @throws SolverError  as closed_form_chain
/// Cost: three evaluations of the chain, 0.3 s with two passes of 10 s.
Trace trace(const TraceOptions &options);
/// The same for many keys of files that do not change: forces, responses, bearings and whole chains are kept in
/// between.
Trace trace(const TraceOptions &options, ClosedFormMemory &memory);
}  // namespace mill
