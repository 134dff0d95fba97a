#include "core/base/units.h"
#include "core/case/stand_reader.h"
#include "core/model/two_cylinders.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

// What the two bodies of kind two-cylinders and their contact must agree in.
namespace mill {
namespace {
struct NamedBody {
  const char *name;
  const RoundBody &body;
  std::string key(const std::string &row) const
  {
    return std::string(name) + "." + row;
  }
};

bool written(const Reading &reading, const std::string &key)
{
  return reading.places.count(key) > 0;
}

void no_effect(Reading &reading, const std::string &key, const std::string &because,
               const std::vector<std::string> &others = {})
{
  if (written(reading, key))
    contradict(reading, key, "has no effect " + because + "; leave it out", others);
}

void check_shape(const NamedBody &b, const bool in_space, Reading &reading)
{
  if (b.body.plane())
    for (const char *row : {"diameter", "crown_radius"})
      no_effect(reading, b.key(row), "on a plane", {b.key("shape")});
  if (b.body.rigid)
    for (const char *row : {"youngs_modulus", "poisson_ratio"})
      no_effect(reading, b.key(row), "on a rigid body", {b.key("rigid")});
  if (!in_space)
    for (const char *row :
         {"length", "crown_radius", "profile", "profile_length", "profile_drop", "profile_load", "profile_table"})
      if (row != std::string("profile") || b.body.profile != EndProfile::none)
        no_effect(reading, b.key(row), "in plane strain, only in [contact.space]");
}

void check_table(const NamedBody &b, Reading &reading)
{
  const std::string key = b.key("profile_table");
  const auto &table     = b.body.profile_table;
  if (table.empty() || !reading.usable({key, b.key("length")}) || std::isnan(b.body.length))
    return;
  const double needed = 0.5 * b.body.length * (1 - 1e-9);  // less the rounding of units
  if (table.front()[0] > 0)
    contradict(reading, key, "begins beyond mid-length; its first distance is 0 mm, or minus half the length", {});
  else if (table.back()[0] < needed || (table.front()[0] < 0 && table.front()[0] > -needed))
    contradict(reading, key,
               fmt::format("ends before the face does; the table must reach {}, half the length",
                           millimetres(0.5 * b.body.length)),
               {b.key("length")});
}

void check_profile(const NamedBody &b, Reading &reading)
{
  const EndProfile profile = b.body.profile;
  if (!reading.usable({b.key("profile"), b.key("length")}))
    return;
  const auto needs = [&](const std::string &row) {
    if (!written(reading, b.key(row)) && reading.usable({b.key(row)}))
      contradict(reading, b.key("profile"), "needs " + b.key(row), {});
  };
  if (profile != EndProfile::none)
    needs("length");
  if (profile == EndProfile::arc)
    needs("profile_drop");
  if (profile == EndProfile::table)
    needs("profile_table");
  const auto belongs_to = [&](const char *row, const EndProfile owner) {
    if (profile != owner)
      no_effect(reading, b.key(row), fmt::format("without profile = \"{}\"", word_of(owner)), {b.key("profile")});
  };
  belongs_to("profile_length", EndProfile::arc);
  belongs_to("profile_drop", EndProfile::arc);
  belongs_to("profile_load", EndProfile::log);
  belongs_to("profile_table", EndProfile::table);
  if (profile == EndProfile::arc && reading.usable({b.key("profile_length")}) &&
      b.body.profile_length > 0.5 * b.body.length * (1 + 1e-9))
    contradict(reading, b.key("profile_length"),
               fmt::format("is longer than half the face, {}", millimetres(0.5 * b.body.length)),
               {b.key("length")});
  check_table(b, reading);
}

// Sliding, and keys that wait for each other.
void check_friction(const std::string &section, const double friction, const double tangential, const double load,
                    const char *form, Reading &reading)
{
  const std::string mu = section + ".friction", Q = section + ".tangential_load", P = section + ".at";
  if (!reading.usable({mu, Q, P}))
    return;
  if (std::isnan(tangential)) {
    no_effect(reading, mu, "without a tangential_load");
    return;
  }
  if (std::isnan(friction)) {
    contradict(reading, Q, "needs a friction, for example friction = 0.2", {});
    return;
  }
  const double limit = friction * load;
  if (!(tangential < limit))
    contradict(reading, Q,
               fmt::format("slides as a whole: friction times the load is {:.5g} {}; lower it, or raise friction "
                           "or at",
                           from_si(limit, unit(form)), form),
               {mu, P});
}

void check_plane_strain(const TwoCylinders &pair, Reading &reading)
{
  const std::string depth  = "contact.line.plane_depth";
  const auto elastic_plane = [](const RoundBody &body) { return body.plane() && !body.rigid; };
  const bool needed        = elastic_plane(pair.upper) || elastic_plane(pair.lower);
  if (needed && !written(reading, depth) && reading.usable({depth}))
    contradict(reading, elastic_plane(pair.upper) ? "upper.shape" : "lower.shape",
               "needs contact.line.plane_depth: in plane strain the surface of an elastic plane moves without "
               "limit, so the approach is counted from a point at a stated depth",
               {});
  if (!needed)
    no_effect(reading, depth, "without an elastic plane");
  check_friction("contact.line", pair.contact.friction, pair.contact.tangential_load, pair.contact.at, "N/mm",
                 reading);
}

void check_space(const TwoCylinders &pair, Reading &reading)
{
  ContactSettings range;
  range.loads = pair.space.loads;
  range.at    = pair.space.at;
  check_contact("contact.space", range, reading);
  for (const NamedBody &b : {NamedBody{"upper", pair.upper}, NamedBody{"lower", pair.lower}})
    check_profile(b, reading);
  if (reading.usable({"upper.length", "lower.length", "upper.crown_radius", "lower.crown_radius"}) &&
      std::isnan(pair.upper.length) && std::isnan(pair.lower.length) && std::isnan(pair.upper.crown_radius) &&
      std::isnan(pair.lower.crown_radius))
    reading.add(reading.place("contact.space.at"),
                "the contact in [contact.space] is infinitely long: neither body has a length or a crown_radius; "
                "give one of them, or use [contact.line]");
  check_friction("contact.space", pair.space.friction, pair.space.tangential_load, pair.space.at, "N", reading);
}
}  // namespace

void check_bodies(const TwoCylinders &pair, Reading &reading)
{
  if (reading.usable({"upper.rigid", "lower.rigid"}) && pair.upper.rigid && pair.lower.rigid)
    contradict(reading, "lower.rigid", "is given although the upper body is rigid; one of the two must deform",
               {"upper.rigid"});
  if (reading.usable({"upper.shape", "lower.shape"}) && pair.upper.plane() && pair.lower.plane())
    contradict(reading, "lower.shape", "is given although the upper body is a plane; one of the two must be round",
               {"upper.shape"});
  for (const NamedBody &b : {NamedBody{"upper", pair.upper}, NamedBody{"lower", pair.lower}})
    check_shape(b, pair.in_space, reading);
  if (pair.in_space)
    check_space(pair, reading);
  else
    check_plane_strain(pair, reading);
}
}  // namespace mill
