#include "core/base/input_file.h"
#include "twin/records/csv_rows.h"
#include "twin/records/label_spans.h"
#include "twin/records/line_source.h"
#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace mill::twin {
namespace {
class CsvReader {
public:
  CsvReader(const std::string &path, const ReadOptions &read_options) : source(path), options(read_options)
  {
    record.file   = path;
    record.format = "CSV";
  }
  RawRecord read(const CsvEvidence *whole)
  {
    std::string_view line;
    while (head.size() < CsvRows::lines_looked_at && source.next(line))
      head.emplace_back(line);
    rows.emplace(record.file, head, options, whole);
    const auto next_of_head = std::size_t(rows->layout().first_data_line - 1);
    make_room();
    if (!rows->timed())
      record.rate = *options.rate;
    record.time_place = rows->time_column();
    for (std::size_t i = next_of_head; i < head.size(); ++i)
      take(head[i], int(i) + 1, i + 1 == head.size() && source.ended_without_newline());
    while (source.next(line))
      take(line, source.number(), source.ended_without_newline());
    finish();
    return std::move(record);
  }

  std::optional<CsvEvidence> other_evidence()
  {
    return rows ? evidence_of_all_rows(record.file, *rows) : std::nullopt;
  }

private:
  void make_room()
  {
    const auto expected = std::size_t(1.05 * expected_lines(record.file)) + 16;
    require_memory(record.file, source.size(), 8.0 * double(expected) * double(rows->columns().size() + 1));
    values.resize(rows->columns().size());
    labels.resize(rows->label_columns().size());
    for (auto &column : values)
      column.reserve(expected);
    if (rows->timed())
      seconds.reserve(expected);
  }

  void take(const std::string_view line, const int number, const bool last)
  {
    if (rows->take(line, number, last) != CsvRows::Kind::samples)
      return;
    if (rows->timed()) {
      const double second = rows->seconds();
      if (!seconds.empty())
        rows->require_not_before(seconds.back(), second, line, number);
      seconds.push_back(second);
    }
    for (std::size_t c = 0; c < values.size(); ++c)
      values[c].push_back(rows->values()[c]);
    for (std::size_t c = 0; c < rows->labels().size(); ++c)
      labels[c].add(rows->labels()[c]);
  }

  void finish()
  {
    record.notes = rows->notes();
    if (source.encoding() != TextEncoding::utf8)
      record.notes.push_back(std::string("the file is ") + word_of(source.encoding()));
    if (rows->had_comma())
      record.notes.push_back("decimal commas were read as decimal points");
    if (rows->blank_lines() > 0)
      record.notes.push_back(fmt::format("{} blank line{} skipped", rows->blank_lines(),
                                         rows->blank_lines() == 1 ? " was" : "s were"));
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto &column = rows->layout().columns[rows->columns()[i]];
      Eigen::VectorXd numbers =
          Eigen::Map<const Eigen::VectorXd>(values[i].data(), Eigen::Index(values[i].size()));
      std::vector<double>().swap(values[i]);
      add_channel(record, column.head, column.place, options, std::move(numbers));
    }
    for (std::size_t i = 0; i < labels.size(); ++i)
      labels[i].finish(rows->layout().columns[rows->label_columns()[i]].head.name, record);
    for (std::size_t i = 0; i < rows->layout().columns.size(); ++i)
      if (rows->decided().kind[i] != CsvColumns::Kind::channel)
        record.other_columns.push_back(rows->layout().columns[i].head.name);
    if (rows->timed())
      record.time = Eigen::Map<const Eigen::VectorXd>(seconds.data(), Eigen::Index(seconds.size()));
    record.start      = rows->clock().start();
    record.first_time = rows->clock().first_number();
    require_usable_channels(record, options,
                            fmt::format("write the unit behind the name, for example \"{}\", or",
                                        options.from_case ? "force [kN]" : "upper_work_roll [g]"));
  }

  LineSource source;
  const ReadOptions &options;
  RawRecord record;
  std::optional<CsvRows> rows;
  std::vector<std::vector<double>> values;
  std::vector<LabelCollector> labels;
  std::vector<double> seconds;
  std::vector<std::string> head;
};
}  // namespace

RawRecord read_csv_record(const std::string &path, const ReadOptions &options)
{
  CsvReader reader(path, options);
  try {
    return reader.read(nullptr);
  } catch (const SystemError &) {
    throw;
  } catch (const InputError &) {
    // The first rows may have shown a column that is something else in the whole file.
    const auto evidence = reader.other_evidence();
    if (!evidence)
      throw;
    return CsvReader(path, options).read(&*evidence);
  }
}
}  // namespace mill::twin
