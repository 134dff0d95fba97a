#include "core/numerics/eigen_instances.h"

#ifdef MILL_EIGEN_INSTANCES
namespace Eigen::internal {
MILL_PRODUCT_INSTANCES(template)
}
#endif
