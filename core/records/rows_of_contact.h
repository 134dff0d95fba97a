#pragma once
#include "core/records/result_row.h"

// Results of contacts: of the rolls of a stand, of two bodies of revolution in plane strain and in space.
namespace mill::row {
namespace roll_contact {
inline constexpr RowOf<2> tangent{"[pass.]{roll_contact}.tangent", "N/m", "3.7",
                                  "{roll_contact}, tangent dF/d\u03b4"};
inline constexpr RowOf<2> secant{"[pass.]{roll_contact}.secant", "N/m", "2.7", "{roll_contact}, secant F/\u03b4"};
inline constexpr RowOf<2> curvature{"[pass.]{roll_contact}.curvature", "N/m2", "3.7a",
                                    "{roll_contact}, curvature d\u00b2F/d\u03b4\u00b2 of force over approach"};
inline constexpr RowOf<2> in_stand_tangent{"[pass.]{roll_contact}.in_stand_tangent", "N/m", "3.7",
                                           "{roll_contact}, tangent with the rolls held as in the stand"};
inline constexpr RowOf<2> in_stand_secant{"[pass.]{roll_contact}.in_stand_secant", "N/m", "2.7",
                                          "{roll_contact}, secant with the rolls held as in the stand"};
inline constexpr RowOf<1> path_plateau{
    "{roll_contact}.path_plateau", "N/m", "2.15",
    "{roll_contact}, mean force per displacement of the nodes along the contact, which depends on the mesh"};
inline constexpr RowOf<1> friction_tangent{"{roll_contact}.friction_tangent", "N/m", "2.17",
                                           "{roll_contact}, tangent with friction in the contact"};
inline constexpr const ResultRow *all[]{&tangent,         &secant,       &curvature,       &in_stand_tangent,
                                        &in_stand_secant, &path_plateau, &friction_tangent};
}  // namespace roll_contact

namespace contact {
inline constexpr RowOf<1> half_width{"contact.{contact}.half_width", "m", "1.4",
                                     "{contact}, half width of the contact at mid-length"};
inline constexpr RowOf<1> peak_pressure{"contact.{contact}.peak_pressure", "Pa", "1.4",
                                        "{contact}, largest contact pressure at mid-length"};
inline constexpr RowOf<1> approach{"contact.{contact}.approach", "m", "2.7",
                                   "{contact}, approach of the two roll axes"};
inline constexpr RowOf<1> line_load_spread{
    "contact.{contact}.line_load_spread", "1", "11",
    "{contact}, largest difference of the line load between two solvers, divided by the largest line load"};
inline constexpr RowOf<1> contact_length{"contact.{contact}.contact_length", "m", "2",
                                         "{contact}, length over which the rolls touch"};
inline constexpr RowOf<1> joint_yy{"contact.{contact}.joint.yy", "N/m", "2.14",
                                   "{contact}, joint stiffness, force along the load by closing along the load"};
inline constexpr RowOf<1> joint_rx_rx{
    "contact.{contact}.joint.rx_rx", "N m", "2.14",
    "{contact}, joint stiffness, moment by rotation of the axes in the plane of the load"};
inline constexpr RowOf<1> joint_xx{
    "contact.{contact}.joint.xx", "N/m", "2.14",
    "{contact}, joint stiffness, force along the rolling direction by motion along it"};
inline constexpr RowOf<1> joint_ry_ry{
    "contact.{contact}.joint.ry_ry", "N m", "2.14",
    "{contact}, joint stiffness, moment by rotation of the axes across the plane of the load"};
inline constexpr RowOf<1> joint_zz{"contact.{contact}.joint.zz", "N/m", "2.14",
                                   "{contact}, joint stiffness, axial force by axial motion"};
inline constexpr RowOf<1> joint_y_rx{
    "contact.{contact}.joint.y_rx", "N", "2.14",
    "{contact}, joint stiffness, force along the load by rotation of the axes in the plane of the load"};
inline constexpr RowOf<1> joint_y_z{"contact.{contact}.joint.y_z", "N/m", "2.14",
                                    "{contact}, joint stiffness, force along the load by axial motion"};
inline constexpr RowOf<1> tilt{"contact.{contact}.tilt", "rad", "2.11", "{contact}, tilt of the axes"};
inline constexpr RowOf<1> load_offset{"contact.{contact}.load_offset", "m", "2",
                                      "{contact}, distance of the force from mid-length"};
inline constexpr RowOf<1> largest_pressure{
    "contact.{contact}.largest_pressure", "Pa", "2",
    "{contact}, largest contact pressure of all places, rolls held as in the stand"};
inline constexpr const ResultRow *all[]{&half_width,     &peak_pressure, &approach,        &line_load_spread,
                                        &contact_length, &joint_yy,      &joint_rx_rx,     &joint_xx,
                                        &joint_ry_ry,    &joint_zz,      &joint_y_rx,      &joint_y_z,
                                        &tilt,           &load_offset,   &largest_pressure};
}  // namespace contact

namespace space {
inline constexpr RowOf<0> half_width{"contact.space.half_width", "m", "33",
                                     "contact in space, half width of the contact at mid-length"};
inline constexpr RowOf<0> peak_pressure{"contact.space.peak_pressure", "Pa", "33",
                                        "contact in space, largest contact pressure at mid-length"};
inline constexpr RowOf<0> approach{"contact.space.approach", "m", "33",
                                   "contact in space, approach of points far from the contact"};
inline constexpr RowOf<0> tangent{"contact.space.tangent", "N/m", "33", "contact in space, tangent dF/d\u03b4"};
inline constexpr RowOf<0> secant{"contact.space.secant", "N/m", "33", "contact in space, secant F/\u03b4"};
inline constexpr RowOf<0> loaded_length{"contact.space.loaded_length", "m", "33",
                                        "contact in space, length that carries"};
inline constexpr RowOf<0> line_load_ratio{"contact.space.line_load_ratio", "1", "33",
                                          "contact in space, largest load per length divided by the mean"};
inline constexpr RowOf<0> edge_factor{"contact.space.edge_factor", "1", "33",
                                      "contact in space, largest pressure over that at mid-length"};
inline constexpr RowOf<0> moment{"contact.space.moment", "N m", "33.11",
                                 "contact in space, moment about mid-length"};
inline constexpr RowOf<0> stick_half_width{"contact.space.stick_half_width", "m", "33",
                                           "contact in space, half width of what sticks"};
inline constexpr RowOf<0> tangential_displacement{
    "contact.space.tangential_displacement", "m", "33",
    "contact in space, displacement of the bodies along the tangential load"};
inline constexpr RowOf<0> tangential_stiffness{"contact.space.tangential_stiffness", "N/m", "33",
                                               "contact in space, tangential stiffness before any slip"};
inline constexpr RowOf<0> tangential_tangent{"contact.space.tangential_tangent", "N/m", "33",
                                             "contact in space, tangential stiffness at the tangential load"};
inline constexpr const ResultRow *all[]{&half_width,
                                        &peak_pressure,
                                        &approach,
                                        &tangent,
                                        &secant,
                                        &loaded_length,
                                        &line_load_ratio,
                                        &edge_factor,
                                        &moment,
                                        &stick_half_width,
                                        &tangential_displacement,
                                        &tangential_stiffness,
                                        &tangential_tangent};
}  // namespace space

namespace line {
inline constexpr RowOf<0> half_width{"contact.line.half_width", "m", "33",
                                     "line contact, half width of the contact"};
inline constexpr RowOf<0> peak_pressure{"contact.line.peak_pressure", "Pa", "33",
                                        "line contact, largest contact pressure"};
inline constexpr RowOf<0> approach{"contact.line.approach", "m", "33", "line contact, approach of the two bodies"};
inline constexpr RowOf<0> tangent{"contact.line.tangent", "N/m2", "33",
                                  "line contact, tangent dF/d\u03b4 per length"};
inline constexpr RowOf<0> secant{"contact.line.secant", "N/m2", "33", "line contact, secant F/\u03b4 per length"};
inline constexpr RowOf<0> stick_half_width{"contact.line.stick_half_width", "m", "33",
                                           "line contact, half width of what sticks"};
inline constexpr RowOf<0> tangential_displacement{
    "contact.line.tangential_displacement", "m", "33",
    "line contact, displacement of the bodies along the tangential load"};
inline constexpr RowOf<0> tangential_stiffness{"contact.line.tangential_stiffness", "N/m2", "33",
                                               "line contact, tangential stiffness per length before any slip"};
inline constexpr RowOf<0> tangential_tangent{
    "contact.line.tangential_tangent", "N/m2", "33",
    "line contact, tangential stiffness per length at the tangential load"};
inline constexpr const ResultRow *all[]{&half_width,
                                        &peak_pressure,
                                        &approach,
                                        &tangent,
                                        &secant,
                                        &stick_half_width,
                                        &tangential_displacement,
                                        &tangential_stiffness,
                                        &tangential_tangent};
}  // namespace line
}  // namespace mill::row
