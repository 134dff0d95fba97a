#include "app/verbs/leading_model.h"
#include "core/base/errors.h"
#include "core/model/case.h"

namespace mill {
std::optional<StandModelKind> leading_model(const Case &the_case, const CommandLine &command)
{
  const auto *stand = std::get_if<FourHigh>(&the_case.spec);
  if (!stand) {
    if (!command.model.empty())
      throw InputError("--model " + command.model + ": kind = \"" + the_case.kind + "\" (" + the_case.path +
                       ") has one model; leave the option out, or name a case of kind four-high");
    return std::nullopt;
  }
  if (!command.model.empty())
    return choice_named<StandModelKind>(command.model);
  return the_case.places.count("dynamics.model") > 0 ? stand->dynamics.model : StandModelKind::craig_bampton;
}

Case with_leading_model(Case the_case, const CommandLine &command)
{
  if (const auto model = leading_model(the_case, command))
    std::get<FourHigh>(the_case.spec).dynamics.model = *model;
  return the_case;
}
}  // namespace mill
