#pragma once
#include "core/base/choice.h"
#include "core/base/warning.h"
#include "core/case/case_file.h"
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

// One row per parameter: reading, range check, echo, template, schema and input reference are all made from it.
namespace mill {
/// Both ends allowed, in the unit of the row.
struct Range {
  double min = -std::numeric_limits<double>::infinity();  ///< unit of the row
  double max = std::numeric_limits<double>::infinity();   ///< unit of the row
};

/// Value when the key is absent: a number in the unit of the row, a text, or one of the two words below.
struct Fallback {
  enum class Kind { required, absent, number, text };
  Kind kind        = Kind::required;
  double number    = 0;  ///< unit of the row
  const char *text = "";
  constexpr Fallback(Kind k) : kind(k) {}
  constexpr Fallback(double n) : kind(Kind::number), number(n) {}
  constexpr Fallback(int n) : kind(Kind::number), number(n) {}
  constexpr Fallback(const char *t) : kind(Kind::text), text(t) {}
  template <class E, if_choice<E> = 0> constexpr Fallback(E choice) : Fallback(word_of(choice)) {}
};
constexpr Fallback required{Fallback::Kind::required};  ///< the key must be there
constexpr Fallback absent{Fallback::Kind::absent};      ///< may be left out; the meaning says what happens then

/// What a value looks like in the file; follows from the member of a row and from its form.
enum class Kind {
  quantity,  ///< double with a unit, "420 mm"
  number,    ///< pure number, 0.2
  count,     ///< whole number, 39
  flag,      ///< true or false
  choice,    ///< one of a list of words
  text,
  path,     ///< file, relative to the folder of the case file
  pair,     ///< two quantities, ["100 kN", "2000 kN"]
  table,    ///< list of pairs, [["-700 mm", "0 um"], ...]
  six,      ///< list of six quantities, one for each body or spring of a stand
  words,    ///< list of words out of some, ["force", "slip"]
  list,     ///< list of quantities of any length; one alone may stand without brackets
  triples,  ///< list of three quantities each, [["-900 mm", "900 mm", "300 mm"], ...]
};

/// A value on its way between file and struct, SI.
using Value = std::variant<double, int, bool, std::string, std::array<double, 2>,
                           std::vector<std::array<double, 2>>, std::array<double, 6>, std::vector<std::string>,
                           std::vector<double>, std::vector<std::array<double, 3>>>;

/// A row without its destination: what documentation, schema and echo need.
struct Row {
  std::string key;
  Kind kind;
  std::string form;  ///< unit; "1" for a pure number; "a | b" for a choice; two units "mm, um" for a table
  Range range;       ///< of the value, of all of a pair or of six, of the second column of a table
  Fallback fallback;
  std::string example;  ///< scalar without quotes, "420 mm"; pair and table as TOML
  std::string meaning;
  std::string instead = "";  ///< what may be given in place of a required one, "M1 in [given]"; empty: nothing
};

/// A member of T that is a choice, an optional one or a list of them, whatever its type: as its words and back.
template <class T> struct ChoiceMember {
  std::function<Value(const T &)> words;  ///< "" for an absent one
  std::function<void(T &, const Value &)> take;
  std::string choices;  ///< "open | closed"
  Kind kind = Kind::choice;
  template <class E, class Of, if_choice<E> = 0>
  ChoiceMember(E Of::*member)
      : words([member](const T &record) -> Value { return std::string(word_of(record.*member)); }),
        take([member](T &record, const Value &value) {
          record.*member = choice_named<E>(std::get<std::string>(value)).value();
        }),
        choices(choices_of<E>())
  {
  }
  template <class E, class Of, if_choice<E> = 0>
  ChoiceMember(std::optional<E> Of::*member)
      : words([member](const T &record) -> Value {
          return std::string(record.*member ? word_of(*(record.*member)) : "");
        }),
        take([member](T &record, const Value &value) {
          record.*member = choice_named<E>(std::get<std::string>(value));
        }),
        choices(choices_of<E>())
  {
  }
  template <class E, class Of, if_choice<E> = 0>
  ChoiceMember(std::vector<E> Of::*member)
      : words([member](const T &record) -> Value {
          std::vector<std::string> words;
          for (const E one : record.*member)
            words.push_back(word_of(one));
          return words;
        }),
        take([member](T &record, const Value &value) {
          (record.*member).clear();
          for (const std::string &word : std::get<std::vector<std::string>>(value))
            (record.*member).push_back(choice_named<E>(word).value());
        }),
        choices(choices_of<E>()), kind(Kind::words)
  {
  }
  template <class Base, std::enable_if_t<std::is_base_of_v<Base, T>, int> = 0>
  ChoiceMember(const ChoiceMember<Base> &of_base)
      : words(of_base.words), take(of_base.take), choices(of_base.choices), kind(of_base.kind)
  {
  }
};

template <class T>
using Member = std::variant<double T::*, int T::*, bool T::*, std::string T::*, std::array<double, 2> T::*,
                            std::vector<std::array<double, 2>> T::*, std::array<double, 6> T::*,
                            std::vector<std::string> T::*, std::vector<double> T::*,
                            std::vector<std::array<double, 3>> T::*, ChoiceMember<T>>;

/// One input parameter.  Everything that the program says about it is written here, once.
template <class T> struct Field {
  const char *key;
  Member<T> member;          ///< destination, SI
  const char *form;          ///< as Row::form; "text" and "path" for those, "choice" for all words of a choice
  Range range;               ///< both ends allowed
  Fallback fallback;         ///< value when the key is absent, `required` or `absent`
  const char *example;       ///< shown in messages, used by the template
  const char *meaning;       ///< one sentence
  std::string instead = "";  ///< as Row::instead
};

/// The state of reading a case: every problem, and the places of the accepted values.
struct Reading {
  std::string file;    ///< the case file as the user named it
  std::string folder;  ///< of the case file; paths of the case start there
  std::vector<Problem> problems;
  std::vector<Warning> warnings;               ///< unlikely, but not impossible: nothing is refused for these
  std::map<std::string, Place> places;         ///< full key -> place of a value that was read and accepted
  std::map<std::string, std::string> written;  ///< full key -> value as written, "\"420 mm\""
  std::set<std::string> bad;                   ///< full keys whose value is missing or was refused
  std::string echo;                            ///< resolved.toml so far
  void add(Place place, std::string message, std::vector<Place> related = {});
  bool usable(const std::vector<std::string> &keys) const;  ///< none of these is bad
  Place place(const std::string &key) const;  ///< of a value; the file alone when the value is a default
  std::string as_written(const std::string &key) const;  ///< "work_roll.barrel_diameter = \"420 mm\""
};

/// A section as the reader sees it: its node (nullptr: left out) and its full name "bearing.trb", "pass.0", ""
/// (top).
struct Section {
  const Node *node = nullptr;
  std::string name;
  bool refused = false;                           ///< the value is not a section, and this was reported
  std::string header() const;                     ///< "[bearing.trb]"; "the top level" for the top
  std::string key(const std::string &key) const;  ///< full key
};

Kind kind_of(std::size_t member_index, const std::string &form);

/// One problem that lists the required keys of a section that is not there at all.
void report_missing_section(const Section &section, const std::vector<Row> &rows, Reading &reading);

/// Default of a row, SI; nothing when it is required or may be absent.
std::optional<Value> default_of(const Row &row);

/// Value of one row in a section, its default, or nothing (absent, or a problem that was added to `reading`).
std::optional<Value> read_row(const Row &row, const Section &section, Reading &reading);

/// Adds a problem for every key of the section that is neither a row nor one of `others`; at the top level
/// `others` are the sections.
void refuse_unknown_keys(const Section &section, const std::vector<Row> &rows,
                         const std::vector<std::string> &others, Reading &reading);

/// The problem of one such key, with the nearest of `known` or all of them.
void report_unknown(const Node::Entry &entry, const Section &section, const std::vector<std::string> &known,
                    Reading &reading);

/// Value as TOML text in the row's unit, with the digits that read back as the same double; empty for "not given".
std::string toml_of(const Row &row, const Value &value);
std::string example_toml(const Row &row);  ///< the row's example as TOML
std::string default_toml(const Row &row);  ///< the row's default as TOML; empty when it has none

/// The known word that fewest slips lead to; empty when every one is another word.
std::string nearest_word(const std::string &word, const std::vector<std::string> &known);

/// The same, or the only known word that continues this one: "barrel_diameter" of "barrel_dia".
std::string likely_word(const std::string &word, const std::vector<std::string> &known);

/// "; did you mean 'radial_clearance'?"; empty when nothing is near.
std::string meant_word(const std::string &word, const std::vector<std::string> &known);

/// The same, or the list of what is known when nothing is near.
std::string suggestion(const std::string &word, const std::vector<std::string> &known);

/// Damerau-Levenshtein distance of two words; an exchange of two adjacent letters is one slip.  From `limit` on
/// the distance is not computed to its end: the answer is then `limit` or more.  Cost: product of the lengths.
std::size_t slips_between(const std::string &a, const std::string &b,
                          std::size_t limit = std::numeric_limits<std::size_t>::max());

/// "a length", "a whole number", "one of none | iso | log"; what a message says is needed.
std::string needed(const Row &row);

/// "a | b" -> a, b
std::vector<std::string> split(const std::string &list, const std::string &separator);

/// Text as a TOML string; a key in quotes only where TOML wants them.
std::string quoted(const std::string &text);
std::string key_text(const std::string &key);

/// Unit of one column of a table row, or of any other row.
std::string column_form(const Row &row, int column);

/// A range with the unit `form`, "200 mm .. 2500 mm", "at least 3".
std::string range_in(const Range &range, const std::string &form);

/// "200 mm .. 2500 mm"; empty without a range.
std::string range_text(const Row &row);

template <class T> Row row_of(const Field<T> &f)
{
  const auto *choice = std::get_if<ChoiceMember<T>>(&f.member);
  const auto form    = choice && f.form == std::string("choice") ? choice->choices : f.form;
  const Kind kind    = choice ? choice->kind : kind_of(f.member.index(), form);
  return {f.key, kind, form, f.range, f.fallback, f.example, f.meaning, f.instead};
}

template <class T> std::vector<Row> rows_of(const std::vector<Field<T>> &fields)
{
  std::vector<Row> rows;
  for (const Field<T> &field : fields)
    rows.push_back(row_of(field));
  return rows;
}

template <class T> Value member_value(const Field<T> &field, const T &in)
{
  return std::visit(
      [&](const auto &member) -> Value {
        if constexpr (std::is_member_pointer_v<std::decay_t<decltype(member)>>)
          return in.*member;
        else
          return member.words(in);
      },
      field.member);
}

template <class T> void set_member(const Field<T> &field, const Value &value, T &out)
{
  std::visit(
      [&](const auto &member) {
        if constexpr (std::is_member_pointer_v<std::decay_t<decltype(member)>>)
          out.*member = std::get<std::decay_t<decltype(out.*member)>>(value);
        else
          member.take(out, value);
      },
      field.member);
}

/// Fills a struct from a section: every row, its default, and a problem for each unknown key.
/// `others` are keys of the section that somebody else reads, such as sub-sections.
template <class T>
void read(const Section &section, const std::vector<Field<T>> &fields, T &out, Reading &reading,
          const std::vector<std::string> &others = {})
{
  report_missing_section(section, rows_of(fields), reading);
  for (const Field<T> &field : fields)
    if (const auto value = read_row(row_of(field), section, reading))
      set_member(field, *value, out);
  refuse_unknown_keys(section, rows_of(fields), others, reading);
}

/// The same rows backwards: "key = value" lines of resolved.toml, defaults marked.  `name` is the full section
/// name.
template <class T>
std::string resolved_lines(const std::string &name, const std::vector<Field<T>> &fields, const T &in,
                           const Reading &reading)
{
  std::string text;
  for (const Field<T> &field : fields) {
    const Row row       = row_of(field);
    const auto toml     = toml_of(row, member_value(field, in));
    const auto full_key = name.empty() ? row.key : name + "." + row.key;
    if (toml.empty())
      text += "# " + row.key + " is not given\n";
    else
      text += row.key + " = " + toml + (reading.places.count(full_key) ? "" : "  # default") + "\n";
  }
  return text;
}

/// Reads a section and appends it to the echo under `header`, for instance "[[pass]]".
template <class T>
void read_and_echo(const Section &section, const std::string &header, const std::vector<Field<T>> &fields, T &out,
                   Reading &reading, const std::vector<std::string> &others = {})
{
  read(section, fields, out, reading, others);
  reading.echo += "\n" + header + "\n" + resolved_lines(section.name, fields, out, reading);
}
}  // namespace mill
