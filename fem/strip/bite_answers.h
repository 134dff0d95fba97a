#pragma once
#include "core/base/each_member.h"
#include "core/base/warning.h"
#include "core/model/bite_setup.h"
#include "fem/strip/rigid_plastic/strip_flow.h"
#include "reduce/bite/bite.h"
#include "reduce/bite/slab/regime.h"
#include "reduce/bite/slab/slab_bite.h"
#include <optional>
#include <string>
#include <vector>

// One pass by every model of the roll bite: the question, the answers, and which of them is the result.
namespace mill::fem {
/// What is asked of a roll bite.
struct BiteQuestion {
  bite::RollBite bite;
  BiteSetup setup;
  std::string pass;                     ///< its name
  double force = not_given;             ///< N, for comparison with the computed one
  std::string force_name;               ///< "mean of the recorded force"
  double force_deviation = not_given;   ///< -, standard deviation of that force where the strip was fitted to it
  bool stress_fitted_to_force = false;  ///< the flow stress of `bite` comes from `force`, not from the case
  double measured_slip        = not_given;  ///< -, forward slip for comparison with the computed one
  double measured_torque      = not_given;  ///< N m, of one roll
  std::string roll_key;                     ///< of the case file, "work_roll.barrel_diameter"
  bool curves              = true;  ///< also K4 over reduction, tension, friction, speed and the bite's aspect
  double backup_half_width = 0;     ///< m, of the contact with the back-up roll opposite; 0: none
};

/// One model's answer, or why it has none.
struct BiteAnswer {
  std::string key;          ///< "fe", "karman", "karman-elastic-arc": names results and files
  std::string refused;      ///< empty, or what the model says
  bool impossible = false;  ///< refused because no roll can take the strip, and not for want of convergence
  bite::BiteState state;
  bite::BiteStiffness stiffness;
};

/// The finite-element bite on two meshes.
struct FlowAnswer {
  fem::StripFlow fine;
  double coarsening = not_given;          ///< -, elements of the coarser mesh over those of the finer one, in the
                                          ///< direction in which that is less
  double coarse_force       = not_given;  ///< N, on the coarser mesh
  double coarse_slope       = not_given;  ///< N/m
  double coarse_torque      = not_given;  ///< N m
  double coarse_slip        = not_given;  ///< -, forward slip
  bool elastic              = false;      ///< elastic-plastic strip; what follows is of that only
  double smallest_thickness = not_given;  ///< m, of the strip under the rolls
  double elastic_entry      = not_given;  ///< m, contact before the strip's surface yields
  double elastic_exit       = not_given;  ///< m, contact behind its last yielding
  double elastic_power      = not_given;  ///< -, elastic energy carried off over the power spent
  Eigen::VectorXd outlet_height;          ///< (n) m, from the middle plane
  Eigen::VectorXd outlet_stress;          ///< (n) Pa, along the strip far behind the bite
};

template <class Io, class R, if_record<R, FlowAnswer> = 0> void each_member(Io &&io, R &record)
{
  auto &[fine, coarsening, coarse_force, coarse_slope, coarse_torque, coarse_slip, elastic, smallest_thickness,
         elastic_entry, elastic_exit, elastic_power, outlet_height, outlet_stress] = record;
  io("fine", fine);
  io("coarsening", coarsening);
  io("coarse_force", coarse_force);
  io("coarse_slope", coarse_slope);
  io("coarse_torque", coarse_torque);
  io("coarse_slip", coarse_slip);
  io("elastic", elastic);
  io("smallest_thickness", smallest_thickness);
  io("elastic_entry", elastic_entry);
  io("elastic_exit", elastic_exit);
  io("elastic_power", elastic_power);
  io("outlet_height", outlet_height);
  io("outlet_stress", outlet_stress);
}

/// One pass by every model that applies.
struct BiteStudy {
  BiteQuestion question;  ///< with the solver that the regime asks for
  bite::Regime regime;
  std::vector<BiteAnswer> answers;  ///< the chosen slab theory first, "fe" last
  std::optional<FlowAnswer> flow;
  std::vector<std::string>
      failures;  ///< of finite elements, one sentence each, in the order in which they were tried
  bite::ArcFlexibility flexibility;  ///< of the roll's section; empty with a rigid arc
  double flexibility_error = 0;      ///< -, of its shape, from two meshes
  std::optional<BiteAnswer> softer;  ///< the chosen slab theory on a section softer by that error; free arc only
  const BiteAnswer *find(const std::string &key) const;  ///< nullptr: not asked, or refused
  const BiteAnswer &slab() const;                        ///< the chosen slab theory
  const BiteAnswer &chosen() const;                      ///< that gives K4
  bool beyond_circle() const;  ///< the chosen answer is on Hitchcock's circle, beyond its range
};

/// Why the rolls cannot carry a pass: no arc does.
Warning no_arc_carries(const std::string &pass, const bite::Regime &regime);

/// Settings of [bite] with what they leave to the regime of the pass.
BiteSetup settled_setup(BiteSetup setup, const bite::Regime &regime);
/// The other strip of the finite elements, for a pass in which those of the settled setup find no answer.
/// @param asked  before it was settled: its elements are those of a rigid-plastic strip
BiteSetup other_strip(const BiteSetup &settled, const BiteSetup &asked);

/// The slab theory of [bite] with its arc, and its key among the answers; on a free arc Karman's, whatever [bite]
/// asks for: no other theory has one.
bite::SlabModel slab_model(const BiteSetup &setup);
std::string slab_key(const BiteSetup &setup);

/// The theories that the chosen one is compared with, with their keys: those that accept this friction, the rigid
/// roll and the free arc.
std::vector<std::pair<std::string, bite::SlabModel>> compared_theories(const BiteQuestion &question);

/// What a theory says of the question of a study, on the section of its roll if it has one.  One that refuses is
/// an answer as well.  Cost: some ms.
BiteAnswer slab_answer(const BiteStudy &study, const std::string &key, const bite::SlabModel &model);

/// Adds what bite_error() of the chosen answer needs in addition to the models that are solved in any case.
void add_for_accuracy(BiteStudy &study);
}  // namespace mill::fem
