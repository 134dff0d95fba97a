#pragma once
#include "core/model/pass.h"
#include <array>
#include <cmath>
#include <string>

namespace mill {
/// What the working load of a pass is made from: its own number, or the record whose mean it is.
struct LoadInputs {
  double load = not_given;                               ///< N
  std::string force_file;                                ///< of a recorded force
  std::array<double, 2> range = {not_given, not_given};  ///< N, of a made one
  double duration = 0, bandwidth = 0;                    ///< s, Hz
  int seed = 0;
};

template <class Io> void each_member(Io &&io, const LoadInputs &record)
{
  const auto &[load, force_file, range, duration, bandwidth, seed] = record;
  io("load", load);
  io("force_file", force_file);
  io("range", range);
  io("duration", duration);
  io("bandwidth", bandwidth);
  io("seed", seed);
}

/// The force over time alone.
inline LoadInputs inputs_of_force(const Pass &pass)
{
  LoadInputs inputs;
  inputs.force_file = pass.force_file;
  if (!pass.force_file.empty())
    return inputs;
  inputs.range     = pass.synthetic_range;
  inputs.duration  = pass.synthetic_duration;
  inputs.bandwidth = pass.synthetic_bandwidth;
  inputs.seed      = pass.synthetic_seed;
  return inputs;
}

inline LoadInputs inputs_of_load(const Pass &pass)
{
  LoadInputs inputs;
  if (std::isnan(pass.load))
    return inputs_of_force(pass);
  inputs.load = pass.load;
  return inputs;
}
}  // namespace mill
