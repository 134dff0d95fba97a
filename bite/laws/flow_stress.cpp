#include "bite/laws/flow_stress.h"
#include <sstream>

namespace mill::bite {
std::size_t table_interval(const std::vector<std::array<double, 2>> &rows, const double strain)
{
  if (rows.size() < 2)
    throw InputError("strip.flow_stress: a table needs at least two rows of strain and stress");
  const double tolerance = 1e-12 * (1 + std::abs(strain));  // ln(h0/h) at an end is rounded
  if (!(strain >= rows.front()[0] - tolerance && strain <= rows.back()[0] + tolerance)) {
    std::ostringstream text;
    text.precision(4);
    text << "strip.flow_stress: the table covers strains " << rows.front()[0] << " .. " << rows.back()[0]
         << " but the bite needs " << strain << "; it is not extrapolated";
    throw InputError(text.str());
  }
  std::size_t i = 1;
  while (i + 1 < rows.size() && strain > rows[i][0])
    ++i;
  if (!(rows[i][0] > rows[i - 1][0]))
    throw InputError("strip.flow_stress: the strains of the table must increase");
  return i;
}

bool starts_from_nothing(const FlowStress &law, const double strain)
{
  if (law.law == "swift" || law.law == "reduction-power")
    return law.eps0 + strain < least_strain;
  const bool without_start = law.law == "power" || ((law.law == "ludwik" || law.law == "voce") && law.k0 == 0);
  return without_start && strain < least_strain;
}

void refuse_law(const std::string &law)
{
  throw InputError("strip.flow_stress.law = \"" + law +
                   "\" is not known; constant, swift, ludwik, voce, power, reduction-power or table");
}
}  // namespace mill::bite
