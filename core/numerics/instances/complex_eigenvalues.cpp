#include "core/numerics/eigen_instances.h"

#ifdef MILL_EIGEN_INSTANCES
namespace Eigen {
MILL_COMPLEX_INSTANCES(template)
}
#endif
