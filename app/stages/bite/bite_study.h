#pragma once
#include "app/run/run_context.h"
#include "fem/strip/bite_answers.h"

namespace mill {
using fem::BiteAnswer;
using fem::BiteQuestion;
using fem::BiteStudy;
using fem::FlowAnswer;

/// Solves one pass.  Where finite elements find no answer those of the other strip are tried, then the slab
/// theories give the values: Karman on a free arc, on Hitchcock's circle, Bland and Ford.
/// @throws InputError   the rolls cannot take the strip, with the numbers
/// @throws SolverError  no theory has an answer
BiteStudy study_bite(RunContext &run, const BiteQuestion &question);

/// What a run will say of a pass for which only finite elements can have an answer, on the half plane; nothing
/// where a slab theory has one.  @throws InputError  a pass that no model takes Cost: one slab, some 5 ms; for
/// such a pass five.
std::optional<Warning> bite_without_theory(const BiteQuestion &question);

/// The model of one answer in words.
std::string model_text(const BiteAnswer &answer);
}  // namespace mill
