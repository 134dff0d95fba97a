#include "app/python/python_parts.h"
#include "app/python/python_values.h"
#include "app/stages/response/dynamics_stage.h"
#include "core/case/lumped_model_toml.h"
#include "core/model/case.h"
#include "core/process/memory.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/response.h"
#include <cmath>
#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace mill::python {
namespace {
/// The six masses of a run, with the settings that say what drives them.
struct HeldChain {
  LumpedModel model;
  DynamicsSettings settings;
  dynamics::MillModel chain;
};

HeldChain chain_of(const HeldRun &run)
{
  if (run.chain_text.empty())
    throw InputError(
        "this run has no chain of six masses: the verbs masses, modes and run of kind = \"four-high\" or "
        "\"lumped\" make one");
  const HeldCase written("lumped_model", run.chain_text);
  const auto read = written.read();
  HeldChain held;
  held.model    = lumped_model_of(*read);
  held.settings = std::get<Lumped>(read->spec).dynamics;
  held.chain    = dynamics::mill_model(held.model, held.settings);
  return held;
}

// Samples at `rate`, or a pair of times and forces.
ForceRecord force_record(const py::object &force, const double rate)
{
  const auto numbers = [](const py::handle values) {
    try {
      return values.cast<Eigen::VectorXd>();
    } catch (const py::cast_error &) {
      throw InputError(
          "force is one row of numbers in N, or a pair (times in s, forces in N) of two such rows; a table of "
          "several columns is not");
    }
  };
  ForceRecord record;
  if (py::isinstance<py::tuple>(force) && py::len(force) == 2) {
    record.time  = numbers(force.cast<py::tuple>()[0]);
    record.force = numbers(force.cast<py::tuple>()[1]);
  } else {
    record.force = numbers(force);
    record.time  = Eigen::VectorXd::LinSpaced(record.force.size(), 0, double(record.force.size() - 1) / rate);
  }
  const auto n = record.time.size();
  if (n < 2 || record.force.size() != n)
    throw InputError(
        fmt::format("force has {} values at {} times; two at least of each are needed", record.force.size(), n));
  if (!record.force.allFinite() || !record.time.allFinite() ||
      !((record.time.tail(n - 1) - record.time.head(n - 1)).array() > 0).all())
    throw InputError("force is finite numbers at times that increase");
  return record;
}

std::shared_ptr<const HeldTable> simulated(const HeldChain &held, const ForceRecord &force, const double rate)
{
  const dynamics::Response response = dynamics::mill_response(held.chain, force, rate);
  Table table;
  table.add("time", "s", response.time).add("force", "N", response.force);
  for (std::size_t i = 0; i < response.labels.size(); ++i)
    table.add(response.labels[i], "m/s2", response.acceleration.col(Eigen::Index(i)));
  table.add("load cell", "N", response.load_cell);
  return mill::python::held(table);
}

// A number in Hz, or a quantity.
double hertz_of(const py::handle rate)
{
  double hertz = 0;
  if (py::isinstance<py::float_>(rate) || py::isinstance<py::int_>(rate))
    hertz = rate.cast<double>();
  else if (py::isinstance<py::str>(rate) || py::isinstance<py::tuple>(rate) || py::isinstance<NamedResult>(rate))
    hertz = quantity(rate, "rate", "20 kHz");
  else if (py::hasattr(rate, "__float__"))  // a number of numpy
    hertz = py::float_(py::reinterpret_borrow<py::object>(rate));
  else
    throw InputError("rate = " + py::repr(rate).cast<std::string>() +
                     " is not a rate; a number in Hz or a text is needed, for example \"20 kHz\"");
  if (!(hertz > 0 && std::isfinite(hertz)))
    throw InputError(fmt::format("rate = {:g} Hz must be above 0 Hz and finite", hertz));
  return hertz;
}

void require_memory_for(const HeldChain &held, const ForceRecord &record, const double hertz)
{
  const auto n         = record.time.size();
  const double seconds = record.time[n - 1] - record.time[0];
  // Time, force, load cell and an acceleration of each mass, once as response and once as table.
  const double columns  = 2 * (3 + double(held.chain.labels.size()));
  const double needed   = seconds * hertz * columns * double(sizeof(double));
  const MemoryLeft left = memory_left();
  if (needed > left.bytes)
    throw InputError(fmt::format(
        "the force lasts {:.6g} s; at {:.6g} samples per second the response takes {}, and {} leaves {}; give a "
        "shorter force or a lower rate",
        seconds, hertz, megabytes(needed), left.end, megabytes(left.bytes)));
}

py::object simulate(const HeldChain &held, const py::object &force, const py::handle rate)
{
  const double hertz       = hertz_of(rate);
  const ForceRecord record = force_record(force, hertz);
  require_memory_for(held, record, hertz);
  std::shared_ptr<const HeldTable> table;
  {
    const py::gil_scoped_release others_run;
    table = simulated(held, record, hertz);
  }
  return view_of(table);
}

std::vector<NamedResult> named(const LumpedModel &model, const bool masses)
{
  std::vector<NamedResult> all;
  for (std::size_t i = 0; i < (masses ? model.M.size() : model.K.size()); ++i)
    all.push_back({fmt::format("{}{}", masses ? "M" : "K", i + 1), masses ? model.M[i] : model.K[i]});
  return all;
}

void add_modes(py::module_ &module)
{
  const auto matrix = [](auto member) { return [member](const ChainModes &m) { return m.modes.*member; }; };
  py::class_<ChainModes>(module, "Modes", "Modes of the chain, ascending.")
      .def_property_readonly("frequency", matrix(&dynamics::Modes::frequency), "(n) Hz")
      .def_property_readonly("shape", matrix(&dynamics::Modes::shape), "(n, n) kg^-1/2, one column for each mode")
      .def_property_readonly("strain_share", matrix(&dynamics::Modes::strain_share), "(n, springs)")
      .def_property_readonly("kinetic_share", matrix(&dynamics::Modes::kinetic_share), "(n, n)")
      .def_property_readonly("labels", [](const ChainModes &m) { return m.chain.labels; })
      .def_property_readonly("springs",
                             [](const ChainModes &m) {
                               std::vector<std::string> names;
                               for (const dynamics::Spring &spring : m.chain.springs)
                                 names.push_back(spring.name);
                               return names;
                             })
      .def("__len__", [](const ChainModes &m) { return m.modes.frequency.size(); });
}
}  // namespace

void add_chain(py::module_ &module, py::class_<HeldRun> &run)
{
  add_modes(module);
  py::class_<HeldChain>(module, "Chain", "Six masses: M y'' + C y' + K y = b F.")
      .def_property_readonly(
          "M", [](const HeldChain &c) { return Eigen::MatrixXd(c.chain.M.asDiagonal()); }, "(6, 6) kg")
      .def_property_readonly(
          "K", [](const HeldChain &c) { return c.chain.K; }, "(6, 6) N/m")
      .def_property_readonly(
          "C", [](const HeldChain &c) { return c.chain.C; }, "(6, 6) N s/m")
      .def_property_readonly(
          "b", [](const HeldChain &c) { return c.chain.b; }, "(6) force on each mass")
      .def_property_readonly("labels", [](const HeldChain &c) { return c.chain.labels; })
      .def_property_readonly(
          "masses", [](const HeldChain &c) { return named(c.model, true); }, "M1..M6")
      .def_property_readonly(
          "springs", [](const HeldChain &c) { return named(c.model, false); }, "K1..K7")
      .def("modes", [](const HeldChain &c) { return chain_modes(c.model, c.settings); })
      .def("simulate", &simulate, py::arg("force"), py::arg("rate") = 20e3,
           "Accelerations under a force in N: samples at `rate` (Hz), or (times, forces).");
  run.def_property_readonly("chain", &chain_of, "The chain of the first pass.");
}
}  // namespace mill::python
