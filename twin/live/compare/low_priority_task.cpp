#include "twin/live/compare/low_priority_task.h"
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace mill::live {
void lower_priority()
{
  // of this thread alone: the kernel knows threads by such numbers.  Refused, it runs at the priority it has.
  [[maybe_unused]] const int refused = setpriority(PRIO_PROCESS, id_t(syscall(SYS_gettid)), 19);
}
}  // namespace mill::live
