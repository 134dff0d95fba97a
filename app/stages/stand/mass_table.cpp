#include "app/stages/stand/mass_table.h"
#include "core/records/result_names.h"
#include <cmath>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace mill {
namespace {
std::string cell(const double kg)
{
  return std::isnan(kg) ? fmt::format("{:>14}", "-") : fmt::format("{:>14.1f}", kg);
}
}  // namespace

std::string mass_table(const Results &results)
{
  if (!results.find("M2"))
    return "";
  std::string text = fmt::format("{:<4}{:>14}{:>14}{:>14}{:>14}{:>14}{:>9}  {}\n", "[kg]", "used", "closed form",
                                 "FE, integral", "FE, all", "published", "differs", "source of what is used");
  for (int i = 1; i <= 6; ++i) {
    const Parameter *p = results.find("M" + std::to_string(i));
    if (!p)
      continue;
    const bool roll        = i > 1 && i < 6;
    const double closed    = value_beside(p->checks, CheckId::closed_form_mass),
                 solid     = value_beside(p->checks, CheckId::fe_solid_mass);
    const double integral  = value_beside(p->checks, CheckId::fe_integral_mass),
                 published = value_beside(p->checks, CheckId::published);
    const double beams     = value_beside(p->checks, CheckId::stepped_beams);  // where the chain's rolls are solid
    const bool from_solid  = roll && !std::isnan(closed);
    const bool from_closed = roll && !std::isnan(solid);
    text += fmt::format("{:<4}{}{}{}{}{}{:>9}  {}\n", "M" + std::to_string(i), cell(p->value),
                        cell(!std::isnan(beams) ? beams
                             : from_closed      ? p->value
                                                : closed),
                        cell(integral), cell(from_solid ? p->value : solid), cell(published),
                        std::isnan(published) ? "-" : fmt::format("{:+.2f} %", 100 * (p->value / published - 1)),
                        source_text(*p));
  }
  return text;
}
}  // namespace mill
