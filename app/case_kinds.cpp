#include "app/case_kinds.h"
#include "core/model/case.h"

namespace mill {
const RunKind &run_kind(const Case &the_case)
{
  return std::visit([](const auto &spec) -> const RunKind & { return run_kind(spec); }, the_case.spec);
}
}  // namespace mill
