#pragma once
#include "reduce/bearing/assembly.h"
#include <functional>
#include <string>
#include <vector>

// Numbers of one solved bearing with their errors and what they are compared with: no text, no files.
namespace mill::bearing {
/// The state with one ingredient of the model exchanged, everything else and the load the same.
struct StateVariant {
  std::string about;
  AssemblyState at;
};

/// One bearing at its working load, by the model of the case, and by the models that it is compared with.
struct ComparedStates {
  RingLoading loading;
  AssemblyState at;        ///< at the working load
  AssemblyState standard;  ///< ISO law, rigid rings
  AssemblyState palmgren;  ///< Palmgren's law, rigid rings
  AssemblyState rigid;     ///< the law of the case, rigid rings
  /// What the result is known to, one state each: roller and rings on coarser meshes, the slices' distance from
  /// the contact elements, another published law where no elements made the law.
  std::vector<StateVariant> companions;
  std::size_t meshes = 0;                  ///< how many of the companions, from the first, are coarser meshes
  std::vector<StateVariant> supports;      ///< of the chock, where the case leaves them open
  std::vector<StateVariant> arrangements;  ///< rigid rings, other usual rows, where the case does not say its own
};

/// One number of a state: a stiffness, a share.
using StateNumber = std::function<double(const AssemblyState &)>;

/// A number with its error, and what the other models give for it.  The member that is one states its unit.
struct ComparedNumber {
  double value    = not_given;  ///< unit of the quantity
  double error    = not_given;  ///< -, relative; NaN: the number is zero, or nothing states what it is known to
  double standard = not_given;  ///< unit of the quantity, as all that follow: of the state of the same name
  double palmgren = not_given;  ///< the same unit
  double rigid    = not_given;  ///< the same unit
  std::vector<double> supports, arrangements;
};
/// Error: the sum of what each companion changes in the number, meshes with the safety of a pair, and the largest
/// change by a support of the chock that is left open.
ComparedNumber compared_number(const ComparedStates &states, const StateNumber &number);

/// What a number owes to the rollers of a bearing where these are estimated from its ratings.
enum class EstimatedPart {
  stiffness,  ///< radial stiffness of the whole bearing
  angle,      ///< what the contact angle decides
  rollers     ///< what the number of rollers decides
};
/// Relative error from it: the largest distance of a candidate from the first; 0 without candidates.
double estimate_error(const std::vector<RollerCandidate> &candidates, EstimatedPart part);

/// Stiffness of the heaviest roller of each row between its raceways.
struct RowRollers {
  Eigen::VectorXd load;             ///< (rows) N
  Eigen::VectorXd secant, tangent;  ///< (rows) N/m
};
RowRollers heaviest_of_rows(const AssemblyState &state);

/// All numbers of a bearing at its working load.
struct BearingNumbers {
  ComparedNumber tangent;                 ///< N/m, along the radial load
  ComparedNumber secant;                  ///< N/m
  ComparedNumber tangent_across;          ///< N/m, across the load
  ComparedNumber axial;                   ///< N/m, all other motions held
  ComparedNumber tilting;                 ///< N m/rad, in the plane of the load
  ComparedNumber axial_load;              ///< N
  ComparedNumber axial_displacement;      ///< m
  ComparedNumber moment;                  ///< N m, in the plane of the load
  ComparedNumber tilt;                    ///< rad
  ComparedNumber roller_secant;           ///< N/m, of the heaviest roller
  ComparedNumber roller_tangent;          ///< N/m
  ComparedNumber roller_max;              ///< N
  ComparedNumber rib_max;                 ///< N, heaviest roller on the rib of the cone
  std::vector<ComparedNumber> row_share;  ///< -, of the radial load
  std::vector<ComparedNumber> row_axial;  ///< N, of the row on the cup
  double heaviest_angle = not_given;      ///< rad, of the heaviest roller from the line of the load, >= 0
};
/// @param candidates  of estimated rollers; their spread is part of the errors
/// Cost: under 1 ms.
BearingNumbers bearing_numbers(const ComparedStates &states, const std::vector<RollerCandidate> &candidates);
}  // namespace mill::bearing
