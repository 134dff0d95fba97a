#include "app/stages/bearing_across.h"
#include "core/numerics/mesh_pair.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill {
namespace {
bool on_block(const RollerBearing &b)
{
  return b.rings == "elastic" && b.chock == "block";
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
bearing::RingDrive across_drive(const BearingQuestion &q)
{
  auto drive     = bearing::radial_drive(0);
  drive.value[1] = q.radial;
  return drive;
}

double across(const bearing::BearingModel &model, const BearingQuestion &q)
{
  const auto drive = across_drive(q);
  return stiffness_along(bearing::BearingAssembly(model).solve(drive), drive, 0);
}

double by_law(const BearingQuestion &q, const std::string &law)
{
  RollerBearing b = with_row_places(q.bearing);
  b.roller_law    = law;
  b.rings         = "rigid";
  return across(bearing::rigid_model(b), q);
}
}  // namespace

std::vector<bearing::ChockSupport> supports_across(const RollerBearing &b)
{
  return on_block(b) ? std::vector<bearing::ChockSupport>{on_liner(b)} : std::vector<bearing::ChockSupport>();
}

Parameter bearing_across(RunContext &run, const BearingStudy &s, const std::vector<std::string> &inputs)
{
  const BearingQuestion &q = s.question;
  const bool liner         = on_block(q.bearing);
  const BearingParts parts = liner ? with_support(run, q.bearing, s.parts, on_liner(q.bearing)) : s.parts;
  Parameter p;
  p.value          = across(parts.model, q);
  p.unit           = "N/m";
  p.method         = model_name(q.bearing) + ", across the load" + (liner ? ", chock on its liner" : "");
  p.at             = fmt::format("{:.6g} kN on one bearing", q.radial / 1e3);
  p.inputs         = inputs;
  const double iso = by_law(q, "iso");
  p.error_estimate = parts.roller ? std::abs(s.slice_deviation) : std::abs(iso / by_law(q, "palmgren") - 1);
  for (const BearingVariant &companion : parts.companions)
    p.error_estimate += mesh_pair_error(p.value, across(companion.model, q), 2);
  if (liner && q.bearing.support_assumed)  // nobody said that the liner carries the whole side
    p.error_estimate += std::abs(s.tangent_across / p.value - 1);
  p.checks = {
      {"ISO/TS 16281, rigid rings", iso, ""}
  };
  if (liner)
    p.checks.push_back({"the chock on the supports that carry the load", s.tangent_across, ""});
  return p;
}
}  // namespace mill
