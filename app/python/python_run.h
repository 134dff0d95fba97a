#pragma once
#include "app/python/python_case.h"
#include "app/python/python_results.h"
#include "app/run/asked_speeds.h"
#include "core/records/speed_verdict.h"
#include <memory>
#include <string>
#include <vector>

namespace mill::python {
/// A run that has ended: its results, its tables and, until it goes, its folder.
struct HeldRun {
  HeldCase the_case;
  std::string verb;
  std::vector<NamedResult> results;
  std::vector<Warning> warnings;
  std::vector<std::string> assumptions;
  std::string verdict, summary;
  HeldTables tables;                             ///< by path in the folder without ending
  std::string chain_text;                        ///< lumped_model.toml; empty: the run made no chain
  std::string folder;                            ///< published there; empty: came out of a pickle
  std::vector<SpeedVerdict> speeds;              ///< the worst first; empty: came out of a pickle
  std::vector<AskedSpeed> asked;                 ///< critical speeds that were searched
  std::shared_ptr<const ScratchFolder> scratch;  ///< what `folder` is, where the user named none

  const NamedResult *find(const std::string &name) const;  ///< nullptr: absent
};

/// How a case is run.
struct RunWishes {
  pybind11::object progress = pybind11::none(), out = pybind11::none(), force = pybind11::none(),
                   cache = pybind11::none();
  int threads            = 0;
  bool fresh             = false;
};
HeldRun run_case(const HeldCase &the_case, Verb verb, const RunWishes &wishes);
/// @throws KeyError  no result of this name, with the nearest one
const NamedResult &result_named(const HeldRun &run, const std::string &name);

/// The verbs of a case, and the class Run.
pybind11::class_<HeldRun> add_run(pybind11::module_ &module, pybind11::class_<HeldCase> &the_case);
}  // namespace mill::python
