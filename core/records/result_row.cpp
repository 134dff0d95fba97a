#include "core/records/result_row.h"
#include "core/records/open_rows.h"
#include "core/records/result_place.h"
#include <algorithm>
#include <iterator>

namespace mill {
namespace {
/// Between two points of a name: "row{n}_share" is "row", n, "_share"; without a place all of it is `before`.
struct NamePiece {
  std::string before;
  const ResultPlace *place = nullptr;
  std::string after;
};

/// A row as it is looked for, with or without what is in brackets.
struct RowPattern {
  const ResultRow *row = nullptr;
  std::vector<NamePiece> pieces;
  std::size_t n_places = 0;
};

// "[pass.]K1" -> "{pass}.K1" and "K1".
std::vector<std::string> spellings(const std::string &name)
{
  const auto open = name.find('['), close = name.find(']');
  if (open == std::string::npos)
    return {name};
  const std::string inside = name.substr(open + 1, close - open - 1);
  const std::string before = name.substr(0, open), after = name.substr(close + 1);
  return {before + after, before + "{" + inside.substr(0, inside.size() - 1) + "}." + after};
}

NamePiece piece_of(const std::string &text)
{
  const auto open = text.find('{'), close = text.find('}');
  if (open == std::string::npos)
    return {text, nullptr, ""};
  return {text.substr(0, open), &result_place(text.substr(open + 1, close - open - 1)), text.substr(close + 1)};
}

std::vector<std::string> split_at_points(const std::string &name)
{
  std::vector<std::string> parts(1);
  for (const char c : name)
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

RowPattern pattern_of(const ResultRow &row, const std::string &spelling)
{
  RowPattern pattern;
  pattern.row = &row;
  for (const std::string &part : split_at_points(spelling)) {
    pattern.pieces.push_back(piece_of(part));
    pattern.n_places += pattern.pieces.back().place != nullptr;
  }
  return pattern;
}

void add_patterns(std::vector<RowPattern> &all, const ResultRow &row)
{
  for (const std::string &spelling : spellings(row.name))
    all.push_back(pattern_of(row, spelling));
}

const std::vector<RowPattern> &patterns()
{
  static const std::vector<RowPattern> all = [] {
    std::vector<RowPattern> made;
    for (const RowGroup &group : row_groups())
      for (const ResultRow *row : group.rows)
        add_patterns(made, *row);
    return made;
  }();
  return all;
}

const std::vector<RowPattern> &open_patterns()
{
  static const std::vector<RowPattern> all = [] {
    std::vector<RowPattern> made;
    for (const ResultRow *row : row::open::all)
      add_patterns(made, *row);
    return made;
  }();
  return all;
}

// What is in the place of a piece; nothing where the part is not one of it.
std::optional<std::string> inside_of(const NamePiece &piece, const std::string &part)
{
  const std::size_t around = piece.before.size() + piece.after.size();
  if (part.size() <= around || part.compare(0, piece.before.size(), piece.before) != 0 ||
      part.compare(part.size() - piece.after.size(), piece.after.size(), piece.after) != 0)
    return std::nullopt;
  std::string inside = part.substr(piece.before.size(), part.size() - around);
  return piece.place->takes(inside) ? std::optional(std::move(inside)) : std::nullopt;
}

// The last of n parts with all that follow it.
std::string rest_of(const std::vector<std::string> &parts, const std::size_t n)
{
  std::string rest = parts[n - 1];
  for (std::size_t i = n; i < parts.size(); ++i)
    rest += "." + parts[i];
  return rest;
}

std::optional<ResultId> id_by(const RowPattern &pattern, const std::vector<std::string> &parts)
{
  const std::size_t n = pattern.pieces.size();
  const auto *last    = pattern.pieces.back().place;
  const bool longer   = last && last->takes_rest && parts.size() > n;
  if (parts.size() != n && !longer)
    return std::nullopt;
  for (std::size_t i = 0; i < n; ++i)  // words first: a place costs a text
    if (!pattern.pieces[i].place && parts[i] != pattern.pieces[i].before)
      return std::nullopt;
  ResultId id{pattern.row, {}};
  for (std::size_t i = 0; i < n; ++i) {
    const NamePiece &piece = pattern.pieces[i];
    if (!piece.place)
      continue;
    const auto inside = inside_of(piece, longer && i + 1 == n ? rest_of(parts, n) : parts[i]);
    if (!inside)
      return std::nullopt;
    id.places.emplace_back(piece.place->name, *inside);
  }
  return id;
}

// Fewer places first; then the one whose first words are its own: "bite.fit.{number}" before
// "bite.{pass}.friction", "bite.fit.{number}_low" before "bite.fit.{number}".
bool knows_more(const RowPattern &a, const RowPattern &b)
{
  if (a.n_places != b.n_places)
    return a.n_places < b.n_places;
  for (std::size_t i = 0; i < std::min(a.pieces.size(), b.pieces.size()); ++i) {
    const NamePiece &one = a.pieces[i], &other = b.pieces[i];
    if (!one.place != !other.place)
      return !one.place;
    const std::size_t letters = one.before.size() + one.after.size(),
                      fewer   = other.before.size() + other.after.size();
    if (one.place && letters != fewer)
      return letters > fewer;
  }
  return false;
}

bool holds(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}

// Each part in braces by what `text_of` makes of the name of the place.
template <class TextOf> std::string with_places(const std::string &text, const TextOf &text_of)
{
  std::string filled;
  std::size_t start = 0;
  for (auto open = text.find('{'); open != std::string::npos; open = text.find('{', start)) {
    const auto close = text.find('}', open);
    filled += text.substr(start, open - start) + text_of(text.substr(open + 1, close - open - 1));
    start = close + 1;
  }
  return filled + text.substr(start);
}
}  // namespace

namespace {
std::string name_by(const ResultRow &row, const std::vector<std::string> &parts)
{
  std::string name, bracket;
  std::size_t next = 0;
  bool inside      = false;
  for (const char *c = row.name; *c; ++c) {
    if (*c == '[') {
      inside = true;
      if (const std::string &part = parts.at(next++); !part.empty())
        name += part + ".";
    } else if (*c == ']') {
      inside = false;
    } else if (*c == '{') {
      name += parts.at(next++);
      while (*c != '}')
        ++c;
    } else if (!inside)
      name += *c;
  }
  return name;
}
}  // namespace

ResultName::ResultName(const ResultRow &made_by, const std::vector<std::string> &parts)
    : made_by_row(&made_by), name(name_by(made_by, parts))
{
}

std::string ResultId::place(const std::string &name) const
{
  const auto match =
      std::find_if(places.begin(), places.end(), [&](const auto &one) { return one.first == name; });
  return match == places.end() ? "" : match->second;
}

namespace {
std::optional<ResultId> best_id(const std::vector<RowPattern> &patterns, const std::string &name)
{
  const auto parts       = split_at_points(name);
  const RowPattern *best = nullptr;
  std::optional<ResultId> id;
  for (const RowPattern &pattern : patterns) {
    if (best && !knows_more(pattern, *best))
      continue;
    if (auto match = id_by(pattern, parts)) {
      id   = std::move(match);
      best = &pattern;
    }
  }
  return id;
}
}  // namespace

std::optional<ResultId> result_id(const std::string &name)
{
  return best_id(patterns(), name);
}

std::optional<ResultId> result_id_or_open(const std::string &name)
{
  auto id = result_id(name);
  return id ? id : best_id(open_patterns(), name);
}

bool is_made_by(const ResultRow &row, const std::string &name)
{
  const auto id = result_id(name);
  return id && id->is_of(row);
}

std::string meaning_of(const ResultId &id)
{
  const std::string phrase = id.row->meaning;
  std::string in_front;
  for (const auto &[place, part] : id.places)
    if (holds(id.row->name, "[" + place + ".]") && !holds(phrase, "{" + place + "}"))
      in_front += result_place(place).words(part) + ", ";
  return in_front +
         with_places(phrase, [&](const std::string &place) { return result_place(place).words(id.place(place)); });
}

std::string meaning_of_result(const std::string &name)
{
  const auto id = result_id(name);
  return id ? meaning_of(*id) : "";
}

std::vector<std::string> names_on_page(const ResultRow &row)
{
  std::vector<std::string> names;
  for (const std::string &spelling : spellings(row.name)) {
    std::vector<std::string> made{""};
    std::size_t start = 0;
    const auto extend = [&](const std::vector<std::string> &words) {
      std::vector<std::string> longer;
      for (const std::string &begin : made)
        for (const std::string &word : words)
          longer.push_back(begin + word);
      made = std::move(longer);
    };
    for (auto open = spelling.find('{'); open != std::string::npos; open = spelling.find('{', start)) {
      const auto close = spelling.find('}', open);
      extend({spelling.substr(start, open - start)});
      extend(result_place(spelling.substr(open + 1, close - open - 1)).on_page);
      start = close + 1;
    }
    extend({spelling.substr(start)});
    names.insert(names.end(), made.begin(), made.end());
  }
  return names;
}
}  // namespace mill
