#include "core/records/matrix_market.h"
#include "core/base/choice.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace mill {
namespace {
constexpr long most_rows = 10000;

/// The words of a file, line by line; comments and blank lines are left out.
class Lines {
public:
  Lines(std::string path, const std::string &content) : file(std::move(path)), text(content) {}
  /// False position the end of the file.
  bool next(std::vector<std::string> &words)
  {
    while (position < text.size()) {
      ++line;
      const std::size_t end   = std::min(text.find('\n', position), text.size());
      const std::string whole = text.substr(position, end - position);
      position                = end + 1;
      words.clear();
      if (line > 1 && !whole.empty() && whole[0] == '%')
        continue;
      for (std::size_t i = 0; i < whole.size();) {
        const std::size_t from = whole.find_first_not_of(" \t\r", i);
        if (from == std::string::npos)
          break;
        i = std::min(whole.find_first_of(" \t\r", from), whole.size());
        words.push_back(whole.substr(from, i - from));
      }
      if (!words.empty())
        return true;
    }
    return false;
  }
  [[noreturn]] void refuse(const std::string &why) const
  {
    throw InputError(Place{file, line, 1}, why);
  }
  double number(const std::string &word) const
  {
    char *end          = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (end != word.c_str() + word.size() || !std::isfinite(value))
      refuse("\"" + word + "\" is not a finite number");
    return value;
  }
  long count(const std::string &word, const long most) const
  {
    char *end        = nullptr;
    const long value = std::strtol(word.c_str(), &end, 10);
    if (end != word.c_str() + word.size() || value < 1 || value > most)
      refuse(fmt::format("\"{}\" is not a whole number from 1 to {}", word, most));
    return value;
  }

private:
  std::string file;
  const std::string &text;
  std::size_t position = 0;
  int line             = 0;
};

// Words of the first line.
enum class Layout { coordinate, array };
constexpr auto words_of(Layout)
{
  return choice_words<Layout>("coordinate", "array");
}
enum class Numbers { real, integer };
constexpr auto words_of(Numbers)
{
  return choice_words<Numbers>("real", "integer");
}
enum class Symmetry { general, symmetric };
constexpr auto words_of(Symmetry)
{
  return choice_words<Symmetry>("general", "symmetric");
}

struct Form {
  bool coordinate = true, symmetric = false;
};

Form form_of(const std::vector<std::string> &words, const Lines &lines)
{
  static const std::vector<std::string> begin{"%%MatrixMarket", "matrix"};
  const bool begins   = words.size() == 5 && std::equal(begin.begin(), begin.end(), words.begin());
  const auto layout   = begins ? choice_named<Layout>(words[2]) : std::nullopt;
  const auto numbers  = begins ? choice_named<Numbers>(words[3]) : std::nullopt;
  const auto symmetry = begins ? choice_named<Symmetry>(words[4]) : std::nullopt;
  if (!layout || !numbers || !symmetry)
    lines.refuse("the first line must be \"%%MatrixMarket matrix coordinate real general\" (or array, integer, "
                 "symmetric)");
  return {*layout == Layout::coordinate, *symmetry == Symmetry::symmetric};
}

void read_entries(Lines &lines, const Form form, const long entries, Eigen::MatrixXd &m)
{
  std::vector<std::string> words;
  std::vector<bool> seen(std::size_t(m.size()), false);
  for (long n = 0; n < entries; ++n) {
    if (!lines.next(words))
      lines.refuse(fmt::format("the file ends after {} of {} entries", n, entries));
    if (words.size() != 3)
      lines.refuse("an entry is row, column and value");
    const long i = lines.count(words[0], m.rows()) - 1, j = lines.count(words[1], m.cols()) - 1;
    if (form.symmetric && i < j)
      lines.refuse("a symmetric matrix has its lower triangle only");
    if (seen[std::size_t(i + j * m.rows())])
      lines.refuse(fmt::format("the entry {}, {} comes twice", i + 1, j + 1));
    seen[std::size_t(i + j * m.rows())] = true;
    m(i, j)                             = lines.number(words[2]);
    if (form.symmetric)
      m(j, i) = m(i, j);
  }
}

void read_array(Lines &lines, const Form form, Eigen::MatrixXd &m)
{
  std::vector<std::string> words;
  for (Eigen::Index j = 0; j < m.cols(); ++j)
    for (Eigen::Index i = form.symmetric ? j : 0; i < m.rows(); ++i) {
      if (!lines.next(words))
        lines.refuse("the file ends before the last entry");
      if (words.size() != 1)
        lines.refuse("an entry of an array is one value");
      m(i, j) = lines.number(words[0]);
      if (form.symmetric)
        m(j, i) = m(i, j);
    }
}
}  // namespace

std::string matrix_market_text(const Eigen::MatrixXd &m, const std::string &comment)
{
  const bool symmetric = m.rows() == m.cols() && m.rows() > 1 && m == m.transpose();
  std::string entries;
  long count = 0;
  for (Eigen::Index j = 0; j < m.cols(); ++j)
    for (Eigen::Index i = symmetric ? j : 0; i < m.rows(); ++i)
      if (m(i, j) != 0) {
        entries += fmt::format("{} {} {}\n", i + 1, j + 1, m(i, j));
        ++count;
      }
  return fmt::format("%%MatrixMarket matrix coordinate real {}\n% {}\n{} {} {}\n",
                     symmetric ? "symmetric" : "general", comment, m.rows(), m.cols(), count) +
         entries;
}

Eigen::MatrixXd read_matrix_market(const std::string &path)
{
  const std::string text = read_text(path);
  Lines lines(path, text);
  std::vector<std::string> words;
  if (!lines.next(words))
    throw InputError(Place{path}, "is empty; a Matrix Market file begins with \"%%MatrixMarket\"");
  const Form form = form_of(words, lines);
  if (!lines.next(words) || words.size() != (form.coordinate ? 3u : 2u))
    lines.refuse(form.coordinate ? "a line with rows, columns and entries must follow"
                                 : "a line with rows and columns must follow");
  const long rows = lines.count(words[0], most_rows), columns = lines.count(words[1], most_rows);
  if (form.symmetric && rows != columns)
    lines.refuse(fmt::format("a symmetric matrix of {} rows and {} columns", rows, columns));
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(rows, columns);
  if (form.coordinate) {
    const long entries = words[2] == "0" ? 0 : lines.count(words[2], rows * columns);
    read_entries(lines, form, entries, m);
  } else
    read_array(lines, form, m);
  if (lines.next(words))
    lines.refuse("more entries than the header says");
  return m;
}
}  // namespace mill
