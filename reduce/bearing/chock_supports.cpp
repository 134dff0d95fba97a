#include "reduce/bearing/chock_supports.h"
#include <cmath>

namespace mill::bearing {
namespace {
RollerBearing on_face(RollerBearing b, const double width, const double gap)
{
  b.chock_support_width = width;
  b.chock_support_gap   = gap;
  return b;
}
}  // namespace

std::string support_name(const RollerBearing &b)
{
  if (!counts_its_chock(b))
    return "cup held";
  if (b.chock == ChockForm::round)
    return "round housing";
  if (b.chock_support_gap > 0)
    return "chock on two feet";
  return b.chock_support_width < b.chock_width ? "chock on the middle of its face" : "chock on its whole face";
}

std::vector<ChockSupport> open_supports(const RollerBearing &b)
{
  std::vector<ChockSupport> out;
  if (!counts_its_chock(b) || !b.support_assumed)
    return out;
  const double width = b.chock_width;
  const auto add     = [&](const RollerBearing &other) {
    if (support_name(other) != support_name(b))
      out.push_back({support_name(other), other});
  };
  add(on_face(b, width, width * 2 / 3));
  add(on_face(b, width, not_given));
  add(on_face(b, width / 3, not_given));
  if (b.chock_assumed) {
    RollerBearing held = b;
    held.chock         = ChockForm::rigid;
    add(held);
  }
  return out;
}
}  // namespace mill::bearing
