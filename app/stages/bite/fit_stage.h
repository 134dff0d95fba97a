#pragma once
#include "app/run/run_context.h"
#include "core/model/bite_setup.h"
#include "core/model/pass.h"
#include "core/model/strip.h"
#include "core/records/key_list.h"
#include "reduce/bite/fit/identify.h"
#include <vector>

namespace mill {
struct BiteCase;
struct FourHigh;

/// The passes of a case whose strip is to be fitted.
struct FitQuestion {
  Strip strip;
  BiteSetup setup;
  std::vector<Pass> passes;
  std::vector<double> loads;  ///< N, by pass; nan: not measured
  double roll_diameter = 0;   ///< m
  Material steel;             ///< of the rolls
  std::string roll_key;       ///< "work_roll.barrel_diameter"
};
FitQuestion fit_question(const BiteCase &spec);
FitQuestion fit_question(const FourHigh &stand, const std::vector<double> &loads);

/// What the slab makes of the measured values, without the model of the run.
bite::FitProblem fit_problem(const FitQuestion &question);
bool one_number_only(const BiteSetup &setup);

/// A fit with what brought it about.
struct StripFit {
  FitQuestion question;
  bite::FitAnswer slab;             ///< by the slab alone
  bite::FitAnswer answer;           ///< by the model of the run, through its distance to the slab
  std::vector<std::string> models;  ///< of the run, by pass; empty: the slab itself
  std::string uncorrected;          ///< why the model of the run was not used; empty: it was used
  Strip strip;                      ///< fitted
  KeyList inputs;                   ///< keys behind all of it
};

/// Friction and flow stress of [strip] by bite.fit, with results bite.fit.* and sentences on what the data do not
/// determine; the strip as it is where no fit is asked.
/// @throws InputError   passes that no friction and no flow stress makes possible
/// @throws SolverError  no least misfit, or the model of the run does not settle on the measured values
Strip fitted_strip(RunContext &run, const FitQuestion &question);

/// By the slab alone, for a trace; the strip as it is where no fit is asked or possible.
Strip quickly_fitted_strip(const FitQuestion &question);
}  // namespace mill
