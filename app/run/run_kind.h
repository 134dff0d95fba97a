#pragma once
#include "app/command/verb.h"
#include "app/run/driven_stand.h"
#include "app/run/run_context.h"
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// What the program does with each kind of case.  One file of app/kinds for each, and one line at the end of this
// page; what reading and describing a kind needs stands in core/case/kinds.h.
namespace mill {
struct BearingCase;
struct Case;
struct ChatterCase;
struct ClusterCase;
struct FourHigh;

struct BiteCase;
struct Lumped;
struct StackCase;
struct ClosedFormMemory;
struct ClosedFormResult;
struct StandIn;
struct TraceKey;
struct TwoCylinders;

struct CaseReview;

namespace dynamics {
struct MarkSources;
}

struct RunKind {
  std::vector<Verb> verbs;  ///< it serves, of run, stiffness, masses, modes, chatter and simulate
  /// A sentence for a verb that is refused, where "nothing to compute" does not explain enough; or
  /// empty.
  std::string (*refusal)(const Case &the_case, Verb verb) = nullptr;
  /// Checks that the reader cannot make, before anything long is computed.  @throws InputError
  void (*check)(const Case &the_case) = nullptr;
  /// What the case and its records say about each other; without it nothing.  @throws InputError  a record that
  /// cannot be read
  CaseReview (*review)(const Case &the_case, const std::string &force_file) = nullptr;
  /// Stages of a cold run with their share of the time, for the time left.
  std::vector<std::pair<std::string, double>> (*stages)(const Case &the_case) = nullptr;
  void (*run)(RunContext &run, Goal goal, const std::string &force_file)      = nullptr;
  /// What a pass drives, for export; nullptr: nothing of this kind vibrates by itself.
  DrivenStand (*driven)(RunContext &run, const std::string &pass) = nullptr;
  /// What turns in it, for marks; its modes are those of a run or of the trace.  nullptr: nothing turns.
  dynamics::MarkSources (*mark_sources)(const Case &the_case) = nullptr;
  /// Geometry, bearings and passes in run.json.
  void (*describe)(const Case &the_case, nlohmann::ordered_json &manifest) = nullptr;
  /// Files that a run reads in addition to the case, except the records of its passes.
  std::vector<std::string> (*files)(const Case &the_case) = nullptr;
  /// Every result by closed forms, for a trace.
  std::vector<ClosedFormResult> (*trace)(const Case &the_case, ClosedFormMemory &memory,
                                         const std::map<std::string, double> &factors) = nullptr;
  /// What a trace takes for a key that is not given.
  /// @param closed  results of the case
  std::optional<StandIn> (*stand_in)(const Case &the_case, const TraceKey &key,
                                     const std::vector<ClosedFormResult> &closed) = nullptr;
};

const RunKind &run_kind(const Case &the_case);

const RunKind &run_kind(const FourHigh &);
const RunKind &run_kind(const Lumped &);
const RunKind &run_kind(const TwoCylinders &);
const RunKind &run_kind(const BearingCase &);
const RunKind &run_kind(const BiteCase &);
const RunKind &run_kind(const StackCase &);
/// Of what the program is linked with; require_linked() comes first.
const RunKind &run_kind(const ChatterCase &);
const RunKind &run_kind(const ClusterCase &);

/// What the former two return where it is linked.
const RunKind &chatter_kind();
const RunKind &cluster_kind();
}  // namespace mill
