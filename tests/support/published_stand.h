#pragma once
#include "core/model/dynamics_settings.h"
#include "core/model/lumped_model.h"
#include "core/records/records.h"
#include <string>

/// The published masses and stiffnesses; C and Kzc are not set.
mill::LumpedModel published_stand();

/// Open frame, given meaning of the force and modal damping ratio.
mill::DynamicsSettings settings(mill::ForceMeaning force_meaning, double modal_damping);

/// One of the parameter sets P1..R3 of the reference file: its model, and its settings.
struct ParameterSet {
  mill::LumpedModel stand;
  mill::DynamicsSettings dynamics;
};
ParameterSet parameter_set(const std::string &name);

/// The force of entry "regression.force": twelve sines about the mid value of pass 1.
mill::ForceRecord twelve_tones();
