#pragma once
#include "app/bearing_model.h"
#include "core/stand.h"
#include <optional>

namespace mill {
/// What is asked of a bearing.
struct BearingQuestion {
  RollerBearing bearing;
  double radial     = 0;        ///< N
  double axial      = 0;        ///< N; 0: the inner ring keeps its axial place
  double tilt       = 0;        ///< rad
  double cage_angle = 0;        ///< rad
  std::vector<double> loads;    ///< N, of the curve, ascending; may be empty
  GivenValues published;        ///< of [published]: Kzc, row1_roller..row4_roller
  std::string published_total;  ///< which of them is this bearing's stiffness: "Kzc", "Kzc2"
};

/// One bearing at its working load, by the model of the case, and by the others that stand beside it.
struct BearingStudy {
  BearingQuestion question;
  BearingParts parts;
  bearing::RingDrive drive;
  bearing::AssemblyState at;                   ///< at the working load
  bearing::AssemblyState standard;             ///< ISO law, rigid rings
  bearing::AssemblyState rigid;                ///< the law of the case, rigid rings
  double tangent = 0, secant = 0;              ///< N/m
  double tangent_across = 0;                   ///< N/m, across the load
  double error_tangent = 0, error_secant = 0;  ///< -, honest: two meshes, rings, slices against contact elements
  double slice_deviation = 0;  ///< -, slice law against contact elements at the heaviest roller's load
  std::vector<Check> tangent_checks, secant_checks;
  bearing::AssemblyCurve curve, standard_curve, rigid_curve;
};

/// Largest roller load, N, the question may lead to: for the mesh.
double largest_roller_load(const BearingQuestion &question);

/// Solves the bearing at its working load and over its curve.
/// @throws InputError   a fit beyond yield
/// @throws SolverError  no solution at the working load
BearingStudy study_bearing(RunContext &run, const BearingParts &parts, const BearingQuestion &question);

/// d F / d u along one axis (0..4), N/m or N m; the loads of the other load-driven axes kept.
double stiffness_along(const bearing::AssemblyState &state, const bearing::RingDrive &drive, int axis);

/// The name of the model: "FE law of one roller, elastic rings in their chock".
std::string model_name(const RollerBearing &bearing);
}  // namespace mill
