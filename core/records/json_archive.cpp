#include "core/records/json_archive.h"
#include "core/base/errors.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace mill::json {
Node &entry(Node &object, const char *name)
{
  return object[name];
}

Node &element(Node &list)
{
  list.push_back(nullptr);
  return list.back();
}

void make_list(Node &node)
{
  node = Node::array();
}

void make_object(Node &node)
{
  node = Node::object();
}

void put(Node &node, const double value)
{
  node = std::isfinite(value) ? Node(value) : Node(nullptr);
}

void put(Node &node, const int value)
{
  node = value;
}

void put(Node &node, const bool value)
{
  node = value;
}

void put(Node &node, const std::string &value)
{
  node = value;
}

const Node *find(const Node &object, const char *name)
{
  if (!object.is_object())
    return nullptr;
  const auto entry = object.find(name);
  return entry == object.end() ? nullptr : &*entry;
}

const Node *element(const Node &list, const std::size_t i)
{
  return i < length(list) ? &list[i] : nullptr;
}

bool is_object(const Node &node)
{
  return node.is_object();
}

std::size_t length(const Node &list)
{
  return list.is_array() ? list.size() : 0;
}

std::vector<std::string> names_in(const Node &object)
{
  std::vector<std::string> names;
  if (object.is_object())
    for (const auto &[name, value] : object.items())
      names.push_back(name);
  return names;
}

void get(const Node &node, double &value)
{
  if (node.is_number())
    value = node.get<double>();
  else if (node.is_null())
    value = std::numeric_limits<double>::quiet_NaN();
}

void get(const Node &node, int &value)
{
  if (node.is_number() && std::abs(node.get<double>()) < 1e9)
    value = int(node.get<double>());
}

void get(const Node &node, bool &value)
{
  if (node.is_boolean())
    value = node.get<bool>();
}

void get(const Node &node, std::string &value)
{
  if (node.is_string())
    value = node.get<std::string>();
}

namespace {
Eigen::VectorXd numbers_in(const Node &list)
{
  Eigen::VectorXd numbers =
      Eigen::VectorXd::Constant(Eigen::Index(length(list)), std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index i = 0; i < numbers.size(); ++i)
    get(list[std::size_t(i)], numbers[i]);
  return numbers;
}
}  // namespace

void Reader::read(Eigen::VectorXd &vector)
{
  vector = numbers_in(node_);
}

void Reader::read(Eigen::MatrixXd &matrix)
{
  std::vector<Eigen::VectorXd> rows;
  read(rows);
  Eigen::Index columns = 0;
  for (const Eigen::VectorXd &row : rows)
    columns = std::max(columns, row.size());
  matrix.setConstant(Eigen::Index(rows.size()), columns, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < rows.size(); ++i)
    matrix.row(Eigen::Index(i)).head(rows[i].size()) = rows[i].transpose();
}

void require_flat(const std::string &text)
{
  constexpr int deepest = 64;  // what this program writes has seven levels
  int depth             = 0;
  bool in_text          = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\\' && in_text)
      ++i;
    else if (c == '"')
      in_text = !in_text;
    else if (!in_text && (c == '[' || c == '{') && ++depth > deepest)
      throw InputError("this JSON nests deeper than 64 levels");
    else if (!in_text && (c == ']' || c == '}'))
      --depth;
  }
}

Document::Document() : node_(std::make_unique<Node>()) {}

Document::Document(const std::string &text) : node_(std::make_unique<Node>())
{
  require_flat(text);
  try {
    *node_ = Node::parse(text);
  } catch (const nlohmann::json::exception &error) {
    throw InputError(std::string("this is not JSON: ") + error.what());
  }
  if (!node_->is_object())
    throw InputError("this is JSON, but not an object");
}

Document::~Document() = default;

Node &Document::node()
{
  return *node_;
}

std::string Document::text() const
{
  return node_->dump(1, ' ', false, Node::error_handler_t::replace) + "\n";
}
}  // namespace mill::json
