#include "app/stages/bearing/bearing_across.h"
#include "core/numerics/mesh_pair.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill {
namespace {
bool on_block(const RollerBearing &b)
{
  return b.rings == RingBodies::elastic && b.chock == ChockForm::block;
}

// The chock seen along the pass line: its height lies across the load then, and all of that side is the support.
bearing::ChockSupport on_liner(RollerBearing b)
{
  std::swap(b.chock_width, b.chock_height);
  b.chock_support_width = b.chock_width;
  b.chock_support_gap   = not_given;
  return {"chock on its liner", b};
}

// The rolling force stands across the axis that is asked about: x points to the liner.
bearing::RingLoading across_drive(const BearingQuestion &q)
{
  auto loading     = bearing::radial_drive(0);
  loading.value[1] = q.radial;
  return loading;
}

double across(const bearing::BearingModel &model, const BearingQuestion &q)
{
  const auto loading = across_drive(q);
  return stiffness_along(bearing::BearingAssembly(model).solve(loading), loading, 0);
}

double by_law(const BearingQuestion &q, const OneRollerLaw law)
{
  return across(bearing::model_by_law(q.bearing, law), q);
}
}  // namespace

std::vector<bearing::ChockSupport> supports_across(const RollerBearing &b)
{
  return on_block(b) ? std::vector<bearing::ChockSupport>{on_liner(b)} : std::vector<bearing::ChockSupport>();
}

namespace {
// Stiffness across the load by the model of the case, by the standard, by Palmgren (NaN with contact elements,
// where it is not asked for), and by every other model.
Eigen::VectorXd all_across(RunContext &run, const BearingStudy &s)
{
  const BearingQuestion &q = s.question;
  const BearingParts parts =
      on_block(q.bearing) ? with_support(run, q.bearing, s.parts, on_liner(q.bearing)) : s.parts;
  const auto n = Eigen::Index(parts.companions.size());
  Eigen::VectorXd all(3 + n);
  all.head<3>() << across(parts.model, q), by_law(q, OneRollerLaw::iso),
      s.parts.roller ? not_given : by_law(q, OneRollerLaw::palmgren);
  for (Eigen::Index i = 0; i < n; ++i)
    all[3 + i] = across(parts.companions[std::size_t(i)].model, q);
  return all;
}
}  // namespace

Parameter bearing_across(RunContext &run, const BearingStudy &s)
{
  const BearingQuestion &q  = s.question;
  const bool liner          = on_block(q.bearing);
  const Eigen::VectorXd all = s.readings->numbers("across the load", [&] { return all_across(run, s); });
  Parameter p;
  p.value          = all[0];
  p.unit           = "N/m";
  p.method         = model_name(q.bearing) + ", across the load" + (liner ? ", chock on its liner" : "");
  p.at             = {"{} on one bearing", {{q.radial, "kN"}}};
  const double iso = all[1], palmgren = all[2];
  p.error_estimate = s.parts.roller ? std::abs(s.slice_deviation) : std::abs(iso / palmgren - 1);
  for (const double companion : all.tail(all.size() - 3))
    p.error_estimate += mesh_pair_error(p.value, companion, 2);
  if (liner && q.bearing.support_assumed)  // the case does not say that the liner carries the whole side
    p.error_estimate += std::abs(s.numbers.tangent_across.value / p.value - 1);
  p.checks = {{"ISO/TS 16281, rigid rings", iso, ""}};
  if (liner)
    p.checks.push_back({"the chock on the supports that carry the load", s.numbers.tangent_across.value, ""});
  return p;
}
}  // namespace mill
