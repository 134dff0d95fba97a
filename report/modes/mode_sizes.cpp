#include "report/modes/mode_sizes.h"
#include "report/modes/animation.h"
#include <algorithm>

namespace mill::report {
namespace {
// Proportions of a stand of 1400 mm, as long as the longest axis that is stored.
StandSizes assumed_sizes(const ComparedModel &model)
{
  double longest = 0;
  for (const ModelLine &line : model.lines)
    if (line.z.size() > 0)
      longest = std::max(longest, line.z.maxCoeff());
  const double f = longest > 0 ? longest / 1.65 : 1;
  return {{0.7 * f, 0.7 * f, 0.45 * f, 1.65 * f, 1.2 * f}, {0.2 * f, 0.7 * f, 0.13 * f, 1.15 * f, f}, 0.5 * f};
}
}  // namespace

StandSizes sizes_of(const ComparedModel &model, const std::map<std::string, double> &geometry)
{
  if (!has_roll_sizes(geometry))
    return assumed_sizes(model);
  const auto half = [&](const char *name) { return 0.5 * geometry.at(name); };
  StandSizes s;
  s.backup         = {half("backup_diameter"), half("backup_length"), half("backup_neck_diameter"),
                      half("backup_length") + geometry.at("backup_neck_length"), half("backup_bearing_span")};
  s.work           = {half("work_roll_diameter"), half("work_roll_length"), half("work_neck_diameter"),
                      half("work_total_length"), half("work_bearing_span")};
  const auto strip = geometry.find("strip_width");
  s.half_strip     = strip == geometry.end() ? 0.7 * s.work.half_barrel : 0.5 * strip->second;
  return s;
}

bool has_roll_sizes(const std::map<std::string, double> &geometry)
{
  for (const char *name :
       {"work_roll_diameter", "work_roll_length", "work_neck_diameter", "work_total_length", "work_bearing_span",
        "backup_diameter", "backup_length", "backup_neck_diameter", "backup_neck_length", "backup_bearing_span"})
    if (const auto match = geometry.find(name); match == geometry.end() || !(match->second > 0))
      return false;
  return true;
}
}  // namespace mill::report
