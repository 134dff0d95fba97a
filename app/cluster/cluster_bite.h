#pragma once
#include "app/cluster/cluster_stage.h"
#include "reduce/bite/bite.h"

// The roll bite of a pass of a cluster, and the spring that it is between the work rolls.
namespace mill {
/// The bite of a pass under its rolling force, with one mean flow stress.
struct RolledBite {
  bite::RollBite bite;
  std::string stress;     ///< where that comes from: "802 MPa, fitted to the load of the pass"
  double K4 = not_given;  ///< N/m, combined: plastic slope in series with both rolls
};

/// The bite whose force is that of the pass: a load that is given fits the flow stress, else the law of the case
/// gives it at the exit.  Bland and Ford's theory on Hitchcock's arc, Hu and Ehmann's with friction factors.
/// @throws InputError, SolverError  what the theory refuses
std::optional<RolledBite> rolled_bite(const ClusterStand &stand, const ClusterPass &pass,
                                      const ClusterForce &force);

/// Keys that the bite of pass p needs and the case does not give, "pass.0.entry_thickness, strip.friction"; empty:
/// all are there.
std::string missing_of_bite(const ClusterStand &stand, std::size_t p);

/// The same for a search of the critical speed, which also needs the speed of the rolls and both tensions.
std::string missing_of_chatter(const ClusterStand &stand, std::size_t p);

/// N/m, K4 of a pass: stack.strip_stiffness, else that of its bite; NaN: neither is known.
double strip_spring(const ClusterStand &stand, const ClusterPass &pass, const ClusterForce &force);

/// The stand with that spring between its work rolls, where it has both and K4 is known.
ClusterStand rolled_stand(const ClusterStand &stand, const ClusterPass &pass, const ClusterForce &force);

/// Refuses a strip contact that carries nothing.
/// @throws InputError  at its place, with the remedy
void check_strip_contact(const Case &the_case, const ClusterStand &stand);
}  // namespace mill
