#pragma once
#include "core/base/choice.h"
#include <string>
#include <vector>

namespace mill {
/// Source of K4; slab theories are compared with finite elements.
enum class BiteMethod { fe, slab };
constexpr auto words_of(BiteMethod)
{
  return choice_words<BiteMethod>("fe", "slab");
}
enum class SlabTheory {
  bland_ford,  ///< closed form, Coulomb, film or speed law, moving gap; theory.md 8.2
  hu_ehmann,   ///< closed form, friction factors, moving gap; theory.md 8.8
  karman,      ///< slab equation without Bland and Ford's simplification, integrated; theory.md 17
  orowan,      ///< inhomogeneous, integrated; theory.md 17
  sims         ///< sticking friction; theory.md 17
};
constexpr auto words_of(SlabTheory)
{
  return choice_words<SlabTheory>("bland-ford", "hu-ehmann", "karman", "orowan", "sims");
}
enum class BiteArc { automatic, rigid, hitchcock, elastic };
constexpr auto words_of(BiteArc)
{
  return choice_words<BiteArc>("auto", "rigid", "hitchcock", "elastic");
}
/// In the finite-element bite.
enum class BiteStrip { automatic, rigid_plastic, elastic_plastic };
constexpr auto words_of(BiteStrip)
{
  return choice_words<BiteStrip>("auto", "rigid-plastic", "elastic-plastic");
}
/// Measured values of a pass, in the order of their arrays.
enum class PassMeasure { force, slip, torque };
constexpr auto words_of(PassMeasure)
{
  return choice_words<PassMeasure>("force", "slip", "torque");
}

/// How the roll bite is computed.
struct BiteSetup {
  BiteMethod method    = BiteMethod::fe;
  SlabTheory theory    = SlabTheory::karman;
  BiteArc arc          = BiteArc::automatic;
  BiteStrip strip      = BiteStrip::automatic;
  int elements_along   = 48;     ///< of the arc
  int elements_through = 12;     ///< of half the thickness
  int samples          = 9;      ///< along every curve of K4
  double path_trim     = 0.2;    ///< -, share of the contact path left out at each end for the plateau
  std::vector<PassMeasure> fit;  ///< what friction and flow stress are fitted to; empty: they are those of [strip]
  std::vector<std::string> fit_for;  ///< friction | flow_stress | constants of the friction law; empty: what `fit`
                                     ///< can tell
};

/// Of the settings of a bite what its finite elements follow.  Method and theory say who else is asked, samples
/// and path_trim how the answer is shown; what a fit finds comes with the strip.
struct FlowSettings {
  BiteArc arc        = BiteArc::automatic;
  BiteStrip strip    = BiteStrip::automatic;
  int elements_along = 0, elements_through = 0;
};

inline FlowSettings flow_settings(const BiteSetup &setup)
{
  const auto &[method, theory, arc, strip, elements_along, elements_through, samples, path_trim, fit, fit_for] =
      setup;
  return {arc, strip, elements_along, elements_through};
}

template <class Io> void each_member(Io &&io, const FlowSettings &record)
{
  const auto &[arc, strip, elements_along, elements_through] = record;
  io("arc", arc);
  io("strip", strip);
  io("elements_along", elements_along);
  io("elements_through", elements_through);
}
}  // namespace mill
