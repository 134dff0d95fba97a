#include "app/stages/contact/half_plane_stage.h"
#include "app/run/curve_files.h"
#include "core/case/contact_inputs.h"
#include "core/records/rows_of_contact.h"
#include "fem/contact/half_plane_numbers.h"
#include <cmath>
#include <string>

namespace mill {
namespace {
void add_slip(RunContext &run, const TwoCylinders &pair, const contact::LineSlip &s)
{
  const auto add = [&](const RowOf<0> &row, double contact::SlipValues::*member, const std::string &form) {
    Parameter p;
    p.value  = s.value.*member;
    p.unit   = row.unit;
    p.method = "half planes with stick and slip (sec. 33.4), displacements with the datum of the normal approach";
    p.at     = {"{}, {} across", {{pair.contact.at, "N/mm"}, {pair.contact.tangential_load, "N/mm"}}};
    p.error_estimate = s.error.*member;
    p.inputs         = cylinder_keys(*run.keys, BodyReading::slip);
    p.checks         = {{form, s.closed.*member, s.coupled ? "equal materials: pressure and shear apart" : ""},
                        {"strips twice as wide", s.coarse.*member, ""}};
    run.results.add(row.of(), p);
  };
  add(row::line::stick_half_width, &contact::SlipValues::stick, "Cattaneo (33.5)");
  add(row::line::tangential_displacement, &contact::SlipValues::displacement, "Cattaneo (33.10)");
  add(row::line::tangential_stiffness, &contact::SlipValues::first_stiffness, "no slip (33.10)");
  add(row::line::tangential_tangent, &contact::SlipValues::tangent, "Cattaneo (33.10)");
}
}  // namespace

void solve_over_width(RunContext &run, const TwoCylinders &pair)
{
  const auto write = [&](const contact::LineWidth &width) {
    Table table;
    table.add("x", "m", width.x).add("pressure", "Pa", width.pressure);
    if (width.shear.size() > 0)
      table.add("shear", "Pa", width.shear).add("friction_limit", "Pa", pair.contact.friction * width.pressure);
    write_curve(run, curve::contact_width, "line", table);
  };
  if (std::isnan(pair.contact.tangential_load))
    return write(contact::half_plane_width(pair));
  const contact::LineSlip slip = contact::half_plane_slip(pair);
  add_slip(run, pair, slip);
  write(slip.width);
}
}  // namespace mill
