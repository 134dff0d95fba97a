#include "dynamics/exchange/state_space_files.h"
#include "core/records/matrix_market.h"
#include <fmt/format.h>

namespace mill::dynamics {
namespace {
std::string csv_of(const Eigen::MatrixXd &matrix)
{
  std::string text;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      text += fmt::format("{}{}", j == 0 ? "" : ",", matrix(i, j));
    text += '\n';
  }
  return text;
}

// A field of CSV with commas in it.
std::string csv_field(const std::string &text)
{
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"')
      out += '"';
    out += c;
  }
  return out + "\"";
}

std::string rows_of(const char *what, const std::vector<Signal> &signals)
{
  std::string text;
  for (std::size_t i = 0; i < signals.size(); ++i)
    text +=
        fmt::format("{},{},{},{},{}\n", what, i + 1, signals[i].name, signals[i].unit, csv_field(signals[i].text));
  return text;
}

std::string signal_rows(const ExchangedStand &stand)
{
  return "of,index,name,unit,meaning\n" + rows_of("state", states_of(stand)) +
         rows_of("input", {input_of(stand)}) + rows_of("output", outputs_of(stand));
}

std::string about_text(const ExchangedStand &stand)
{
  std::string text = fmt::format(
      "{}\n{}\n{}, written by {}\n\n"
      "x' = A x + B u,  y = C x + D u.  States x (names.csv) are the displacements, then their rates; the input u "
      "is\n"
      "the {}, less its mean {} N.\nDisplacements count from the state of rest under the mean. Rest in the "
      "equilibrium "
      "under a first input u0: A x0 = -B u0.\n"
      "A mixes entries of 1 and of stiffness over mass: balance it before eigenvalues or exponentials are taken.\n"
      "*.csv hold numbers alone, one row a line; *.mtx are the same in Matrix Market form.\n\n",
      stand.title, stand.origin, stand.method, stand.program, stand.force_text, stand.mean_force);
  for (const auto &[name, from] : stand.source)
    text += name + ": " + from + "\n";
  return text;
}
}  // namespace

std::vector<NamedText> state_space_files(const ExchangedStand &stand)
{
  const StateSpace form = first_order_form(stand);
  std::vector<NamedText> files{
      {"about.txt", about_text(stand)},
      {"names.csv", signal_rows(stand)},
  };
  const auto add = [&](const char *name, const Eigen::MatrixXd &matrix, const char *what) {
    files.push_back({std::string(name) + ".csv", csv_of(matrix)});
    files.push_back(
        {std::string(name) + ".mtx",
         matrix_market_text(matrix, fmt::format("{} of x' = A x + B u, y = C x + D u: {}", name, what))});
  };
  add("A", form.A, "states by states, SI, names.csv");
  add("B", form.B, "states by input");
  add("C", form.C, "outputs by states");
  add("D", form.D, "outputs by input");
  return files;
}
}  // namespace mill::dynamics
