#pragma once
#include "dynamics/cluster/stack.h"

// Free vibration of one mode at finite amplitude by harmonic balance.  theory.md 38.6
namespace mill::cluster {
struct BackbonePoint {
  double amplitude      = 0;  ///< m, first harmonic of the unknown that moves most
  double frequency      = 0;  ///< Hz
  double mean_shift     = 0;  ///< m, of the same unknown
  double second         = 0;  ///< -, its second harmonic over the first
  double highest        = 0;  ///< m, of the same unknown from rest, at one turning point
  double lowest         = 0;  ///< m, at the other
  double least_approach = 0;  ///< m, smallest of all contacts over a period; negative: one lets go
  std::string lets_go;        ///< that contact; empty: none
};

struct BackboneOptions {
  int harmonics = 9;
  int samples   = 64;  ///< of half a period
};

/// Frequency over amplitude, without damping.  Loads and anchors as at rest.
/// @param u           state at rest
/// @param mode        index in modes()
/// @param amplitudes  m, rising
/// @return  as many points as were found; shorter than `amplitudes` where the balance has no solution
/// Cost: some five dense factorisations of (harmonics + 1) n unknowns a point.
std::vector<BackbonePoint> backbone(const Stack &stack, const Motion &u, int mode,
                                    const std::vector<double> &amplitudes, const BackboneOptions &options = {});
}  // namespace mill::cluster
