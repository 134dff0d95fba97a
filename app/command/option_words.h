#pragma once
#include "core/base/choice.h"

// What options accept, on the command line and in Python.
namespace mill {
enum class StudyMethod { grid, list, latin_hypercube, monte_carlo, sobol, chaos, optimise };
constexpr auto words_of(StudyMethod)
{
  return choice_words<StudyMethod>("grid", "list", "latin-hypercube", "monte-carlo", "sobol", "chaos", "optimise");
}

/// What `millstand study` does.
enum class StudyAction { new_study, run, work, status, merge, report };
constexpr auto words_of(StudyAction)
{
  return choice_words<StudyAction>("new", "run", "work", "status", "merge", "report");
}

/// What `millstand stack` does.
enum class StackAction { optimise };
constexpr auto words_of(StackAction)
{
  return choice_words<StackAction>("optimise");
}

/// What starts the workers of a study.
enum class StudyEngine { here, parallel, slurm };
constexpr auto words_of(StudyEngine)
{
  return choice_words<StudyEngine>("here", "parallel", "slurm");
}

/// What computes the rows of a study or sweep.
enum class ModelKind {
  quick,  ///< closed forms of trace
  full    ///< as `run`
};
constexpr auto words_of(ModelKind)
{
  return choice_words<ModelKind>("quick", "full");
}

/// What `millstand export` writes.
enum class ExportFormat { fmu, modelica, matlab, statespace };
constexpr auto words_of(ExportFormat)
{
  return choice_words<ExportFormat>("fmu", "modelica", "matlab", "statespace");
}
}  // namespace mill
