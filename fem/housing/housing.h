#pragma once
#include "core/base/choice.h"
#include "core/model/frame.h"
#include "core/model/housing.h"
#include "fem/body/elastic_body.h"
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace mill::fem {
/// Parts a housing is divided into: at the level of the feet, and along the lines from the outer corners to the
/// middle of the fillets.  theory.md 23.3
enum HousingPart { upper_post, upper_beam, lower_post, lower_beam, n_housing_parts };

/// Part that a cell belongs to, by its middle (m): the mesh has lines along every border.
HousingPart housing_part(const MillHousing &housing, const Eigen::RowVector3d &middle);

/// Both housings of a stand under a unit bite force, up on the screw pads and down on the chock seats.
/// Displacements are means over a pad, so that what the pad itself is pressed in is part of them; they count from
/// the mean of the feet.  theory.md 23.2
struct HousingStatics {
  double u_screw = 0;                            ///< m/N, upwards: 1/K of the upper frame
  double u_seat  = 0;                            ///< m/N, upwards, so negative: -1/K of the lower frame
  std::array<double, n_housing_parts> energy{};  ///< m/N, twice the strain energy of each part under 1 N
  /// What the part above the feet stores beyond the work of its own load: work through the section at the feet,
  /// which the part below has less.  (23.6)
  double exchanged = 0;  ///< m/N
  std::array<double, n_housing_parts>
      flexibility{};  ///< m/N, shares of u_screw (upper) and -u_seat (lower), (23.7)
  std::array<double, n_housing_parts> reduced_mass{};   ///< kg, moving with screw (upper) or seat (lower), (23.8)
  std::array<double, n_housing_parts> vertical_mass{};  ///< kg, of that what moves up and down
  std::array<double, n_housing_parts> mass{};           ///< kg, of the parts themselves, as meshed
  double force_error = 0;                               ///< -, largest nodal force left over, of the load on a pad
  Eigen::VectorXd displacement;                         ///< (3N) m/N, of the quarter
  int n_unknowns = 0;                                   ///< free ones of the quarter
  /// -, estimated shares of u_screw, u_seat, M1 part and M6 part; NaN: not estimated
  std::array<double, 4> error{not_given, not_given, not_given, not_given};
  std::array<double, n_housing_parts> flexibility_error{}, mass_error{};  ///< -, the same of each part's share
};

/// Unknowns of the quarter held by its two planes of symmetry and at one node of a foot; nothing else keeps it
/// from moving up and down.  (3N) 1: held
std::vector<char> held_housing(const ElasticBody &quarter);

/// Groups of faces of a housing that carry its force.
enum class HousingGroup { screw, seat, foot };
constexpr auto words_of(HousingGroup)
{
  return choice_words<HousingGroup>("screw", "seat", "foot");
}

/// (3N) mean vertical displacement over a boundary group, as a functional: w . u; sums to one.
/// @throws InputError  the mesh has no such group: the part and the direction that is not held are named
Eigen::VectorXd mean_vertical(const ElasticBody &quarter, HousingGroup group);

/// @param quarter  of meshes::mesh_housing() for this housing, degree 2
/// @throws InputError   no feet
/// @throws SolverError  a pad moves against its load: a foot level that no such load path has
/// Cost: one factorisation; 0.5 s for 10 000 unknowns.
HousingStatics housing_statics(const MillHousing &housing, const ElasticBody &quarter);

/// Fills the errors of the finer of two solutions from meshes of `ratio` times as many elements through the posts:
/// mesh_pair_error() with a gain of ratio^2, since the flat sides of the fillets are of second order.  (23.9)
void estimate_error(HousingStatics &fine, const HousingStatics &coarse, double ratio);

/// The frame with posts and beams, stiffness and reduced mass, from a housing.
Frame frame_with_housing(Frame frame, const HousingStatics &housing);

/// Displacement (m) and stress under `force` N of bite, for ParaView.
void write_housing_vtu(const std::string &path, const ElasticBody &quarter, const HousingStatics &housing,
                       double force);
}  // namespace mill::fem
