#include "app/process/address_space.h"
#include "app/python/long_call.h"
#include "app/python/python_parts.h"
#include "app/python/python_values.h"
#include "app/run/run_setup.h"
#include "app/verbs/roll_pair.h"
#include "core/base/choice.h"
#include "core/numerics/sparse.h"
#include <algorithm>
#include <filesystem>
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <thread>

namespace py = pybind11;

namespace mill::python {
std::string cache_or_usual(const py::object &cache)
{
  CommandLine command;
  if (!cache.is_none())
    command.cache = path_of(cache);
  const std::string folder =
      cache_folder(command, (std::filesystem::temp_directory_path() / "millstand-cache").string());
  std::filesystem::create_directories(folder);
  return folder;
}

int threads_or_all(const int threads)
{
  const int wanted = threads > 0 ? threads : int(std::max(1u, std::thread::hardware_concurrency()));
  return threads_that_start(threads_that_fit(wanted));
}

namespace {
enum class PairHeld { mirrored, in_stand };
constexpr auto words_of(PairHeld)
{
  return choice_words<PairHeld>("mirrored", "in_stand");
}

struct HeldState {
  std::shared_ptr<const PairState> state;
  std::string contact;
};

NamedResult stiffness(const HeldState &s, const char *what, const double value, const char *unit)
{
  Parameter p;
  p.value  = value;
  p.unit   = unit;
  p.method = "contact FEM, " + s.state->reference;
  p.at     = at_force(s.state->load);
  return {"contact." + s.contact + "." + what, p};
}

// A view of a vector of the state, which stays alive with it.
py::array view(const HeldState &s, const Eigen::VectorXd &vector)
{
  auto *share = new std::shared_ptr<const PairState>(s.state);
  const py::capsule owner(share, [](void *held) { delete static_cast<std::shared_ptr<const PairState> *>(held); });
  py::array array(py::dtype::of<double>(), {vector.size()}, {sizeof(double)}, vector.data(), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::array touching(const HeldState &s)
{
  const auto across = py::ssize_t(s.state->nodes_across);
  py::array_t<bool> out({py::ssize_t(s.state->touching.size()) / across, across});
  std::transform(s.state->touching.begin(), s.state->touching.end(), out.mutable_data(),
                 [](const char active) { return active != 0; });
  return std::move(out);
}

HeldState solve(const std::shared_ptr<RollPair> &pair, const std::string &name, const py::handle force,
                const py::handle crown, const py::handle work_crown, const std::string &held)
{
  PairQuestion question;
  question.load       = quantity(force, "force", "976 kN");
  question.crown      = quantity_or(crown, "crown", "150 um", not_given);
  question.work_crown = quantity_or(work_crown, "work_crown", "150 um", not_given);
  const auto how      = choice_named<PairHeld>(held);
  if (!how)
    throw InputError("held = \"" + held + "\" is not known; \"mirrored\" (as K3) or \"in_stand\"");
  question.in_stand = *how == PairHeld::in_stand;
  const py::gil_scoped_release others_run;
  return {std::make_shared<const PairState>(pair->solve(question)), name};
}

struct HeldPair {
  std::shared_ptr<RollPair> pair;
  std::string name;
};

void add_state(py::module_ &module)
{
  const auto profile = [](auto member) {
    return [member](const HeldState &s) { return view(s, s.state->profile.*member); };
  };
  py::class_<HeldState>(module, "PairState", "A roll contact at one load.  Arrays are SI, from mid-length on.")
      .def_property_readonly("tangent",
                             [](const HeldState &s) { return stiffness(s, "tangent", s.state->tangent, "N/m"); })
      .def_property_readonly("secant",
                             [](const HeldState &s) { return stiffness(s, "secant", s.state->secant, "N/m"); })
      .def_property_readonly("approach",
                             [](const HeldState &s) { return stiffness(s, "approach", s.state->approach, "m"); })
      .def_property_readonly("force", [](const HeldState &s) { return stiffness(s, "force", s.state->load, "N"); })
      .def_property_readonly("z", profile(&BarrelProfile::z), "(m) m, stations along the barrel.")
      .def_property_readonly("line_load", profile(&BarrelProfile::line_load), "(m) N/m")
      .def_property_readonly("half_width", profile(&BarrelProfile::half_width), "(m) m")
      .def_property_readonly("peak_pressure", profile(&BarrelProfile::peak_pressure), "(m) Pa")
      .def_property_readonly("touching", &touching,
                             "(m, nodes across) nodes in contact, of one side of the contact line.")
      .def_property_readonly("reference", [](const HeldState &s) { return s.state->reference; });
}
}  // namespace

void add_roll_pair(py::module_ &module, py::class_<HeldCase> &the_case)
{
  add_state(module);
  py::class_<HeldPair>(module, "RollPair", "Two rolls in contact, meshed and condensed once.")
      .def_readonly("name", &HeldPair::name)
      .def_property_readonly(
          "largest_force", [](const HeldPair &p) { return p.pair->largest_load(); }, "N")
      .def(
          "solve",
          [](const HeldPair &p, const py::handle force, const py::handle crown, const py::handle work_crown,
             const std::string &held) { return solve(p.pair, p.name, force, crown, work_crown, held); },
          py::arg("force"), py::arg("crown") = py::none(), py::arg("work_crown") = py::none(),
          py::arg("held") = "mirrored",
          "One load; crown is that of the backup roll.  held: \"mirrored\" (as K3) or \"in_stand\".");
  the_case.def(
      "roll_pair",
      [](const HeldCase &c, const std::string &name, const py::object &largest_force, const py::object &progress,
         const int threads, const py::object &cache) {
        const double largest     = quantity_or(largest_force, "largest_force", "2000 kN", not_given);
        const std::string folder = cache_or_usual(cache);
        const auto read          = c.read();
        return HeldPair{long_call<std::shared_ptr<RollPair>>(progress,
                                                             [=](const Progress &shown) {
                                                               set_blas_threads(1);
                                                               return std::make_shared<RollPair>(
                                                                   read, name, largest, folder,
                                                                   threads_or_all(threads), shown);
                                                             }),
                        name};
      },
      py::arg("name"), py::kw_only(), py::arg("largest_force") = py::none(), py::arg("progress") = py::none(),
      py::arg("threads") = 0, py::arg("cache") = py::none(),
      "The upper or lower roll contact, condensed once; its solve() takes milliseconds.");
}
}  // namespace mill::python
