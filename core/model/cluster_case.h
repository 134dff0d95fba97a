#pragma once
#include <memory>

namespace mill {
struct ClusterStand;

/// kind = "cluster": rolls that lean on each other in a plane.  What it holds stands in core/model/cluster.h,
/// behind a pointer, so that a new key of a cluster is compiled by those who read it.
struct ClusterCase {
  std::shared_ptr<const ClusterStand> stand;  ///< never null in a case that was read
};
}  // namespace mill
