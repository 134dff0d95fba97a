#include "dynamics/exchange/modelica.h"
#include "core/base/text.h"
#include "core/records/chain_number.h"
#include <cmath>
#include <fmt/format.h>

namespace mill::dynamics {
namespace {
using Eigen::Index;

std::string number(const double value)
{
  const std::string text = fmt::format("{}", value);  // shortest text that gives the number back; no locale
  // Without a point it would be an Integer, which ends at 2^31.
  return has_any(text, ".e") ? text : text + ".0";
}

// A text of Modelica in its quotes.
std::string quoted(const std::string &text)
{
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out + "\"";
}

std::string list_of(const Eigen::VectorXd &values)
{
  std::string text;
  for (const double value : values)
    text += (text.empty() ? "" : ", ") + number(value);
  return "{" + text + "}";
}

std::string table_of(const Eigen::MatrixXd &values)
{
  std::string text;
  for (Index i = 0; i < values.rows(); ++i)
    text += (i == 0 ? "\n      " : ",\n      ") + list_of(values.row(i).transpose());
  return "{" + text + "}";
}

std::string words_of(std::string identifier)
{
  for (char &c : identifier)
    c = c == '_' ? ' ' : c;
  return identifier;
}

std::string source_of(const ExchangedStand &stand, const std::string &name, const std::string &what)
{
  const auto entry = stand.source.find(name);
  return quoted(what + (entry == stand.source.end() ? "" : " (" + entry->second + ")"));
}

std::string scalar(const ExchangedStand &stand, const char *name, const char *unit, const double value,
                   const std::string &what)
{
  return fmt::format("    parameter Real {}(unit=\"{}\") = {} {};\n", name, unit, number(value),
                     source_of(stand, name, what));
}

std::string end_of(const ExchangedStand &stand, const int mass)
{
  return mass == ground ? "ground" : words_of(stand.unknowns[std::size_t(mass)]);
}

// M1.. and K1.. with where each comes from: both forms of a chain begin with them.
std::string chain_parameters(const ExchangedStand &stand)
{
  std::string text;
  for (Index i = 0; i < stand.b.size(); ++i)
    text += scalar(stand, fmt::format("M{}", i + 1).c_str(), "kg", stand.M(i, i),
                   "mass of the " + words_of(stand.unknowns[std::size_t(i)]));
  for (const Spring &spring : stand.springs)
    text += scalar(stand, spring.name.c_str(), "N/m", spring.stiffness,
                   "stiffness between " + end_of(stand, spring.from) + " and " + end_of(stand, spring.to));
  return text + scalar(stand, "F_mean", "N", stand.mean_force,
                       "mean rolling force: displacements count from the state of rest under it");
}

// The stiffness matrix in its springs, so that a spring that is changed changes it.
std::string stiffness_table(const ExchangedStand &stand)
{
  const int n      = int(stand.b.size());
  const auto entry = [&](const int i, const int j) {
    std::string text;
    for (const Spring &spring : stand.springs) {
      const bool at_i = spring.from == i || spring.to == i, at_j = spring.from == j || spring.to == j;
      if (at_i && at_j)
        text += i == j ? (text.empty() ? "" : " + ") + spring.name : (text.empty() ? "-" : " - ") + spring.name;
    }
    return text.empty() ? std::string("0") : text;
  };
  std::string text;
  for (int i = 0; i < n; ++i) {
    text += i == 0 ? "\n      {" : ",\n      {";
    for (int j = 0; j < n; ++j)
      text += (j == 0 ? "" : ", ") + entry(i, j);
    text += "}";
  }
  return "{" + text + "}";
}

std::string numbered(const char *letter, const Index n)
{
  std::string text;
  for (Index i = 0; i < n; ++i)
    text += fmt::format("{}{}{}", i == 0 ? "" : ", ", letter, i + 1);
  return "{" + text + "}";
}

std::string outputs(const ExchangedStand &stand)
{
  std::string text;
  for (const std::string &point : stand.points)
    text += fmt::format("    output Real a_{}(unit=\"m/s2\") {};\n", point,
                        quoted("acceleration of the " + words_of(point) + ", up positive"));
  for (std::size_t j = 0; j < stand.points.size(); ++j)
    text += fmt::format("    output Real y_{}(unit=\"m\") {};\n", stand.points[j],
                        quoted("displacement of the " + words_of(stand.points[j]) +
                               ", up positive, from the state of rest under F_mean"));
  return text + "    output Real F_cell(unit=\"N\") "
                "\"force on the load cell, compression positive, with its share of F_mean\";\n";
}

std::string input(const ExchangedStand &stand)
{
  return fmt::format("    input Real F(unit=\"N\", start={}) {};\n", number(stand.mean_force),
                     quoted(stand.force_text));
}

std::string chain_equations(const ExchangedStand &stand)
{
  const Index n = stand.b.size();
  std::string text =
      "  model Equations \"the chain of masses as equations: diag(M) a + C v + K y = b (F - F_mean)\"\n";
  text += chain_parameters(stand);
  text +=
      fmt::format("    parameter Real M[{0}](each unit=\"kg\") = {1} \"masses\";\n"
                  "    parameter Real K[{0},{0}](each unit=\"N/m\") = {2} \"stiffness matrix of the springs\";\n",
                  n, numbered("M", n), stiffness_table(stand));
  text += fmt::format(
      "    parameter Real C[{0},{0}](each unit=\"N.s/m\") = {1}\n      {2};\n", n, table_of(stand.C),
      quoted(fmt::format(
          "damping matrix: {} of critical in every mode of the masses and springs above as they were "
          "exported{}",
          stand.modal_damping,
          stand.gap_damper > 0 ? fmt::format(", and {} N.s/m between the work rolls", stand.gap_damper) : "")));
  text += fmt::format("    parameter Real b[{}] = {} \"force on each mass per rolling force\";\n", n,
                      list_of(stand.b));
  text += fmt::format(
      "    parameter Real L[{}](each unit=\"N/m\") = {} \"force on the load cell per displacement\";\n", n,
      list_of(stand.load_cell));
  text += fmt::format("    parameter Real cell_share = {} \"part of F_mean that the load cell shows\";\n",
                      number(stand.load_cell_share));
  text += input(stand) + outputs(stand);
  text += fmt::format("    Real y[{0}](each unit=\"m\", each nominal=1e-6) \"displacements\";\n"
                      "    Real v[{0}](each unit=\"m/s\", each nominal=1e-3) \"velocities\";\n"
                      "  initial equation\n"
                      "    K * y = b * (F - F_mean) \"at rest in the equilibrium under the first force\";\n"
                      "    v = zeros({0});\n"
                      "  equation\n"
                      "    der(y) = v;\n"
                      "    for i in 1:{0} loop\n"
                      "      M[i] * der(v[i]) = b[i] * (F - F_mean) - C[i, :] * v - K[i, :] * y;\n"
                      "    end for;\n",
                      n);
  for (std::size_t j = 0; j < stand.points.size(); ++j)
    text += fmt::format("    a_{0} = der(v[{1}]);\n    y_{0} = y[{1}];\n", stand.points[j], j + 1);
  return text + "    F_cell = cell_share * F_mean + L * y;\n  end Equations;\n";
}

std::string modal_equations(const ExchangedStand &stand)
{
  const Index n = stand.b.size(), m = stand.point.rows();
  std::string text = "  model Equations \"the stand in its modes: q'' + 2 zeta omega q' + omega^2 q = b (F - "
                     "F_mean - C_gap b q')\"\n";
  text += scalar(stand, "F_mean", "N", stand.mean_force,
                 "mean rolling force: displacements count from the state of rest under it");
  text += scalar(stand, "modal_damping", "1", stand.modal_damping, "damping of every mode, ratio of critical");
  text += scalar(stand, "C_gap", "N.s/m", stand.gap_damper, "damper between the work rolls");
  text += fmt::format("    parameter Real omega[{}](each unit=\"rad/s\") = {} \"natural frequencies\";\n", n,
                      list_of(2 * M_PI * stand.frequency));
  text += fmt::format("    parameter Real b[{}] = {} \"rolling force on each mass-normalised mode, kg^-1/2\";\n",
                      n, list_of(stand.b));
  text += fmt::format("    parameter Real P[{},{}] = {} \"points in the modes, kg^-1/2\";\n", m, n,
                      table_of(stand.point));
  text += fmt::format("    parameter Real L[{}] = {} \"force on the load cell in each mode, N/m kg^-1/2\";\n", n,
                      list_of(stand.load_cell));
  const bool films = stand.dampers.rows() > 0;
  if (films)
    text += fmt::format("    parameter Real D[{},{}] = {} \"dampers of the oil films in the modes: D' D is their "
                        "damping matrix\";\n",
                        stand.dampers.rows(), n, table_of(stand.dampers));
  text += fmt::format("    parameter Real cell_share = {} \"part of F_mean that the load cell shows\";\n",
                      number(stand.load_cell_share));
  text += input(stand) + outputs(stand);
  if (films)
    text += fmt::format("    Real r[{}] \"rates of the films, times the root of each damper\";\n",
                        stand.dampers.rows());
  text +=
      fmt::format("    Real q[{0}](each nominal=1e-4) \"modal displacements, m kg^1/2\";\n"
                  "    Real p[{0}](each nominal=1e-2) \"modal velocities, m/s kg^1/2\";\n"
                  "    Real a[{1}](each unit=\"m/s2\") \"accelerations of the points\";\n"
                  "    Real y[{1}](each unit=\"m\") \"displacements of the points\";\n"
                  "  initial equation\n"
                  "    for k in 1:{0} loop\n"
                  "      omega[k]^2 * q[k] = b[k] * (F - F_mean);\n"
                  "    end for;\n"
                  "    p = zeros({0});\n"
                  "  equation\n"
                  "    der(q) = p;\n"
                  "    for k in 1:{0} loop\n"
                  "      der(p[k]) = b[k] * (F - F_mean - C_gap * (b * p)) - 2 * modal_damping * omega[k] * p[k]\n"
                  "        - omega[k]^2 * q[k]{2};\n"
                  "    end for;\n"
                  "    y = P * q;\n"
                  "    a = P * der(p);\n",
                  n, m, films ? " - D[:, k] * r" : "");
  if (films)
    text += "    r = D * p;\n";
  for (std::size_t j = 0; j < stand.points.size(); ++j)
    text += fmt::format("    a_{0} = a[{1}];\n    y_{0} = y[{1}];\n", stand.points[j], j + 1);
  return text + "    F_cell = cell_share * F_mean + L * q;\n  end Equations;\n";
}

std::string component_of(const ExchangedStand &stand, const int mass)
{
  return mass == ground ? "ground.flange" : stand.unknowns[std::size_t(mass)] + ".flange_b";
}

// Force of the load cell in the force of its spring, f = c (s_b - s_a).
std::string cell_of(const ExchangedStand &stand)
{
  for (const Spring &spring : stand.springs) {
    Eigen::VectorXd pull = Eigen::VectorXd::Zero(stand.b.size());
    if (spring.from != ground)
      pull[spring.from] = -spring.stiffness;
    if (spring.to != ground)
      pull[spring.to] = spring.stiffness;
    for (const double sign : {1., -1.})
      if (spring.stiffness > 0 && stand.load_cell == sign * pull)
        return fmt::format("{} spring_{}.c * spring_{}.s_rel", sign > 0 ? "+" : "-", spring.name, spring.name);
  }
  return "";
}

std::string components(const ExchangedStand &stand)
{
  const std::string library = "Modelica.Mechanics.Translational.";
  const double share        = stand.modal_damping / (M_PI * stand.leading_frequency);  // 2 zeta / omega
  std::string text =
      "  model Components \"the chain drawn with the Modelica Standard Library, to go on drawing\"\n";
  text += chain_parameters(stand);
  text += fmt::format(
      "    parameter Real relaxation(unit=\"s\") = {} {};\n", number(share),
      quoted(fmt::format(
          "damper over stiffness of every spring: {} of critical at {} Hz, the mode that yields most under "
          "the rolling force, and in proportion to the frequency elsewhere; Equations has the same ratio "
          "in every mode",
          stand.modal_damping, stand.leading_frequency)));
  text += fmt::format("    parameter Real C_gap(unit=\"N.s/m\") = {} {};\n", number(stand.gap_damper),
                      source_of(stand, "C", "damper between the work rolls"));
  text += fmt::format("    parameter Real cell_share = {} \"part of F_mean that the load cell shows\";\n",
                      number(stand.load_cell_share));
  text += input(stand) + outputs(stand);
  text += "    " + library + "Components.Fixed ground(s0=0);\n";
  for (std::size_t i = 0; i < stand.unknowns.size(); ++i)
    text += fmt::format("    {}Components.Mass {}(m=M{}, L=0, s(start=0, fixed=true), v(start=0, fixed=true));\n",
                        library, stand.unknowns[i], i + 1);
  for (const Spring &spring : stand.springs)
    text += fmt::format("    {}Components.SpringDamper spring_{}(c={}, d=relaxation * {}{}, s_rel0=0);\n", library,
                        spring.name, spring.name, spring.name,
                        spring.name == word_of(ChainNumber::K4) ? " + C_gap"
                        : spring.damper > 0                     ? " + " + number(spring.damper)
                                                                : "");
  text += "    " + library + "Sources.Force2 bite \"pushes the work rolls apart\";\n  equation\n";
  for (const Spring &spring : stand.springs)
    text +=
        fmt::format("    connect({}, spring_{}.flange_a);\n    connect(spring_{}.flange_b, {});\n",
                    component_of(stand, spring.from), spring.name, spring.name, component_of(stand, spring.to));
  text += fmt::format("    connect(bite.flange_a, {}.flange_a);\n    connect(bite.flange_b, {}.flange_a);\n",
                      stand.unknowns[lower_work_roll], stand.unknowns[upper_work_roll]);
  text += "    bite.f = F - F_mean;\n";
  for (std::size_t j = 0; j < stand.points.size(); ++j)
    text += fmt::format("    a_{0} = {0}.a;\n    y_{0} = {0}.s;\n", stand.points[j]);
  return text + "    F_cell = cell_share * F_mean " + cell_of(stand) + ";\n  end Components;\n";
}

// An input that is not a connector is given where its component is declared (Modelica 3.4, 4.4.2.2).
std::string step_test(const ExchangedStand &stand)
{
  std::string text = "  model ForceStep \"test: the rolling force jumps once\"\n";
  text += fmt::format("    parameter Real step(unit=\"N\") = {} \"jump of the force\";\n"
                      "    parameter Real F_mean(unit=\"N\") = {} \"mean rolling force\";\n"
                      "    Equations stand(F_mean = F_mean, F = F_mean + (if time < {} then 0 else step));\n"
                      "    discrete Real largest_upper(start=0, fixed=true) \"largest acceleration of the upper "
                      "work roll, m/s2\";\n"
                      "    discrete Real largest_lower(start=0, fixed=true) \"largest acceleration of the lower "
                      "work roll, m/s2\";\n"
                      "  equation\n"
                      "    when sample(0, {}) then\n"
                      "      largest_upper = max(pre(largest_upper), abs(stand.a_{}));\n"
                      "      largest_lower = max(pre(largest_lower), abs(stand.a_{}));\n"
                      "    end when;\n",
                      number(stand.step_force), number(stand.mean_force), number(step_test_begin),
                      number(0.1 * stand.step), stand.points[upper_work_roll], stand.points[lower_work_roll]);
  text += fmt::format("    // Expected at the end: largest_upper = {:.6g} m/s2, largest_lower = {:.6g} m/s2.\n",
                      stand.step_peak[0], stand.step_peak[1]);
  return text + fmt::format("    annotation(experiment(StartTime=0, StopTime={}, Interval={}, Tolerance=1e-9));\n"
                            "  end ForceStep;\n",
                            number(step_test_end), number(stand.step));
}

std::string recorded(const ExchangedStand &stand, const std::string &series_file)
{
  const ForceRecord &force = stand.series;
  const Index n            = force.time.size();
  if (n == 0)
    return "";
  std::string text = "  model Recorded \"the stand under the recorded force, linear between its samples\"\n";
  std::string table;
  if (n > longest_series_in_package) {
    text += fmt::format("    parameter String force_file = Modelica.Utilities.Files.loadResource({})\n"
                        "      \"text table of CombiTimeTable, in the folder of this package\";\n",
                        quoted("modelica://" + stand.name + "/" + series_file));
    table = "tableOnFile=true, tableName=\"force\", fileName=force_file, columns={2}";
  } else {
    for (Index i = 0; i < n; ++i)
      table += fmt::format("{}\n      {}, {}", i == 0 ? "" : ";", number(force.time[i]), number(force.force[i]));
    table = "table=[" + table + "], columns={2}";
  }
  text += "    Modelica.Blocks.Sources.CombiTimeTable force(" + table +
          ",\n      smoothness=Modelica.Blocks.Types.Smoothness.LinearSegments,\n"
          "      extrapolation=Modelica.Blocks.Types.Extrapolation.HoldLastPoint);\n"
          "    Equations stand(F = force.y[1]);\n";
  return text + fmt::format("    annotation(experiment(StartTime={}, StopTime={}, Interval={}, Tolerance=1e-7));\n"
                            "  end Recorded;\n",
                            number(force.time[0]), number(force.time[n - 1]), number(stand.step));
}
}  // namespace

std::string modelica_package(const ExchangedStand &stand, const std::string &series_file)
{
  const bool uses_library = !stand.modal || stand.series.time.size() > 0;
  std::string text        = "within ;\n";
  text += fmt::format(
      "package {} {}\n", stand.name,
      quoted(stand.title + ": " + stand.method + ", " + stand.origin + ", written by " + stand.program));
  text += stand.modal ? modal_equations(stand) : chain_equations(stand) + "\n" + components(stand);
  text += "\n" + step_test(stand);
  if (const std::string model = recorded(stand, series_file); !model.empty())
    text += "\n" + model;
  if (uses_library)
    text += "\n  annotation(uses(Modelica(version=\"4.0.0\")));\n";
  return text + "end " + stand.name + ";\n";
}

std::string modelica_series(const ForceRecord &force)
{
  std::string text = fmt::format("#1\n# time in s, rolling force in N\ndouble force({}, 2)\n", force.time.size());
  for (Index i = 0; i < force.time.size(); ++i)
    text += fmt::format("{} {}\n", force.time[i], force.force[i]);
  return text;
}
}  // namespace mill::dynamics
