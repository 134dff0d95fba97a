#include "core/case/turning_keys.h"
#include <fmt/format.h>
#include <utility>

namespace mill {
KeyList frequency_response_keys()
{
  return joined(keys_in("dynamics", "modal_damping force_meaning"),
                keys_in("frequency_response", "range resolution"));
}

KeyList campbell_keys(const std::size_t orders)
{
  KeyList keys = keys_in("campbell", "speeds working_speeds roll_orders bearing_harmonics");
  for (std::size_t i = 0; i < orders; ++i)
    keys = joined(std::move(keys), keys_in(fmt::format("drive.order.{}", i), "per_turn_of count"));
  return keys;
}
}  // namespace mill
