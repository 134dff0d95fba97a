#pragma once
#include "app/kinds/pipeline.h"
#include "app/run/run_context.h"
#include "core/case/provenance.h"
#include "core/records/cluster_record.h"
#include "dynamics/cluster/stack_of_case.h"

// Stages of kind "cluster".
namespace mill {
struct Case;
struct ClosedFormResult;
struct ClusterCase;

/// What no reader can judge: rolls placed and closed, directions in which nothing is held, shapes of modes.
/// @throws InputError  each at its place
void check_cluster(const Case &the_case);

/// Rolling force of a pass: given, or by the slab theory of the case with the flow stress at the exit.
struct ClusterForce {
  double value = 0;  ///< N
  bool given   = true;
  std::string method;
  double closed = not_given;  ///< N, by the closed theory of the schedule with the same stress, for comparison
  std::string closed_method;
};
/// @throws InputError, SolverError  what the slab theory refuses
ClusterForce cluster_force(const ClusterStand &stand, const ClusterPass &pass);

/// Laws of contacts with law = "computed", by condensed slabs of their pair.
cluster::ComputedLaws computed_laws(RunContext &run, const ClusterStand &stand);

/// All of a run: equilibrium, stiffnesses, modes; response and histories with Goal::simulate; fits with
/// Goal::modes.
void solve_cluster(RunContext &run, const ClusterStand &stand, Goal goal);

/// Keys that a result of a pass follows.  @param p  the pass; @param driven  dynamic force and damping too
KeyList cluster_keys(const Case &the_case, std::size_t p, bool driven);

/// Keys that a fitted number of a variant follows.  @param p  the pass it is fitted in
KeyList cluster_fit_keys(const Case &the_case, std::size_t p, std::size_t variant);

/// Results without finite elements, for a trace.
std::vector<ClosedFormResult> closed_form_cluster(const Case &the_case);
}  // namespace mill
