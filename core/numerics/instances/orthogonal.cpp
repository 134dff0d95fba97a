#include "core/numerics/eigen_instances.h"

#ifdef MILL_EIGEN_INSTANCES
namespace Eigen {
MILL_REFLECTION_INSTANCES(template)
MILL_ORTHOGONAL_INSTANCES(template)
}  // namespace Eigen
#endif
