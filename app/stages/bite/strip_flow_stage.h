#pragma once
#include "app/stages/bite/bite_study.h"

namespace mill {
/// What the finite-element bite needs to know.
struct FlowQuestion {
  bite::RollBite bite;
  BiteSetup setup;
  std::string pass;
};

/// Everything that a finite-element bite depends on, as text; its hash is the key of the cache.
/// @param flexibility  of the roll's section; nullptr: a circle or a rigid roll
std::string flow_inputs(const FlowQuestion &question, const bite::ArcFlexibility *flexibility);

/// Solves a bite by finite elements on the wanted mesh and on a coarser one, or takes both from the cache.
/// @throws SolverError  no convergence; the last converged level is part of the message
FlowAnswer solve_flow(RunContext &run, const FlowQuestion &question, const bite::ArcFlexibility *flexibility);

/// One point of a curve.
struct FlowPoint {
  double force         = 0;  ///< N
  double plastic_slope = 0;  ///< N/m, arc held
};
template <class Io, class R, if_record<R, FlowPoint> = 0> void each_member(Io &&io, R &record)
{
  auto &[force, plastic_slope] = record;
  io("force", force);
  io("plastic_slope", plastic_slope);
}

/// Rigid-plastic strips on the one mesh of each question and on a circle, from the cache or solved side by side on
/// all threads; nothing where no pass needs them.
std::vector<std::optional<FlowPoint>> solve_flow_points(RunContext &run,
                                                        const std::vector<FlowQuestion> &questions);
}  // namespace mill
