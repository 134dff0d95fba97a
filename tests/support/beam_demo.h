#pragma once
#include "reduce/stand/beam_stand.h"
#include "reduce/stand/stand_modes.h"
#include "tests/manual/stand/demo_drawing.h"

/// The demo stand as a model of beams, for tests of what is made from it.
inline mill::FourHigh demo_drawing()
{
  return mill::verify::demo_stand();
}

inline mill::reduce::LumpedStand demo_chain(const mill::FourHigh &stand, const double K4 = 0)
{
  const auto spring = [](const double value) {
    mill::Parameter p;
    p.value = value;
    p.unit  = "N/m";
    return p;
  };
  mill::reduce::ChainInputs in;
  in.K3 = in.K5 = spring(4.02e10);
  in.K4         = spring(K4);
  in.K_Zy_upper = in.K_Zy_lower = spring(1.023e11);
  in.Kzc                        = {spring(5.1e10), spring(1.9e10), spring(1.9e10), spring(5.1e10)};
  in.at                         = "976.2 kN";
  return mill::reduce::lumped_stand(stand, in);
}

inline mill::reduce::StandSprings demo_springs(const mill::FourHigh &stand)
{
  return mill::reduce::stand_springs(stand, demo_chain(stand));
}

inline mill::StandModel demo_beams(const mill::FourHigh &stand, const int elements = 8)
{
  return mill::reduce::beam_stand(stand, demo_springs(stand), elements);
}

inline const mill::StandPoint &point_of(const mill::StandModel &stand, const std::string &name)
{
  for (const mill::StandPoint &point : stand.points)
    if (point.name == name)
      return point;
  throw mill::InputError("no point " + name);
}
