#include "core/records/rows_of_bearing.h"
#include "core/records/rows_of_bite.h"
#include "core/records/rows_of_chatter.h"
#include "core/records/rows_of_cluster.h"
#include "core/records/rows_of_contact.h"
#include "core/records/rows_of_response.h"
#include "core/records/rows_of_stack.h"
#include "core/records/rows_of_stand.h"
#include <iterator>

namespace mill {
namespace {
template <std::size_t n>
RowGroup group_of_rows(const char *title, const char *chapter, const ResultRow *const (&rows)[n])
{
  return {title, chapter, {std::begin(rows), std::end(rows)}};
}
}  // namespace

const std::vector<RowGroup> &row_groups()
{
  static const std::vector<RowGroup> groups{
      group_of_rows("Contact of the rolls", "02-condensation-and-contact", row::roll_contact::all),
      group_of_rows("Roll bite as a spring", "08-roll-bite-slab-theories", row::bite_spring::all),
      group_of_rows("Contact of the rolls in detail", "02-condensation-and-contact", row::contact::all),
      group_of_rows("Contact in space", "33-bodies-of-revolution", row::space::all),
      group_of_rows("Line contact", "33-bodies-of-revolution", row::line::all),
      group_of_rows("Bearings, alone and in the stand", "05-roller-bearings", row::bearing::all),
      group_of_rows("A mass on a bearing", "16-mass-on-bearing", row::motion::all),
      group_of_rows("Rating and life of bearings", "05-roller-bearings", row::rating::all),
      group_of_rows("Oil films", "29-oil-film-bearing", row::film::all),
      group_of_rows("Roll bite", "08-roll-bite-slab-theories", row::bite::all),
      group_of_rows("Roll bite by every model", "17-integrated-slab-theories", row::bite_model::all),
      group_of_rows("Roll bite of a vibrating mill", "08-roll-bite-slab-theories", row::bite_slope::all),
      group_of_rows("Fit of the bite to measured values", "31-fit-to-measured-values", row::bite_fit::all),
      group_of_rows("Springs and masses of the chain", "04-springs-and-masses", row::chain::all),
      group_of_rows("Natural frequencies and modes", "22-stand-models", row::modes::all),
      group_of_rows("Frame and screw-down", "23-housing-and-screw-down", row::frame::all),
      group_of_rows("Mill modulus and thickness of the strip", "30-mill-modulus", row::stand::all),
      group_of_rows("Response of a pass, frequency response, rotating parts", "32-frequency-response",
                    row::response::all),
      group_of_rows("Response on the curves of contacts", "36-curves-of-contacts", row::nonlinear::all),
      group_of_rows("Chatter", "25-chatter-single-stand", row::chatter::all),
      group_of_rows("Planar stacks of rolls", "38-planar-roll-stacks", row::cluster::all),
      group_of_rows("Forces of a pass schedule", "39-forces-of-a-pass-schedule", row::schedule::all),
      group_of_rows("Roll stacks: strip and stack", "51-roll-stacks", row::stack::all),
      group_of_rows("Roll stacks: contacts", "51-roll-stacks", row::pair::all),
      group_of_rows("Roll stacks: rolls", "51-roll-stacks", row::roll::all),
      group_of_rows("Roll stacks: what moves the profile", "51-roll-stacks", row::influence::all),
      group_of_rows("Marks on the strip", "40-chatter-marks", row::marks::all),
      group_of_rows("Advice", "46-advice", row::advice::all),
      group_of_rows("Records, in analysis.json", "41-records", row::record::all),
      group_of_rows("Calibration, in calibration.json", "44-calibration", row::calibration::all)};
  return groups;
}
}  // namespace mill
