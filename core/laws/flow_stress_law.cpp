#include "flow_stress_law.h"
#include "refuse_input.h"
#include <algorithm>
#include <sstream>

#pragma GCC diagnostic error "-Wswitch"

namespace mill {
namespace {
using F = FlowStress;

const FlowStressRow constant{"constant", {&F::k}, false, false, false};
const FlowStressRow swift{"swift", {&F::k, &F::eps0, &F::n}, true, false, true};
const FlowStressRow ludwik{"ludwik", {&F::k, &F::k0, &F::n}, true, false, true};
const FlowStressRow voce{"voce", {&F::k, &F::k0, &F::n}, true, false, false};
const FlowStressRow power{"power", {&F::k, &F::n}, true, false, true};
const FlowStressRow reduction_power{"reduction-power", {&F::k, &F::eps0, &F::n}, true, false, true};
const FlowStressRow table{"table", {}, true, true, false};

// The row; null for a value that is not a law, so that all laws can be counted.
const FlowStressRow *find_row(const FlowStressLaw law)
{
  switch (law) {
  case FlowStressLaw::constant:
    return &constant;
  case FlowStressLaw::swift:
    return &swift;
  case FlowStressLaw::ludwik:
    return &ludwik;
  case FlowStressLaw::voce:
    return &voce;
  case FlowStressLaw::power:
    return &power;
  case FlowStressLaw::reduction_power:
    return &reduction_power;
  case FlowStressLaw::table:
    return &table;
  }
  return nullptr;
}
}  // namespace

const std::array<FlowStressConstant, n_flow_constants> &flow_stress_constants()
{
  static const std::array<FlowStressConstant, n_flow_constants> rows{
      {{"k", &F::k, "MPa", {0, 10000}, "28 MPa", "the constant, or the factor of the law", "flow stress, k", "Pa"},
       {"eps0",
        &F::eps0,
        "1",
        {0, 10},
        "0",
        "strain offset of swift and reduction-power",
        "flow stress, eps0",
        "1"},
       {"n", &F::n, "1", {0, 100}, "0", "exponent; rate of voce", "flow stress, n", "1"},
       {"k0", &F::k0, "MPa", {0, 10000}, "0 MPa", "initial value of ludwik and voce", "flow stress, k0", "Pa"}}};
  return rows;
}

const FlowStressRow &row_of(const FlowStressLaw law)
{
  return *find_row(law);
}

const std::vector<FlowStressLaw> &flow_stress_laws()
{
  static const std::vector<FlowStressLaw> laws = [] {
    std::vector<FlowStressLaw> all;
    for (int i = 0; find_row(FlowStressLaw(i)); ++i)
      all.push_back(FlowStressLaw(i));
    return all;
  }();
  return laws;
}

FlowStressLaw flow_stress_law(const std::string &name)
{
  std::string known;
  const std::size_t n = flow_stress_laws().size();
  for (std::size_t i = 0; i < n; ++i) {
    const FlowStressLaw law = flow_stress_laws()[i];
    if (name == row_of(law).name)
      return law;
    known += (i == 0 ? "" : i + 1 < n ? ", " : " or ") + name_of(law);
  }
  refuse_input("strip.flow_stress.law = \"" + name + "\" is not known; " + known);
}

std::string name_of(const FlowStressLaw law)
{
  return row_of(law).name;
}

bool reads(const FlowStress &flow, double FlowStress::*const member)
{
  const auto &needs = row_of(flow.law).needs;
  return std::find(needs.begin(), needs.end(), member) != needs.end();
}

FlowStress scaled(FlowStress flow, const double factor)
{
  flow.k *= factor;
  flow.k0 *= factor;
  for (auto &row : flow.table)
    row[1] *= factor;
  return flow;
}

double initial_stress(const FlowStress &flow)
{
  if (row_of(flow.law).tabled)
    return flow.table.empty() ? NAN : flow.table.front()[1];
  return bite::starts_from_nothing(flow, 0) ? NAN : bite::flow_stress(flow, 0.0);
}

namespace bite {
std::size_t table_interval(const std::vector<std::array<double, 2>> &rows, const double strain)
{
  if (rows.size() < 2)
    refuse_input("strip.flow_stress: a table needs at least two rows of strain and stress");
  const double tolerance = 1e-12 * (1 + std::abs(strain));  // ln(h0/h) at an end is rounded
  if (!(strain >= rows.front()[0] - tolerance && strain <= rows.back()[0] + tolerance)) {
    std::ostringstream text;
    text.precision(4);
    text << "strip.flow_stress: the table covers strains " << rows.front()[0] << " .. " << rows.back()[0]
         << " but the bite needs " << strain << "; it is not extrapolated";
    refuse_input(text.str());
  }
  std::size_t i = 1;
  while (i + 1 < rows.size() && strain > rows[i][0])
    ++i;
  if (!(rows[i][0] > rows[i - 1][0]))
    refuse_input("strip.flow_stress: the strains of the table must increase");
  return i;
}

bool starts_from_nothing(const FlowStress &law, const double strain)
{
  const bool starts = reads(law, &FlowStress::k0) && law.k0 != 0;
  return !starts && strain < strain_of_growth(law);
}

double strain_from_branch(const FlowStress &law, const double strain)
{
  return row_of(law.law).steep ? strain + (reads(law, &FlowStress::eps0) ? law.eps0 : 0) : INFINITY;
}

std::vector<SmoothFlowStress> smooth_pieces_of(const FlowStress &law, const double larger, const double smaller)
{
  std::vector<SmoothFlowStress> pieces;
  if (!row_of(law.law).tabled) {
    pieces.push_back({larger, law});
    if (const double kink = strain_of_growth(law); kink < larger && kink > smaller)
      pieces.push_back({kink, law});
    return pieces;
  }
  const std::size_t first = table_interval(law.table, larger), last = table_interval(law.table, smaller);
  for (std::size_t i = first; i >= last && i > 0; --i) {
    const auto &a = law.table[i - 1], &b = law.table[i];
    FlowStress line;
    line.law = FlowStressLaw::ludwik;
    line.n   = 1;
    line.k   = (b[1] - a[1]) / (b[0] - a[0]);
    line.k0  = a[1] - line.k * a[0];
    pieces.push_back({std::min(b[0], larger), line});
  }
  return pieces;
}
}  // namespace bite
}  // namespace mill
