#include "app/export/exchanged_stand.h"
#include "app/export/exported_stand.h"
#include "app/kinds/pipeline.h"
#include "dynamics/fmu/description.h"
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace mill {
dynamics::ExchangedStand exchanged_stand(const DrivenStand &stand, const fmu::ExportedModel &unit)
{
  const auto driven            = driven_of(stand);
  dynamics::ExchangedStand out = stand.modes
                                     ? dynamics::exchanged(*stand.modes)
                                     : dynamics::exchanged(dynamics::mill_model(stand.chain, stand.dynamics),
                                                           stand.dynamics, unit.data.gap_damper);
  out.name                     = unit.identifier;
  out.title                    = unit.title;
  out.origin                   = unit.origin;
  out.method                   = unit.method;
  out.program                  = unit.program;
  out.force_text               = fmu::force_text(unit);
  out.points                   = unit.data.points;
  if (!stand.modes)
    out.unknowns = unit.data.points;
  out.mean_force          = unit.data.mean_force;
  out.source              = unit.source;
  out.series              = unit.series;
  out.step                = unit.step;
  const double difference = dynamics::difference_from(dynamics::first_order_form(out), driven, out.frequency);
  if (!(difference <= dynamics::exchange_agreement))
    throw std::logic_error(
        fmt::format("the exported matrices differ by {:.2g} from the model of this program, {:g} "
                    "is allowed; no file was written",
                    difference, dynamics::exchange_agreement));
  dynamics::add_step_test(out, driven);
  return out;
}
}  // namespace mill
