#include "tests/support/modelica_text.h"
#include <cmath>
#include <set>
#include <stdexcept>

namespace modelica {
namespace {
Eigen::MatrixXd scalar(const double x)
{
  return Eigen::MatrixXd::Constant(1, 1, x);
}

// Vectors of equal length are multiplied to their scalar product.
Eigen::MatrixXd product(const Eigen::MatrixXd &a, const Eigen::MatrixXd &b)
{
  if (a.size() == 1)
    return a(0, 0) * b;
  if (b.size() == 1)
    return b(0, 0) * a;
  if (a.cols() == 1 && b.cols() == 1)
    return a.transpose() * b;
  return a * b;
}

Eigen::MatrixXd indexed(const Expression &e, const Values &values)
{
  const Eigen::MatrixXd whole = value_of(e.of[0], values);
  const auto range            = [&](const std::size_t i, const Eigen::Index size) {
    if (e.of[i].what == "all")
      return std::pair<Eigen::Index, Eigen::Index>{0, size};
    const auto k = Eigen::Index(value_of(e.of[i], values)(0, 0)) - 1;
    if (k < 0 || k >= size)
      throw std::runtime_error("an index is out of range");
    return std::pair<Eigen::Index, Eigen::Index>{k, 1};
  };
  const auto [row, rows] = range(1, whole.rows());
  if (e.of.size() == 2)
    return whole.middleRows(row, rows);
  const auto [column, columns] = range(2, whole.cols());
  const Eigen::MatrixXd part   = whole.block(row, column, rows, columns);
  return rows == 1 ? Eigen::MatrixXd(part.transpose()) : part;  // a row of a matrix is a vector
}

Eigen::MatrixXd called(const Expression &e, const Values &values)
{
  if (e.text == "der") {
    Expression lookup = e.of.at(0);
    Expression &whole = lookup.what == "index" ? lookup.of[0] : lookup;
    whole.text        = "der(" + whole.text + ")";
    return value_of(lookup, values);
  }
  if (e.text == "zeros")
    return Eigen::MatrixXd::Zero(Eigen::Index(value_of(e.of.at(0), values)(0, 0)), 1);
  throw std::runtime_error("the function " + e.text + " is not known here");
}

void names_in(const Expression &e, std::set<std::string> &names)
{
  if (e.what == "name")
    names.insert(e.text.substr(0, e.text.find('.')));
  for (const Expression &part : e.of)
    names_in(part, names);
}
}  // namespace

Eigen::MatrixXd value_of(const Expression &e, const Values &values)
{
  if (e.what == "number")
    return scalar(e.number);
  if (e.what == "name") {
    const auto value = values.find(e.text);
    if (value == values.end())
      throw std::runtime_error(e.text + " has no value");
    return value->second;
  }
  if (e.what == "array" || e.what == "table") {
    Eigen::MatrixXd all;
    for (std::size_t i = 0; i < e.of.size(); ++i) {
      const Eigen::MatrixXd one = value_of(e.of[i], values);
      if (i == 0)
        all.resize(Eigen::Index(e.of.size()), one.size());
      if (one.size() != all.cols())
        throw std::runtime_error("rows of an array differ in length");
      all.row(Eigen::Index(i)) = Eigen::Map<const Eigen::RowVectorXd>(one.data(), one.size());
    }
    return all;
  }
  if (e.what == "index")
    return indexed(e, values);
  if (e.what == "call")
    return called(e, values);
  const Eigen::MatrixXd a = value_of(e.of.at(0), values);
  if (e.what == "if")
    return value_of(e.of.at(a(0, 0) != 0 ? 1 : 2), values);
  if (e.what == "negative")
    return -a;
  const Eigen::MatrixXd b = value_of(e.of.at(1), values);
  if (e.what == "*")
    return product(a, b);
  if (e.what == "/")
    return a / b(0, 0);
  if (e.what == "<")
    return scalar(a(0, 0) < b(0, 0) ? 1 : 0);
  if (e.what == "^")
    return scalar(std::pow(a(0, 0), b(0, 0)));
  if (a.rows() != b.rows() || a.cols() != b.cols())
    throw std::runtime_error("terms of a sum differ in size");
  if (e.what == "+")
    return a + b;
  if (e.what == "-")
    return a - b;
  throw std::runtime_error("the operator " + e.what + " is not known here");
}

Values parameters_of(const Class &model)
{
  Values values;
  for (const std::string &name : model.order) {
    const Component &component = model.components.at(name);
    if (!component.value || component.value->what == "text")
      continue;
    values[name]     = value_of(*component.value, values);
    const auto sizes = component.dimensions.size();
    for (std::size_t d = 0; d < sizes; ++d) {
      const double wanted = value_of(component.dimensions[d], values)(0, 0);
      const auto is       = d == 0 ? values[name].rows() : values[name].cols();
      if (double(is) != wanted)
        throw std::runtime_error(name + " has another size than it declares");
    }
  }
  return values;
}

std::vector<std::string> undeclared(const Class &model)
{
  std::set<std::string> used{};
  for (const auto *equations : {&model.equations, &model.initial_equations})
    for (const Equation &e : *equations) {
      names_in(e.left, used);
      names_in(e.right, used);
    }
  for (const auto &[from, to] : model.connections) {
    used.insert(from.substr(0, from.find('.')));
    used.insert(to.substr(0, to.find('.')));
  }
  for (const auto &[name, component] : model.components) {
    if (component.value)
      names_in(*component.value, used);
    for (const auto &[key, value] : component.modifiers)
      names_in(value, used);
  }
  std::vector<std::string> missing;
  for (const std::string &name : used)
    if (!model.components.count(name) && name != "time" && name != "Modelica")
      missing.push_back(name);
  return missing;
}
}  // namespace modelica
