#include "app/review/closed_form_modes.h"
#include "app/trace/closed_form_chain.h"
#include "core/model/four_high.h"

namespace mill {
std::vector<ClosedFormResult> closed_form_stand(FourHigh stand, const double load)
{
  stand.passes.resize(1);
  Pass &pass           = stand.passes.front();
  pass.load            = load;
  pass.force_file      = "";
  pass.synthetic_range = {not_given, not_given};
  ClosedFormMemory memory;
  return closed_form_four_high(stand, memory, {});
}
}  // namespace mill
