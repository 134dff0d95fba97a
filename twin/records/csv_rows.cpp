#include "twin/records/csv_rows.h"
#include "core/base/error_list.h"
#include "core/base/text.h"
#include "twin/records/line_source.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
CsvRows::CsvRows(std::string file, const std::vector<std::string> &head, const ReadOptions &options,
                 const CsvEvidence *whole)
    : file_(std::move(file)), options_(options), clock_(options), layout_(layout_of(file_, head)),
      notes_(layout_.notes)
{
  for (CsvLayout::Column &column : layout_.columns)
    if (const auto given = options.units.find(column.head.name); given != options.units.end())
      column.head.unit = given->second;
  CsvEvidence of_head(layout_.columns.size());
  for (auto i = std::size_t(layout_.first_data_line - 1); i < head.size() && !whole; ++i)
    look_at(head[i], of_head);
  decided_ = columns_of(layout_, whole ? *whole : of_head);
  notes_.insert(notes_.end(), decided_.notes.begin(), decided_.notes.end());
  share_columns();
  prepare_clock(head);
}

void CsvRows::look_at(const std::string_view line, CsvEvidence &evidence)
{
  if (is_blank(line) || line.front() == '#')
    return;
  cut(line);
  if (cells_.size() >= layout_.columns.size())
    evidence.add(cells_);
}

void CsvRows::share_columns()
{
  using Use = CsvColumns::Kind;
  time_     = decided_.find(Use::time);
  date_     = decided_.find(Use::date);
  if (time_ >= 0)
    per_unit_ = seconds_per(layout_.columns[std::size_t(time_)].head.unit);
  for (std::size_t i = 0; i < layout_.columns.size(); ++i) {
    const bool is_channel = decided_.kind[i] == Use::channel;
    channel_of_column_.push_back(is_channel ? int(columns_.size()) : -1);
    if (is_channel)
      columns_.push_back(i);
    if (decided_.kind[i] == Use::label)
      label_columns_.push_back(i);
  }
  values_.resize(columns_.size());
  labels_.resize(label_columns_.size());
}

bool CsvRows::had_comma() const
{
  return std::any_of(decided_.style.begin(), decided_.style.end(),
                     [](const StyleChoice &choice) { return choice.style.decimal == ','; });
}

Place CsvRows::time_place(const std::string_view line, const int number) const
{
  return place(line, std::size_t(time_), number);
}

void CsvRows::require_not_before(const double earlier, const double time, const std::string_view line,
                                 const int number) const
{
  if (time < earlier)
    throw InputError(time_place(line, number),
                     fmt::format("the time goes backwards here, by {:.4g} s; sort the lines by time, or split the "
                                 "file where the recorder started again",
                                 earlier - time));
}

void CsvRows::refuse_timeless() const
{
  std::vector<std::string> names;
  for (const CsvLayout::Column &column : layout_.columns) {
    names.push_back(column.head.name);
    if (time_name(column.head.name) == TimeName::strong && !column.head.unit.empty())
      throw InputError(column.place,
                       fmt::format("column '{}' has the unit '{}'; a time in s, ms, us, min or h is needed{}",
                                   column.head.name, column.head.unit,
                                   by_option(options_, file_, ", or the samples per second", "--rate 20000")));
  }
  throw InputError(
      layout_.columns.front().place,
      fmt::format("no column holds the time; the columns are {}; name one, for example \"time [s]\"{}",
                  listed(names), by_option(options_, file_, ", or give the samples per second", "--rate 20000")));
}

void CsvRows::prepare_clock(const std::vector<std::string> &head)
{
  if (time_ < 0) {
    if (!options_.rate)
      refuse_timeless();
    return;
  }
  time_column_ = layout_.columns[std::size_t(time_)].place;
  cut(head[std::size_t(layout_.first_data_line - 1)]);
  double number     = 0;
  const auto column = std::size_t(time_);
  texts_            = column < cells_.size() && !read_number(cells_[column], decided_.style[column].style, number);
  if (!texts_ && per_unit_ == 0 && !options_.rate) {
    const std::string name = layout_.columns[column].head.name;
    throw InputError(time_column_, fmt::format("column '{}' has no unit; write for example \"{} [s]\"{}", name,
                                               name, by_option(options_, file_, ", or", "--unit " + name + "=s")));
  }
  if (options_.rate) {
    notes_.push_back(
        fmt::format("the column '{}' was not used: the rate was given", layout_.columns[column].head.name));
    time_ = -1;
  }
}

CsvRows::Kind CsvRows::take(const std::string_view line, const int number, const bool last)
{
  if (is_blank(line)) {
    ++blank_lines_;
    return Kind::nothing;
  }
  if (line.front() == '#')
    return Kind::nothing;
  cut(line);
  const std::size_t n = layout_.columns.size();
  while (cells_.size() > n && cells_.back().empty())
    cells_.pop_back();
  if (cells_.size() < n && last) {
    notes_.push_back(fmt::format("line {}, the last, is cut off and was not used", number));
    return Kind::cut_off;
  }
  if (cells_.size() != n)
    throw InputError(Place{file_, number, 1},
                     fmt::format("this line has {} cells, the columns are {}; a decimal comma needs ';' or tab "
                                 "between the columns",
                                 cells_.size(), n));
  if (time_ >= 0)
    take_time(line, number);
  for (std::size_t c = 0; c < n; ++c)
    if (const int channel = channel_of_column_[c]; channel >= 0)
      values_[std::size_t(channel)] = value_of(line, c, number);
  for (std::size_t i = 0; i < label_columns_.size(); ++i)
    labels_[i] = cells_[label_columns_[i]];
  return Kind::samples;
}

void CsvRows::cut(const std::string_view line)
{
  unquoted_.clear();
  split_cells(line, layout_.separator, unquoted_, cells_);
}

Place CsvRows::place(const std::string_view line, const std::size_t c, const int number) const
{
  return {file_, number, column_of(line, cells_[c], c, layout_.separator)};
}

double CsvRows::value_of(const std::string_view line, const std::size_t c, const int number)
{
  double value             = 0;
  const NumberStyle &style = decided_.style[c].style;
  if (read_number(cells_[c], style, value))
    return value;
  if (is_missing(cells_[c]))
    return std::numeric_limits<double>::quiet_NaN();
  throw InputError(place(line, c, number),
                   fmt::format("'{}' in column '{}' is not a number; leave the cell empty where there is no value",
                               shortened(std::string(cells_[c])), layout_.columns[c].head.name));
}

void CsvRows::take_time(const std::string_view line, const int number)
{
  const auto c  = std::size_t(time_);
  double second = 0;
  if (texts_) {
    const Place where = place(line, c, number);
    second            = date_ < 0 ? clock_.seconds_of(cells_[c], where)
                                  : clock_.seconds_of(std::string(cells_[std::size_t(date_)]) + " " + std::string(cells_[c]),
                                                      where);
  } else if (double value = 0; read_number(cells_[c], decided_.style[c].style, value)) {
    second = clock_.relative(value * per_unit_);
  } else
    throw InputError(place(line, c, number),
                     fmt::format("'{}' in the time column '{}' is not a time", shortened(std::string(cells_[c])),
                                 layout_.columns[c].head.name));
  seconds_ = second;
}

std::optional<CsvEvidence> evidence_of_all_rows(const std::string &path, CsvRows &rows)
{
  CsvEvidence all(rows.layout().columns.size());
  LineSource source(path);
  for (std::string_view line; source.next(line);)
    if (source.number() >= rows.layout().first_data_line)
      rows.look_at(line, all);
  if (columns_of(rows.layout(), all) == rows.decided())
    return std::nullopt;
  return all;
}
}  // namespace mill::twin
