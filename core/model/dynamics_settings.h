#pragma once
#include "core/base/choice.h"
#include "core/base/errors.h"

namespace mill {
enum class ForceMeaning { measured, disturbance, published };
constexpr auto words_of(ForceMeaning)
{
  return choice_words<ForceMeaning>("measured", "disturbance", "published");
}
enum class FrameForm { open, closed };
constexpr auto words_of(FrameForm)
{
  return choice_words<FrameForm>("open", "closed");
}
/// Springs of roll contacts and bearings.
enum class ContactSprings { linear, curve };
constexpr auto words_of(ContactSprings)
{
  return choice_words<ContactSprings>("linear", "curve");
}
/// Reference displacement of M2..M5.
enum class MassReference { mid, mean };
constexpr auto words_of(MassReference)
{
  return choice_words<MassReference>("mid", "mean");
}
/// Shapes behind M2..M5.
enum class MassSource { closed_form, fe };
constexpr auto words_of(MassSource)
{
  return choice_words<MassSource>("closed-form", "fe");
}
/// What is driven.
enum class StandModelKind { six_mass, beam, craig_bampton };
constexpr auto words_of(StandModelKind)
{
  return choice_words<StandModelKind>("six-mass", "beam", "craig-bampton");
}
/// Files of models with many unknowns.
enum class ModelFileSet { small, all };
constexpr auto words_of(ModelFileSet)
{
  return choice_words<ModelFileSet>("small", "all");
}

/// Settings of the lumped model's runs.
struct DynamicsSettings {
  double modal_damping         = 0.01;  ///< -, ratio of critical, every mode
  ForceMeaning force_meaning   = ForceMeaning::measured;
  double output_rate           = 20e3;  ///< Hz
  FrameForm frame              = FrameForm::open;
  ContactSprings contact       = ContactSprings::linear;
  MassReference mass_reference = MassReference::mid;
  MassSource mass_source       = MassSource::closed_form;
  StandModelKind model         = StandModelKind::six_mass;
  double frequency_limit       = 1000;  ///< Hz, up to which the modes are to be right
  int elements_per_radius      = 3;     ///< of the rolls' meshes behind their modes
  ModelFileSet model_files     = ModelFileSet::small;
  Place force_meaning_place;
};

/// The strip between the work rolls as a spring, or nothing.  theory.md 22.9
enum class GapState {
  rolling,  ///< K4 between the work rolls
  open      ///< K4 = 0: what a measured force drives, since it holds the answer of the strip
};

/// The state that the force of the settings drives.
inline GapState driven_state(const DynamicsSettings &settings)
{
  return settings.force_meaning == ForceMeaning::measured ? GapState::open : GapState::rolling;
}

/// The same settings for the modes of a state, whatever the force means.
inline DynamicsSettings in_state(DynamicsSettings settings, const GapState state)
{
  settings.force_meaning = state == GapState::open ? ForceMeaning::measured : ForceMeaning::disturbance;
  return settings;
}
}  // namespace mill
