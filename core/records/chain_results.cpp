#include "core/records/chain_results.h"
#include "core/records/chain_number.h"
#include "core/records/rows_of_bearing.h"
#include "core/records/rows_of_bite.h"
#include "core/records/rows_of_contact.h"

namespace mill {
std::optional<ResultName> solved_result_of(const std::string_view number)
{
  if (is_roll_contact(number))
    return row::roll_contact::tangent.of("", number);
  if (is_bearing(number))
    return row::bearing::tangent.of(number);
  if (choice_named<ChainNumber>(number) == ChainNumber::K4)
    return row::bite_spring::combined.of();
  return std::nullopt;
}
}  // namespace mill
