#pragma once
#include "core/case/kinds.h"
#include "core/case/pass_inputs.h"
#include "core/model/bite_setup.h"
#include "core/model/pass.h"
#include "core/model/strip.h"
#include "core/records/key_list.h"
#include "core/records/result_row.h"
#include <string>
#include <vector>

// What the bite of a pass reads of a case; as core/case/contact_inputs.h.
namespace mill {
class MovingKeys;

/// A pass as a fit of friction and flow stress reads it; what it is not fitted to is absent.
struct MeasuredInputs {
  double entry_thickness = 0, exit_thickness = 0;  ///< m
  double entry_tension = 0, exit_tension = 0;      ///< Pa
  double speed = not_given;                        ///< m/s
  std::vector<LoadInputs> force;                   ///< none or one
  double force_deviation = not_given, slip = not_given, slip_deviation = not_given, torque = not_given,
         torque_deviation = not_given;  ///< -, -, -, N m, -
};

template <class Io> void each_member(Io &&io, const MeasuredInputs &record)
{
  const auto &[entry_thickness, exit_thickness, entry_tension, exit_tension, speed, force, force_deviation, slip,
               slip_deviation, torque, torque_deviation] = record;
  io("entry_thickness", entry_thickness);
  io("exit_thickness", exit_thickness);
  io("entry_tension", entry_tension);
  io("exit_tension", exit_tension);
  io("speed", speed);
  io("force", force);
  io("force_deviation", force_deviation);
  io("slip", slip);
  io("slip_deviation", slip_deviation);
  io("torque", torque);
  io("torque_deviation", torque_deviation);
}

/// One pass by one model.
struct BiteInputs {
  Strip strip;  ///< with the values of the pass in the place of its own; width: of results that have it
  double roll_diameter = 0;  ///< m
  ElasticConstants roll;
  double speed = not_given;          ///< m/s, of the rolls
  std::string method, theory, flow;  ///< words of the settings
  BiteArc arc        = BiteArc::automatic;
  int elements_along = 0, elements_through = 0;
  double path_trim = not_given;  ///< -
  std::vector<PassMeasure> fit;  ///< what friction and flow stress are fitted to; empty: not at all
  std::vector<std::string> fit_for;
  double measured_width = not_given;                              ///< m, over which the measured forces act
  std::vector<MeasuredInputs> measured;                           ///< all passes
  double backup_diameter = not_given, backup_length = not_given;  ///< m, of the backup roll on the roll's section
  std::vector<LoadInputs> backup_load;                            ///< none or one: with which it carries
};

template <class Io> void each_member(Io &&io, const BiteInputs &record)
{
  const auto &[strip, roll_diameter, roll, speed, method, theory, flow, arc, elements_along, elements_through,
               path_trim, fit, fit_for, measured_width, measured, backup_diameter, backup_length, backup_load] =
      record;
  io("strip", strip);
  io("roll_diameter", roll_diameter);
  io("roll", roll);
  io("speed", speed);
  io("method", method);
  io("theory", theory);
  io("flow", flow);
  io("arc", arc);
  io("elements_along", elements_along);
  io("elements_through", elements_through);
  io("path_trim", path_trim);
  io("fit", fit);
  io("fit_for", fit_for);
  io("measured_width", measured_width);
  io("measured", measured);
  io("backup_diameter", backup_diameter);
  io("backup_length", backup_length);
  io("backup_load", backup_load);
}

/// Who answers: the model that gives K4, a slab theory that is compared with it, or the closed form that
/// represents both, on a rigid arc or on Hitchcock's circle.
enum class BiteAnswers { model, compared, closed_form };

/// What is asked of a bite.
struct BiteReading {
  BiteAnswers by   = BiteAnswers::model;
  bool whole_width = true;  ///< a force, a torque or a stiffness; false: pressure, slip and others without a width
  bool fitted      = true;  ///< by a strip that is fitted where the case asks for it
  bool path_trim   = false;  ///< the plateau along the path
  bool speed       = false;  ///< a speed of the strip
  bool elastic     = false;  ///< elastic zones of the strip, whatever its model
  bool free_arc    = false;  ///< a theory that is compared on a free arc
  bool section = false;  ///< on the section of the work roll, which the backup roll holds, where the bite itself
                         ///< has decided that the arc is free
};

/// A strip whose laws have the constants that they read; those of other laws are absent.
Strip with_laws_as_read(Strip strip);

/// The strip of a pass: its own thicknesses and tensions, where it gives them.
Strip with_values_of_pass(Strip strip, const Pass &pass);

/// @param spec  a stand or a bite
BiteInputs inputs_of_bite(const CaseSpec &spec, std::size_t pass, const BiteReading &reading);

/// The bite of a pass of a stand or of kind "bite".
KeyList bite_keys(MovingKeys &keys, std::size_t p, const BiteReading &reading = {});
/// What a result of the bite reads, from its unit: the width where it is a force of the whole strip, the speed of
/// the rolls where the second is in it.
BiteReading reading_of(const ResultRow &row, BiteAnswers by);
}  // namespace mill
