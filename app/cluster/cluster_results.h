#pragma once
#include "app/cluster/cluster_stage.h"
#include "dynamics/cluster/fit.h"
#include "dynamics/cluster/motion.h"

// Results, record and curves of one pass of a cluster.
namespace mill {
/// One pass on its way through a run.
struct ClusterPassRun {
  std::size_t p = 0;
  const ClusterPass *pass;
  ClusterForce force;
  cluster::PassState state;
  KeyList keys;         ///< behind the state
  KeyList driven_keys;  ///< behind what its dynamic force makes
};

ClusterPassRecord pass_record(const ClusterStand &stand, const ClusterPassRun &run);
void add_state_results(RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass);
void add_mode_results(RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass);

/// Buckling and loss of a contact: into record and results.
void add_stability(RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass,
                   ClusterPassRecord &record);

/// The dynamic force of a pass, where the rolling force acts: one number for each unknown of the stack, N.
Eigen::VectorXd cluster_dynamic_load(const cluster::Stack &stack, double rolling_force, double amplitude);

/// Response over frequency, and the history under the dynamic force, where the pass has one.
void add_vibration(RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass,
                   ClusterPassRecord &record);

ClusterFitRecord fit_record(const ClusterStand &stand, const ClusterVariant &variant,
                            const cluster::StackFit &fit);
void add_fit_results(RunContext &run, const cluster::StackFit &fit, const KeyList &keys);
}  // namespace mill
