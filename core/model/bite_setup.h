#pragma once
#include <string>
#include <vector>

namespace mill {
/// How the roll bite is computed.
struct BiteSetup {
  std::string method   = "fe";       ///< fe | slab: source of K4; slab theories are compared with finite elements
  std::string theory   = "karman";   ///< bland-ford | hu-ehmann | karman | orowan | sims
  std::string arc      = "auto";     ///< auto | rigid | hitchcock | elastic
  std::string strip    = "auto";     ///< auto | rigid-plastic | elastic-plastic, in the finite-element bite
  int elements_along   = 48;         ///< of the arc
  int elements_through = 12;         ///< of half the thickness
  int samples          = 9;          ///< along every curve of K4
  double path_trim     = 0.2;        ///< -, share of the contact path left out at each end for the plateau
  std::vector<std::string> fit;      ///< force | slip | torque: measured values that friction and flow stress are
                                     ///< fitted to; empty: they are those of [strip]
  std::vector<std::string> fit_for;  ///< friction | flow_stress | constants of the friction law; empty: what `fit`
                                     ///< can tell
};

/// Of the settings of a bite what its finite elements follow.  Method and theory say who else is asked, samples
/// and path_trim how the answer is shown; what a fit finds comes with the strip.
struct FlowSettings {
  std::string arc, strip;
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
