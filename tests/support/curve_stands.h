#pragma once
#include "dynamics/nonlinear/curve_model.h"
#include "dynamics/response/modal_model.h"
#include <vector>

/// Samples of F = c d^power at n loads from `low` to `high` (N).
mill::dynamics::SpringLaw power_law(double c, double power, double low, double high, int n);

/// Two free masses (kg) pressed together by a force (N) through one contact; modes: both together, and against
/// each other.
mill::dynamics::CurveStand two_masses(double upper, double lower, const mill::dynamics::SpringLaw &contact,
                                      double load);

/// A chain of six masses whose contacts K3 and K5 follow line contacts and whose K2 and K6 follow bearings.
struct ChainOnCurves {
  mill::StandModel model;
  mill::dynamics::ModalModel modal;
  mill::dynamics::CurveStand stand;
};
ChainOnCurves chain_on_curves(double load, double damping, double gap_damper = 0);
