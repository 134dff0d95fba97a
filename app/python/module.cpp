#include "app/chatter/chatter_stage.h"
#include "app/command/linked_subjects.h"
#include "app/process/version.h"
#include "app/python/long_call.h"
#include "app/python/python_case.h"
#include "app/python/python_errors.h"
#include "app/python/python_parts.h"
#include "app/python/python_results.h"
#include "app/python/python_run.h"
#include "app/run/run_kind.h"
#include <pybind11/pybind11.h>

namespace mill {
// Every kind and the chatter of a stand; verbs are functions here and no commands.
const LinkedSubjects linked_subjects{chatter_kind, cluster_kind, solve_stand_chatter, nullptr};
}  // namespace mill

PYBIND11_MODULE(_millstand, module)
{
  using namespace mill::python;
  module.doc()               = "The functions of millstand; the package millstand is the door.";
  module.attr("__version__") = mill::version();
  register_errors();
  add_results(module);
  auto the_case = add_case(module);
  auto run      = add_run(module, the_case);
  add_roll_pair(module, the_case);
  add_bearing(module, the_case);
  add_chain(module, run);
  add_chatter(module, the_case);
  add_commands(module);
  module.def("_finish_left_work", &finish_left_work);
}
