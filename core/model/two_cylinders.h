#pragma once
#include "core/base/choice.h"
#include "core/model/contact_settings.h"
#include "core/model/material.h"
#include <array>
#include <string>
#include <vector>

namespace mill {
enum class BodyShape { cylinder, plane };
constexpr auto words_of(BodyShape)
{
  return choice_words<BodyShape>("cylinder", "plane");
}
enum class EndProfile { none, arc, log, table };
constexpr auto words_of(EndProfile)
{
  return choice_words<EndProfile>("none", "arc", "log", "table");
}
/// Of the tangential load: across the axes or along them.
enum class TangentialDirection { across, along };
constexpr auto words_of(TangentialDirection)
{
  return choice_words<TangentialDirection>("across", "along");
}

/// One of two bodies in contact: a body of revolution about an axis parallel to the contact, or a plane.
struct RoundBody {
  BodyShape shape       = BodyShape::cylinder;
  double diameter       = not_given;                      ///< m, a plane has none
  bool rigid            = false;                          ///< does not deform
  double youngs_modulus = not_given;                      ///< Pa; that of [steel] when not given
  double poisson_ratio  = not_given;                      ///< -; that of [steel] when not given
  double length         = not_given;                      ///< m, of the face; the body goes on when not given
  double crown_radius   = not_given;                      ///< m, of the generator; straight when not given
  EndProfile profile    = EndProfile::none;               ///< of the ends
  double profile_length = not_given;                      ///< m, of the arc at each end
  double profile_drop   = not_given;                      ///< m, of the arc at the end
  double profile_load   = not_given;                      ///< N, for which the logarithm is ground
  std::vector<std::array<double, 2>> profile_table = {};  ///< m, m: drop over the distance from mid-length

  bool plane() const
  {
    return shape == BodyShape::plane;
  }
};

template <class Io> void each_member(Io &&io, const RoundBody &record)
{
  const auto &[shape, diameter, rigid, youngs_modulus, poisson_ratio, length, crown_radius, profile,
               profile_length, profile_drop, profile_load, profile_table] = record;
  io("shape", shape);
  io("diameter", diameter);
  io("rigid", rigid);
  io("youngs_modulus", youngs_modulus);
  io("poisson_ratio", poisson_ratio);
  io("length", length);
  io("crown_radius", crown_radius);
  io("profile", profile);
  io("profile_length", profile_length);
  io("profile_drop", profile_drop);
  io("profile_load", profile_load);
  io("profile_table", profile_table);
}

/// [contact.line]: plane strain, every load per length.
struct LineContactSettings : ContactSettings {
  double tangential_load = not_given;  ///< N/m, across the contact line
  double plane_depth     = not_given;  ///< m, of the point of a plane from which the approach is counted
};

/// [contact.space]: bodies of finite length or with a crown.
struct SpaceContactSettings {
  std::array<double, 2> loads              = {not_given, not_given};  ///< N, swept range
  double at                                = not_given;               ///< N, load of the scalar results
  int samples                              = 10;  ///< loads in the sweep, logarithmically spaced
  int rectangles                           = 12;  ///< over the half width of the contact
  double tilt                              = 0;   ///< rad, of the axes in the plane of the load, closing at z > 0
  double friction                          = not_given;  ///< -, Coulomb
  double tangential_load                   = not_given;  ///< N
  TangentialDirection tangential_direction = TangentialDirection::across;
};

template <class Io> void each_member(Io &&io, const SpaceContactSettings &record)
{
  const auto &[loads, at, samples, rectangles, tilt, friction, tangential_load, tangential_direction] = record;
  io("loads", loads);
  io("at", at);
  io("samples", samples);
  io("rectangles", rectangles);
  io("tilt", tilt);
  io("friction", friction);
  io("tangential_load", tangential_load);
  io("tangential_direction", tangential_direction);
}

/// kind = "two-cylinders": two bodies of revolution with parallel axes, in plane strain or in space.
struct TwoCylinders {
  Material steel;
  RoundBody upper, lower;
  LineContactSettings contact;  ///< when not in_space
  SpaceContactSettings space;   ///< when in_space
  bool in_space = false;
};

/// What solves it in plane strain: finite elements two elastic cylinders, or one on a rigid plane, which is the
/// plane of symmetry of two alike; else half planes.  theory.md 33.2
enum class PlaneEngine { two_cylinders, mirrored_upper, mirrored_lower, half_planes };
inline PlaneEngine plane_engine(const TwoCylinders &pair)
{
  const auto cylinder    = [](const RoundBody &body) { return !body.plane() && !body.rigid; };
  const auto rigid_plane = [](const RoundBody &body) { return body.plane() && body.rigid; };
  if (cylinder(pair.upper) && cylinder(pair.lower))
    return PlaneEngine::two_cylinders;
  if (cylinder(pair.upper) && rigid_plane(pair.lower))
    return PlaneEngine::mirrored_upper;
  return cylinder(pair.lower) && rigid_plane(pair.upper) ? PlaneEngine::mirrored_lower : PlaneEngine::half_planes;
}

/// Elastic constants of one body; a rigid one has an infinite Young's modulus.
inline Material material_of(const RoundBody &body, const Material &steel)
{
  Material material = steel;
  if (body.youngs_modulus == body.youngs_modulus)
    material.youngs_modulus = body.youngs_modulus;
  if (body.poisson_ratio == body.poisson_ratio)
    material.poisson_ratio = body.poisson_ratio;
  if (body.rigid)
    material.youngs_modulus = std::numeric_limits<double>::infinity();
  return material;
}
}  // namespace mill
