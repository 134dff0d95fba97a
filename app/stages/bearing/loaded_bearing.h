#pragma once
#include "app/stages/bearing/bearing_study.h"
#include "core/records/results.h"
#include <memory>
#include <string>

namespace mill {
struct Case;

/// What a bearing is asked for.
struct BearingLoading {
  double radial = 0;  ///< N, towards the support of the chock
  double axial  = 0;  ///< N, on the inner ring
  double tilt   = 0;  ///< rad, of the inner ring in the plane of the load
};

/// A solved bearing.
struct LoadedState {
  bearing::AssemblyState at;
  Results results;  ///< as of kind = "bearing": Kzc.*, bearing.NAME.*
  std::string name;
};

/// A roller bearing of a case for any load: its roller, rings and chock are meshed with the first load, and once
/// more where a larger one wants it.
class LoadedBearing {
public:
  /// @param which  name of a [bearing.*], or "backup" or "work": that of these rolls of a stand
  /// @throws InputError  no such bearing; an oil film
  LoadedBearing(std::shared_ptr<const Case> of, const std::string &which, std::string cache, int threads);

  /// @throws InputError   a fit beyond yield, a load that is not finite
  /// @throws SolverError  no equilibrium
  /// Cost: some 0.1 s; elements of rollers and rings some seconds, once.
  LoadedState solve(const BearingLoading &load, const Progress &progress) const;

  const RollerBearing &bearing() const;

private:
  std::shared_ptr<const Case> the_case;
  RollerBearing drawn;
  std::string cache;
  int threads;
};
}  // namespace mill
