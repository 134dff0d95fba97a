#pragma once
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

// One row for each kind of result: its name with named places, its unit, where it is defined and what it is.  The
// rows are in core/records/rows_of_*.h; results are added by them, pages and documents take unit, meaning and
// theory from them, and a name is taken apart by them alone.
namespace mill {
struct ResultRow {
  /// "contact.{contact}.half_width": a place in braces is a part of the name, or a piece of one ("row{n}_share");
  /// what is in brackets, one place and a point, may be left out: "[pass.]K1".
  const char *name;
  const char *unit;     ///< SI, "1" for a pure number; "": that of the key or the channel in the name
  const char *theory;   ///< equation of docs/theory that defines it, "3.7a", or the chapter, "36"
  const char *meaning;  ///< with the same places; one in brackets that it does not name stands in front of it
};

constexpr std::size_t places_in(const char *name)
{
  std::size_t n = 0;
  for (; *name; ++name)
    n += *name == '{' || *name == '[';
  return n;
}

/// A name that a row has made: what Results::add() takes.
class ResultName {
public:
  /// @param parts  one for each place of the row, in their order, as name_part() leaves them; "" leaves out what
  ///               is in brackets
  ResultName(const ResultRow &made_by, const std::vector<std::string> &parts);
  const std::string &text() const
  {
    return name;
  }
  operator const std::string &() const  // a name is looked for and listed as text
  {
    return name;
  }
  const ResultRow &row() const
  {
    return *made_by_row;
  }

private:
  const ResultRow *made_by_row;
  std::string name;
};

/// A row whose name has n places; another number does not compile.
template <std::size_t n> struct RowOf : ResultRow {
  constexpr RowOf(const char *name_, const char *unit_, const char *theory_, const char *meaning_)
      : ResultRow{name_, unit_, theory_, meaning_}
  {
    if (places_in(name_) != n)
      throw std::logic_error("the name of a row has another number of places");
  }
  /// The name with these parts in its places.
  template <class... Part> ResultName of(const Part &...part) const
  {
    static_assert(sizeof...(Part) == n, "a row takes one part for each place of its name");
    return {*this, {std::string(part)...}};
  }
};

/// A section of docs/output.md.
struct RowGroup {
  const char *title;
  const char *chapter;  ///< file in docs/theory without its ending
  std::vector<const ResultRow *> rows;
};
/// All rows, in the order of the page.
const std::vector<RowGroup> &row_groups();

/// What a name says: its row, and what is in the places of it.
struct ResultId {
  const ResultRow *row;
  std::vector<std::pair<std::string, std::string>>
      places;                                        ///< "contact" -> "upper"; one that is left out is not here
  std::string place(const std::string &name) const;  ///< "" where it is left out
  bool is_of(const ResultRow &other) const
  {
    return row == &other;
  }
  /// Whether it is of one of these rows: id.is_of(row::chatter::all).
  template <std::size_t n> bool is_of(const ResultRow *const (&rows)[n]) const
  {
    for (const ResultRow *other : rows)
      if (row == other)
        return true;
    return false;
  }
};
/// Nothing where no row makes this name.  Of several rows the one that knows more of its words.
/// Cost: about 2 us.
std::optional<ResultId> result_id(const std::string &name);

/// The same where a name may be of another version or typed by a user: without a row it is of the open row of its
/// family (core/records/open_rows.h), if it has one.
std::optional<ResultId> result_id_or_open(const std::string &name);

/// Whether this row makes the name.
bool is_made_by(const ResultRow &row, const std::string &name);
/// Whether one of these rows does: is_made_by(row::chatter::all, name).
template <std::size_t n> bool is_made_by(const ResultRow *const (&rows)[n], const std::string &name)
{
  const auto id = result_id(name);
  return id && id->is_of(rows);
}

/// "upper backup roll on upper work roll, tangent dF/dδ"
std::string meaning_of(const ResultId &id);
/// The same of a name; empty where no row makes it.
std::string meaning_of_result(const std::string &name);

/// The names of a row as docs/output.md lists them, PASS, MODE and N in the places: "K1", "PASS.K1".
std::vector<std::string> names_on_page(const ResultRow &row);
/// Whether such a word represents any name: "PASS".
bool is_any_name(const std::string &part);
}  // namespace mill
