#include "app/run/run_kind.h"
#include "app/command/linked_subjects.h"
#include "core/model/case.h"

namespace mill {
const RunKind &run_kind(const Case &the_case)
{
  return std::visit([](const auto &spec) -> const RunKind & { return run_kind(spec); }, the_case.spec);
}

const RunKind &run_kind(const ChatterCase &)
{
  return linked_subjects.chatter();
}

const RunKind &run_kind(const ClusterCase &)
{
  return linked_subjects.cluster();
}
}  // namespace mill
