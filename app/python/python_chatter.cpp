#include "app/chatter/chatter_study.h"
#include "app/python/long_call.h"
#include "app/python/python_parts.h"
#include "app/python/python_values.h"
#include "app/stages/stability/gap_mode.h"
#include "core/base/si_unit.h"
#include "core/records/result_names.h"
#include "dynamics/chatter/growth_map.h"
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <optional>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace mill::python {
namespace {
/// What a case says of its critical speeds.
struct HeldChatter {
  HeldRun run;

  // Of this pass; "": the first of the verdicts, which is the worst, else the first that was asked.
  const AskedSpeed &asked(const std::string &pass) const
  {
    const std::string wanted = !pass.empty() ? pass : run.speeds.empty() ? "" : run.speeds.front().pass;
    std::string known;
    for (const AskedSpeed &one : run.asked) {
      if (wanted.empty() || one.pass == wanted)
        return one;
      known += (known.empty() ? "" : ", ") + one.pass;
    }
    throw InputError(known.empty() ? "no critical speed was searched: " + run.verdict
                                   : "no critical speed was searched of '" + wanted + "'; there are " + known);
  }
  const SpeedVerdict *verdict(const std::string &pass) const
  {
    for (const SpeedVerdict &one : run.speeds)
      if (one.pass == pass)
        return &one;
    return nullptr;
  }
  const NamedResult *result(const std::string &pass, const std::string &name) const
  {
    return run.find(result_name({family::chatter, pass, name}));
  }
};

std::optional<NamedResult> critical_speed(const HeldChatter &chatter, const std::string &pass)
{
  const NamedResult *result = chatter.result(chatter.asked(pass).pass, "critical_speed");
  return result && std::isfinite(result->parameter.value) ? std::optional<NamedResult>(*result) : std::nullopt;
}

py::object metres_per_second(const double value)
{
  return std::isfinite(value) ? py::object(py::float_(value)) : py::none();
}

// Of the verdict; where the run makes none, from the error of the critical speed.
py::object interval(const HeldChatter &chatter, const std::string &pass)
{
  const std::string &name = chatter.asked(pass).pass;
  const auto critical     = critical_speed(chatter, pass);
  if (!critical)
    return py::none();
  if (const SpeedVerdict *verdict = chatter.verdict(name))
    return py::make_tuple(metres_per_second(verdict->low), metres_per_second(verdict->high));
  const double speed = critical->parameter.value, error = critical->parameter.error_estimate;
  return std::isnan(error) ? py::object(py::none()) : py::make_tuple(speed * (1 - error), speed * (1 + error));
}

std::string mode(const HeldChatter &chatter, const std::string &pass)
{
  const AskedSpeed &asked = chatter.asked(pass);
  if (const SpeedVerdict *verdict = chatter.verdict(asked.pass))
    return verdict->mode;
  const auto critical = critical_speed(chatter, pass);
  const auto &q       = asked.question;
  const auto point = dynamics::working_point(q.bite, critical ? critical->parameter.value : asked.speed, q.scheme);
  const auto roots = dynamics::eigenvalues(dynamics::chatter_matrix(q.stand, point.by));
  return text_of_root(q.stand, point.by, roots[0]);
}

dynamics::GrowthMap growth_map(const HeldChatter &chatter, const std::string &x, const std::string &y, const int n,
                               const py::object &x_range, const py::object &y_range, const std::string &pass,
                               const py::object &speed, const int threads)
{
  if (n < 2 || n > 2000)
    throw InputError(fmt::format("a map of n = {} by n cells; n lies between 2 and 2000", n));
  const AskedSpeed asked   = chatter.asked(pass);
  auto question            = asked.question;
  question.bite.roll_speed = quantity_or(speed, "speed", "16 m/s", asked.speed);
  if (!(question.bite.roll_speed > 0))
    throw InputError("the case does not state the speed of '" + asked.pass + "'; give speed=\"16 m/s\"");
  const auto axis = [&](const std::string &word, const py::object &range) {
    const auto quantity_of_axis = dynamics::map_quantity(word);
    if (range.is_none())
      return dynamics::axis_around(question.bite, quantity_of_axis, n);
    const std::string unit = dynamics::unit_of(quantity_of_axis);
    const auto ends        = range.cast<py::tuple>();
    if (ends.size() != 2)
      throw InputError("the range of an axis is a pair, its lower and its upper end");
    const auto end = [&](const py::handle value) {
      return is_in(unit, SiUnit::one) ? value.cast<double>()
                                      : quantity(value, word.c_str(), ("1 " + unit).c_str());
    };
    return bite::MapAxis{quantity_of_axis, Eigen::VectorXd::LinSpaced(n, end(ends[0]), end(ends[1]))};
  };
  const bite::MapAxis rows = axis(x, x_range), columns = axis(y, y_range);
  const int shared = threads_or_all(threads);
  return long_call<dynamics::GrowthMap>(py::none(), [=](const Progress &) {
    return dynamics::growth_map(question.stand, question.bite, question.scheme, rows, columns, shared);
  });
}

void add_map(py::module_ &module)
{
  using dynamics::GrowthMap;
  py::class_<GrowthMap>(module, "StabilityMap", "Growth rate over two quantities of a pass.")
      .def_property_readonly("x", [](const GrowthMap &m) { return m.rows.value; })
      .def_property_readonly("y", [](const GrowthMap &m) { return m.columns.value; })
      .def_property_readonly("x_name", [](const GrowthMap &m) { return dynamics::word_of(m.rows.quantity); })
      .def_property_readonly("y_name", [](const GrowthMap &m) { return dynamics::word_of(m.columns.quantity); })
      .def_property_readonly("x_unit", [](const GrowthMap &m) { return dynamics::unit_of(m.rows.quantity); })
      .def_property_readonly("y_unit", [](const GrowthMap &m) { return dynamics::unit_of(m.columns.quantity); })
      .def_readonly("growth", &GrowthMap::growth, "(n, n) 1/s; above zero it is unstable; nan: no bite")
      .def_readonly("frequency", &GrowthMap::frequency, "(n, n) Hz")
      .def_readonly("reason", &GrowthMap::reason, "(n, n) number of the reason for no bite; -1: there is one")
      .def_readonly("reasons", &GrowthMap::reasons);
}
}  // namespace

void add_chatter(py::module_ &module, py::class_<HeldCase> &the_case)
{
  add_map(module);
  const auto first = [](auto function) { return [function](const HeldChatter &c) { return function(c, ""); }; };
  py::class_<HeldChatter>(module, "Chatter",
                          "Critical speeds of a case; those without an argument are of the worst pass.")
      .def_property_readonly("critical_speed", first(&critical_speed), "None: stable at every speed of the range.")
      .def_property_readonly("interval", first(&interval),
                             "(low, high) in m/s; None: not known, or outside the range that was searched.")
      .def_property_readonly("mode", first(&mode), "\"gap mode at 107 Hz (third octave)\"")
      .def_property_readonly("verdict", [](const HeldChatter &c) { return c.run.verdict; })
      .def_property_readonly("passes",
                             [](const HeldChatter &c) {
                               std::vector<std::string> names;
                               for (const AskedSpeed &one : c.run.asked)
                                 names.push_back(one.pass);
                               return names;
                             })
      .def("critical_speed_of", &critical_speed, py::arg("pass_name"))
      .def("interval_of", &interval, py::arg("pass_name"))
      .def("mode_of", &mode, py::arg("pass_name"))
      .def_readonly("run", &HeldChatter::run)
      .def("map", &growth_map, py::arg("x"), py::arg("y"), py::arg("n") = 50, py::kw_only(),
           py::arg("x_range") = py::none(), py::arg("y_range") = py::none(), py::arg("pass_name") = "",
           py::arg("speed") = py::none(), py::arg("threads") = 0,
           "Growth rate of n by n cells over reduction, friction, entry_tension, exit_tension or roll_speed.");
  the_case.def(
      "chatter",
      [](const HeldCase &c, const py::object &progress, const py::object &out, const int threads, const bool fresh,
         const py::object &cache) {
        // A run of a stand judges the speed of every pass; kind chatter has a verb for it.
        const Verb verb = std::holds_alternative<ChatterCase>(c.read()->spec) ? Verb::chatter : Verb::run;
        return HeldChatter{run_case(c, verb, {progress, out, py::none(), cache, threads, fresh})};
      },
      py::arg("progress") = py::none(), py::kw_only(), py::arg("out") = py::none(), py::arg("threads") = 0,
      py::arg("fresh") = false, py::arg("cache") = py::none(), "Critical speed of every pass or condition.");
}
}  // namespace mill::python
