#include "fem/dealii/dealii_bodies.h"
#include <deal.II/base/multithread_info.h>

namespace mill::fem {
void dealii_use_threads(const int n)
{
  dealii::MultithreadInfo::set_thread_limit(unsigned(n));
}
}  // namespace mill::fem
