#include "app/review/quick_modes.h"
#include "app/trace/quick_chain.h"
#include "core/model/four_high.h"

namespace mill {
std::vector<QuickResult> quick_stand(FourHigh stand, const double load)
{
  stand.passes.resize(1);
  Pass &pass           = stand.passes.front();
  pass.load            = load;
  pass.force_file      = "";
  pass.synthetic_range = {not_given, not_given};
  QuickMemory memory;
  return quick_four_high(stand, memory, {});
}
}  // namespace mill
