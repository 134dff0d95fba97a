#pragma once
#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

// A reader of Modelica text for tests: the grammar of Modelica 3.4, appendix B, as far as equations and components
// go. Independent of the writer: it knows no model of ours.
namespace modelica {
/// An expression: operator or function with its arguments, a name, a number or a text.
struct Expression {
  std::string what;  ///< "number", "name", "text", "call", "array", "index", "table", "all" or an operator
  std::string text;  ///< of a name, a text, a function
  double number = 0;
  std::vector<Expression> of;
};

struct Component {
  std::string prefix;  ///< "parameter", "input", "output", "discrete", ""
  std::string type;
  std::vector<Expression> dimensions;
  std::map<std::string, Expression> modifiers;  ///< "unit", "start", "s.start"
  std::unique_ptr<Expression> value;
  std::string comment;
};

struct Equation {
  Expression left, right;
};

/// A class with what stands in it; for loops are kept as their body with the range.
struct Class {
  std::string kind, name, comment;
  std::vector<std::string> order;  ///< of the components
  std::map<std::string, Component> components;
  std::vector<Equation> equations, initial_equations;  ///< loops are unrolled
  std::vector<std::pair<std::string, std::string>> connections;
  std::map<std::string, Class> classes;
  std::map<std::string, Expression> annotations;  ///< "experiment.StopTime", "uses.Modelica.version"
};

/// @throws std::runtime_error "line:column: what was expected"
Class read(const std::string &text);

/// Value by values of names; scalars are 1 x 1, vectors columns.  der(x) is looked up as "der(x)".
/// Knows + - * / ^, arrays, indices, zeros, max, abs and if.
using Values = std::map<std::string, Eigen::MatrixXd>;
Eigen::MatrixXd value_of(const Expression &expression, const Values &values);

/// Values of all parameters with a binding, in the order of their declaration.
Values parameters_of(const Class &model);

/// Names that are used and nowhere declared.
std::vector<std::string> undeclared(const Class &model);
}  // namespace modelica
