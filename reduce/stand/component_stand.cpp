#include "reduce/stand/component_stand.h"

namespace mill::reduce {
StandModel component_stand(const FourHigh &stand, const StandSprings &springs, const StandComponents &components)
{
  const Component &work = components.work_roll, &backup = components.backup_roll;
  return assemble_stand("craig-bampton", stand, springs,
                        {component_roll("upper backup roll", backup), component_roll("upper work roll", work),
                         component_roll("lower work roll", work), component_roll("lower backup roll", backup)},
                        components.housing ? &*components.housing : nullptr);
}
}  // namespace mill::reduce
