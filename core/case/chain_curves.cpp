#include "core/case/chain_curves.h"
#include "core/case/stand_reader.h"
#include "core/model/four_high.h"
#include "core/model/lumped.h"
#include <fmt/format.h>

namespace mill {
namespace {
const char *const any_curve_key = "dynamics.contact";

bool wants_curves(const DynamicsSettings &dynamics, const Reading &reading)
{
  return dynamics.contact == ContactSprings::curve && reading.usable({any_curve_key});
}

// With the published reading K4 takes a share of the mean force, so that no load of the contacts is known.
void refuse_published(const DynamicsSettings &dynamics, Reading &reading)
{
  if (dynamics.force_meaning == ForceMeaning::published)
    contradict(reading, any_curve_key,
               "needs the load of every contact at rest, which the published reading of the force does not have; "
               "use \"measured\" or \"disturbance\"",
               {"dynamics.force_meaning"});
}
}  // namespace

const std::vector<Field<ChainCurves>> &chain_curve_rows()
{
  using T                                 = ChainCurves;
  static const std::vector<Field<T>> rows = [] {
    std::vector<Field<T>> all;
    const auto add = [&](const char *key, ChainCurves::Curve T::*member, const char *meaning) {
      all.push_back({key,
                     member,
                     "kN, um",
                     {0.001, 1e6},
                     absent,
                     R"([["100 kN", "3.2 um"], ["1000 kN", "27 um"]])",
                     meaning});
    };
    add("K2", &T::K2, "force and compression of K2, upper backup-roll bearings and what is in series with them");
    add("K3", &T::K3, "force and compression of K3, upper roll contact");
    add("K4", &T::K4, "force and closing of K4, the strip; only where dynamics.force_meaning keeps K4");
    add("K5", &T::K5, "force and compression of K5, lower roll contact");
    add("K6", &T::K6, "force and compression of K6, lower backup-roll bearings and what is in series with them");
    return all;
  }();
  return rows;
}

ChainCurves read_chain_curves(const Node &root, Reading &reading)
{
  ChainCurves curves;
  const Section section = section_at(root, "curve", reading);
  if (!section.node)
    return curves;
  read_and_echo(section, section.header(), chain_curve_rows(), curves, reading);
  for (const Field<ChainCurves> &row : chain_curve_rows()) {
    const std::string key = section.key(row.key);
    if (!reading.usable({key}))
      continue;
    const auto &curve = curves.*std::get<ChainCurves::Curve ChainCurves::*>(row.member);
    for (std::size_t i = 0; i < curve.size(); ++i)
      if (!(curve[i][0] > 0) || (i > 0 && !(curve[i][1] > curve[i - 1][1]))) {
        reading.add(
            reading.place(key),
            fmt::format("{}[{}]: force {:g} kN, compression {:g} um: both must be above zero and rise from "
                        "pair to pair",
                        key, i, curve[i][0] / 1e3, curve[i][1] * 1e6));
        break;
      }
  }
  return curves;
}

void check_contact_curves(const FourHigh &stand, Reading &reading)
{
  if (!wants_curves(stand.dynamics, reading))
    return;
  refuse_published(stand.dynamics, reading);
  for (const char *name : {"K3", "K5", "K2", "K6", "K_Zy", "Kzc1", "Kzc4"})
    if (const auto given = stand.given.find(name);
        given != stand.given.end() && reading.places.count("given." + std::string(name)))
      contradict(reading, "given." + std::string(name),
                 "is one number and has no curve; leave it out, so that the curve is computed, or set "
                 "dynamics.contact = \"linear\"",
                 {any_curve_key});
}

void check_contact_curves(const Lumped &lumped, Reading &reading)
{
  if (!wants_curves(lumped.dynamics, reading))
    return;
  refuse_published(lumped.dynamics, reading);
  if (lumped.detailed)
    contradict(reading, any_curve_key,
               "needs springs of their own, and the matrices of [model] hold them as one stiffness; run the stand "
               "itself with this key and dynamics.model, or set \"linear\"",
               {"model.stiffness"});
  else if (!lumped.curves.any() && reading.usable({"curve.K2", "curve.K3", "curve.K4", "curve.K5", "curve.K6"}))
    contradict(
        reading, any_curve_key,
        "needs curves, and given.K2 to given.K6 are numbers; add [curve] with K3 = [[\"100 kN\", \"3.2 um\"], "
        "..], or take the lumped_model.toml that a run of the stand with this key writes",
        {"given.K3"});
}

std::string chain_curves_toml(const ChainCurves &curves)
{
  std::string text;
  for (const Field<ChainCurves> &row : chain_curve_rows())
    if (const std::string toml = toml_of(row_of(row), member_value(row, curves)); !toml.empty())
      text += row.key + (" = " + toml) + "\n";
  return text.empty() ? "" : "\n[curve]\n" + text;
}
}  // namespace mill
