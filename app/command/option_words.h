#pragma once
#include <string>
#include <vector>

// Words that options of studies accept, on the command line and in Python.
namespace mill {
inline const std::vector<std::string> study_methods{"grid",  "list",  "latin-hypercube", "monte-carlo",
                                                    "sobol", "chaos", "optimise"},
    study_engines{"here", "parallel", "slurm"}, row_models{"quick", "full"};
}  // namespace mill
