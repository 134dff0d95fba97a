#include "core/case/case_rows.h"
#include <algorithm>
#include <cmath>

namespace mill {
namespace {
// Near and far: what a limit hides at one value shows at another.
constexpr double factors[] = {1.01, 0.1, 10};

double changed_number(const double now, const double factor)
{
  return now == 0 ? factor : now * factor;
}

// Lists of numbers, and of pairs and threes of them, all changed alike.
void change_all(double &number, const double factor)
{
  number = std::isnan(number) ? factor : changed_number(number, factor);
}
template <class List> void change_all(List &list, const double factor)
{
  for (auto &one : list)
    change_all(one, factor);
}

// What an absent list becomes.
template <class List> List some_list()
{
  List list(2);
  change_all(list[0], 1);
  change_all(list[1], 2);
  return list;
}

template <class List> std::vector<Value> other_lists(const List &now)
{
  if (now.empty())
    return {some_list<List>()};
  std::vector<Value> values;
  for (const double factor : factors) {
    List other = now;
    change_all(other, factor);
    values.push_back(other);
  }
  return values;
}

struct OtherValues {
  Kind kind;
  const std::string &form;
  std::vector<Value> operator()(const double now) const
  {
    if (std::isnan(now))
      return {1.};
    std::vector<Value> values;
    for (const double factor : factors)
      values.push_back(changed_number(now, factor));
    return values;
  }
  std::vector<Value> operator()(const int now) const
  {
    const bool small = now < 1000;  // a seed may be as large as a whole number can be
    return {small ? now + 1 : now - 1, small ? now - 1 : now - 1000, small ? 10 * now + 7 : now / 10};
  }
  std::vector<Value> operator()(const bool now) const
  {
    return {!now};
  }
  std::vector<Value> operator()(const std::string &now) const
  {
    if (kind == Kind::text || kind == Kind::path)
      return now.empty() ? std::vector<Value>{} : std::vector<Value>{now + "'"};
    std::vector<Value> values;
    for (const std::string &word : split(form, " | "))
      if (word != now)
        values.push_back(word);
    return values;
  }
  std::vector<Value> operator()(const std::vector<std::string> &now) const
  {
    std::vector<Value> values;
    for (const std::string &word : split(form, " | "))
      if (now != std::vector<std::string>{word})
        values.push_back(std::vector<std::string>{word});
    return values;
  }
  template <std::size_t n> std::vector<Value> operator()(std::array<double, n> now) const
  {
    std::vector<Value> values;
    for (const double factor : factors) {
      auto other = now;
      change_all(other, factor);
      values.push_back(other);
    }
    return values;
  }
  template <class T> std::vector<Value> operator()(const std::vector<T> &now) const
  {
    return other_lists(now);
  }
};

// One number or many; not a word, a text, a flag or words.
bool are_numbers(const std::vector<Value> &values)
{
  if (values.empty())
    return false;
  const Value &one = values.front();
  return !std::holds_alternative<std::string>(one) && !std::holds_alternative<bool>(one) &&
         !std::holds_alternative<std::vector<std::string>>(one);
}
}  // namespace

std::vector<Value> other_values(const Kind kind, const std::string &form, const Value &now)
{
  return std::visit(OtherValues{kind, form}, now);
}

KeyList CaseRows::moving(const std::function<std::string()> &text)
{
  const std::string before = text();
  KeyList keys;
  for (const auto &rows : sections_) {
    std::vector<std::vector<Value>> others;
    for (std::size_t row = 0; row < rows->size(); ++row) {
      others.push_back(rows->others(row));
      if (are_numbers(others.back()))
        rows->change(row, others.back().front());
    }
    const bool numbers_move = text() != before;
    rows->restore();
    for (std::size_t row = 0; row < others.size(); ++row) {
      if (!numbers_move && are_numbers(others[row]))
        continue;
      const bool moves = std::any_of(others[row].begin(), others[row].end(), [&](const Value &value) {
        const bool moved = rows->change(row, value) && text() != before;
        rows->restore();
        return moved;
      });
      if (moves)
        keys.push_back(rows->section + "." + rows->key(row));
    }
  }
  return keys;
}

KeyList CaseRows::keys() const
{
  KeyList all;
  for (const auto &rows : sections_)
    for (std::size_t row = 0; row < rows->size(); ++row)
      all.push_back(rows->section + "." + rows->key(row));
  return all;
}
}  // namespace mill
