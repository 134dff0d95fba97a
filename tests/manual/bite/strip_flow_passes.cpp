#include "tests/manual/bite/strip_flow_passes.h"
#include "meshes/strip/strip_flow.h"

namespace mill::verify {
fem::StripFlow rolled(const bite::RollBite &bite, const int along, const fem::StripFlowModel &model,
                      const double finest, const bite::ArcFlexibility *flexibility, const fem::StripFlow *start)
{
  meshes::StripBlock block = meshes::strip_block(bite.strip, bite.roll_radius, along, along / 4);
  block.finest             = finest;
  return fem::solve_strip_flow(meshes::strip_lines(block), bite, model, flexibility, start);
}
}  // namespace mill::verify
