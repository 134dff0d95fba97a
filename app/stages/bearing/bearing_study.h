#pragma once
#include "app/stages/bearing/bearing_model.h"
#include "app/stages/bearing/bearing_readings.h"
#include "core/model/bearing_case.h"
#include "core/model/given.h"
#include "reduce/bearing/asked_load.h"
#include "reduce/bearing/bearing_numbers.h"
#include <memory>

namespace mill {
/// What is asked of a bearing.
struct BearingQuestion : bearing::AskedLoad {
  RollerBearing bearing;
  double cage_angle  = 0;          ///< rad
  double speed       = not_given;  ///< 1/s, of the shaft
  double centrifugal = 0;          ///< N, of each roller, in the equilibrium
  GivenValues published;           ///< of [published]: Kzc, row1_roller..row4_roller
  std::string published_total;     ///< which of them is this bearing's stiffness: "Kzc", "Kzc2"
};

/// One bearing at its working load and over its curve.
struct BearingStudy : bearing::ComparedStates {
  BearingQuestion question;
  BearingParts parts;
  bearing::BearingNumbers numbers;
  double slice_deviation = 0;  ///< -, slice law against contact elements at the heaviest roller's load
  bearing::AssemblyCurve curve, standard_curve, rigid_curve;
  std::shared_ptr<BearingReadings> readings;  ///< what else was solved of it, shared by copies
};

/// What a case of kind "bearing" asks.
BearingQuestion question_of(const BearingCase &spec);

/// "1000 kN on one bearing, 50 kN axial": what a result of the study belongs to.
OperatingPoint operating_point(const BearingStudy &study);

/// Solves the bearing at its working load and over its curve.
/// @throws InputError   a fit beyond yield
/// @throws SolverError  no solution at the working load
BearingStudy study_bearing(RunContext &run, const BearingParts &parts, const BearingQuestion &question);

/// The name of the model: "FE law of one roller, elastic rings in their chock".
std::string model_name(const RollerBearing &bearing);
}  // namespace mill
