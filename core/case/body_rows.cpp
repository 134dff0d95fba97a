#include "core/case/stand_rows.h"

// Rows of kind two-cylinders: two bodies of revolution and their contact.
namespace mill {
namespace {
std::vector<Field<RoundBody>> body_rows(const char *diameter, const char *meaning)
{
  using T = RoundBody;
  return {
      {"diameter", &T::diameter, "mm", {1, 5000}, required, diameter, meaning},
      {"shape", &T::shape, "choice", any, BodyShape::cylinder, "cylinder",
       "of the surface; a plane has neither diameter nor crown_radius"},
      {"rigid", &T::rigid, "flag", any, 0, "true", "the body does not deform; at most one of the two"},
      {"youngs_modulus",
       &T::youngs_modulus,
       "GPa",
       {1, 2000},
       absent,
       "310 GPa",
       "of this body; when absent that of [steel]"},
      {"poisson_ratio",
       &T::poisson_ratio,
       "1",
       {0, 0.49},
       absent,
       "0.26",
       "of this body; when absent that of [steel]"},
      {"length",
       &T::length,
       "mm",
       {0.01, 100000},
       absent,
       "40 mm",
       "contact.space: length of the face, about mid-length; when absent the body is unlimited"},
      {"crown_radius",
       &T::crown_radius,
       "mm",
       {0.1, 1e7},
       absent,
       "2000 mm",
       "contact.space: radius of the crowned generator; when absent it is straight"},
      {"profile", &T::profile, "choice", any, EndProfile::none, "log",
       "contact.space: relief of both ends: a parabola over profile_length, the logarithm of Johns and Gohar, or "
       "profile_table"},
      {"profile_length",
       &T::profile_length,
       "mm",
       {0.001, 100000},
       absent,
       "5 mm",
       "profile arc: length of the relief at each end; when absent half the length"},
      {"profile_drop",
       &T::profile_drop,
       "um",
       {0.001, 100000},
       absent,
       "20 um",
       "profile arc: what the radius lacks at the end"},
      {"profile_load",
       &T::profile_load,
       "N",
       {0.001, 1e8},
       absent,
       "20000 N",
       "profile log: load on the contact for which it is ground; when absent contact.space.at"},
      {"profile_table",
       &T::profile_table,
       "mm, um",
       {-100000, 100000},
       absent,
       R"([["0 mm", "0 um"], ["15 mm", "0 um"], ["20 mm", "25 um"]])",
       "profile table: what the radius lacks over the distance from mid-length, straight between the points; "
       "mirrored when it begins at 0"},
  };
}
}  // namespace

const std::vector<Field<RoundBody>> &upper_body_rows()
{
  static const auto rows = body_rows("400 mm", "diameter of the upper cylinder");
  return rows;
}

const std::vector<Field<RoundBody>> &lower_body_rows()
{
  static const auto rows = body_rows("1300 mm", "diameter of the lower cylinder");
  return rows;
}

std::vector<Field<RoundBody>> body_rows_for(const Section &section)
{
  auto rows                = section.name == "upper" ? upper_body_rows() : lower_body_rows();
  const Node::Entry *shape = section.node ? section.node->find("shape") : nullptr;
  if (shape && shape->value.kind == Node::Kind::text && shape->value.text == "plane")
    rows.front().fallback = absent;
  return rows;
}

const std::vector<Field<LineContactSettings>> &line_contact_rows()
{
  using T = LineContactSettings;
  static const std::vector<Field<T>> rows{
      {"length", &T::length, "mm", {0.1, 100000}, required, "100 mm", "plane strain over this length"},
      {"loads", &T::loads, "N/mm", {0.01, 100000}, required, R"(["200 N/mm", "5000 N/mm"])", "swept range"},
      {"at", &T::at, "N/mm", {0.01, 100000}, required, "1000 N/mm", "load of the scalar results"},
      {"samples", &T::samples, "count", {5, 1000}, 24, "24", "loads in the sweep, logarithmically spaced"},
      {"elements_per_half_width",
       &T::elements_per_half_width,
       "count",
       {2, 64},
       8,
       "8",
       "quadratic elements per Hertz half width at the largest load"},
      {"friction", &T::friction, "1", {0, 2}, absent, "0.2", "Coulomb coefficient, for tangential_load"},
      {"tangential_load",
       &T::tangential_load,
       "N/mm",
       {0.001, 100000},
       absent,
       "100 N/mm",
       "across the contact line, applied after the load `at`; below friction times it, so that a part sticks"},
      {"plane_depth",
       &T::plane_depth,
       "mm",
       {0.1, 1e6},
       absent,
       "100 mm",
       "distance from the surface of an elastic plane of the point from which the approach is counted"},
  };
  return rows;
}

const std::vector<Field<SpaceContactSettings>> &space_contact_rows()
{
  using T = SpaceContactSettings;
  static const std::vector<Field<T>> rows{
      {"loads", &T::loads, "N", {0.001, 1e8}, required, R"(["2000 N", "40000 N"])", "swept range"},
      {"at", &T::at, "N", {0.001, 1e8}, required, "20000 N", "load of the scalar results"},
      {"samples", &T::samples, "count", {5, 200}, 10, "10", "loads in the sweep, logarithmically spaced"},
      {"rectangles", &T::rectangles, "count", {8, 40}, 12, "12", "rectangles over the half width of the contact"},
      {"tilt",
       &T::tilt,
       "mrad",
       {-100, 100},
       0,
       "0.5 mrad",
       "of the two axes in the plane of the load, closing on the side of positive distances"},
      {"friction", &T::friction, "1", {0, 2}, absent, "0.2", "Coulomb coefficient, for tangential_load"},
      {"tangential_load",
       &T::tangential_load,
       "N",
       {0.001, 1e8},
       absent,
       "1000 N",
       "applied after the load `at`; below friction times it, so that a part sticks"},
      {"tangential_direction", &T::tangential_direction, "choice", any, TangentialDirection::across, "along",
       "of the tangential load: across the axes, as in rolling, or along them"},
  };
  return rows;
}
}  // namespace mill
