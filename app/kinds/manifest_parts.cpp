#include "app/kinds/manifest_parts.h"
#include "core/base/files.h"
#include "reduce/bearing/geometry.h"
#include <cmath>
#include <nlohmann/json.hpp>

namespace mill {
using json = nlohmann::ordered_json;

void add_bearings(json &manifest, const std::vector<RollerBearing> &bearings)
{
  for (const RollerBearing &b : bearings)
    manifest["bearings"][b.name] = {{"bore", b.bore},
                                    {"outside_diameter", b.outside_diameter},
                                    {"width", b.width},
                                    {"pitch_diameter", bearing::pitch_diameter(b)},
                                    {"rows", b.rows},
                                    {"rollers_per_row", b.rollers_per_row},
                                    {"roller_length", b.roller_length},
                                    {"roller_diameter", b.roller_diameter},
                                    {"roller_cone_angle", b.roller_cone_angle},
                                    {"cup_angle", b.cup_angle},
                                    {"arrangement", b.arrangement},
                                    {"arrangement_assumed", int(b.arrangement_assumed)},
                                    {"chock_width", b.chock_width},
                                    {"chock_height", b.chock_height},
                                    {"chock_support_width", b.chock_support_width},
                                    {"chock_support_gap", b.chock_support_gap}};
}

void add_passes(json &manifest, const std::vector<Pass> &passes, const ForceMeaning force_meaning)
{
  for (const Pass &pass : passes)
    manifest["passes"].push_back({{"name", pass.name},
                                  {"slug", slug(pass.name)},
                                  {"load", std::isnan(pass.load) ? json(nullptr) : json(pass.load)},
                                  {"synthetic", pass.synthetic},
                                  {"force_meaning", word_of(force_meaning)}});
}
}  // namespace mill
