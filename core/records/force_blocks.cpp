#include "core/records/force_blocks.h"
#include "core/base/csv_sheet.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>

namespace mill {
namespace {
Eigen::VectorXd numbers_of(csv::Sheet &sheet, const char *name, const char *sample)
{
  const std::size_t column = csv::index_of(sheet, name, sample);
  const Unit &unit         = csv::unit_of(sheet, sheet.header[column], sample);
  Eigen::VectorXd values(Eigen::Index(sheet.n_rows()));
  for (std::size_t row = 0; row < sheet.n_rows(); ++row)
    values[Eigen::Index(row)] = to_si(csv::number_of(sheet.cell(row, column), name, sheet), unit);
  return values;
}

// Is there more in this line than blanks or a comment?
bool has_content(std::string_view line)
{
  if (!line.empty() && line.back() == '\n')
    line.remove_suffix(1);
  const auto text = csv::without_blanks(line);
  return !text.empty() && text.front() != '#' && text != "\xEF\xBB\xBF";
}

// Calls visit(line, number from 1) for each line with content until it says true.
template <class Visit> void each_content(const std::string &lines, Visit visit)
{
  int number = 0;
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end  = std::min(lines.find('\n', begin), lines.size() - 1) + 1;
    const std::string line = lines.substr(begin, end - begin);
    ++number;
    if (has_content(line) && visit(line, number))
      return;
    begin = end;
  }
}

int lines_in(const std::string &text)
{
  return int(std::count(text.begin(), text.end(), '\n'));
}
}  // namespace

ForceBlocks::ForceBlocks(std::string path, const std::size_t bytes) : path_(std::move(path)), bytes_(bytes)
{
  std::error_code error;
  const auto status = std::filesystem::status(path_, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw InputError(path_ + " is not a regular file; a record that is read in blocks is read twice");
  if (const int file = open_file(path_, O_RDONLY); file >= 0)
    file_.reset(::fdopen(file, "rb"));
  if (!file_)
    refuse_file(errno, "cannot read " + path_ + ": " + std::strerror(errno));
  size_ = (long long)(std::filesystem::file_size(path_, error));
}

double ForceBlocks::fraction() const
{
  return size_ > 0 ? double(done_) / double(size_) : 1;
}

// Whole lines, about `bytes_` of them; false at the end.
bool ForceBlocks::read_lines(std::string &lines)
{
  lines = std::move(rest_);
  rest_.clear();
  while (!ended_ && lines.find('\n', lines.size() > bytes_ ? lines.size() - bytes_ : 0) == std::string::npos) {
    const std::size_t before = lines.size();
    lines.resize(before + bytes_);
    const std::size_t n = std::fread(&lines[before], 1, bytes_, file_.get());
    lines.resize(before + n);
    done_ += (long long)(n);
    if (std::ferror(file_.get()))
      refuse_file(errno, "cannot read " + path_ + ": " + std::strerror(errno));
    ended_ = n < bytes_;
  }
  if (!ended_) {
    const std::size_t last = lines.rfind('\n');
    rest_                  = lines.substr(last + 1);
    lines.resize(last + 1);
  }
  return !lines.empty();
}

// Numbers of a piece with its header in front; times go on where the piece before ended.
void ForceBlocks::parse(std::string lines, ForceRecord &block)
{
  csv::Sheet sheet = csv::sheet_of(path_, std::move(lines), "time [s], force [kN]");
  block.time       = numbers_of(sheet, "time", "s");
  block.force      = numbers_of(sheet, "force", "kN");
  block.notes      = sheet.notes;
  if (sheet.decimal_comma)
    block.notes.push_back("decimal commas were read as decimal points");
  for (Eigen::Index i = 0; i < block.time.size(); ++i) {
    if (n_samples_ > 0 && !(block.time[i] > last_time_)) {
      const auto &cell = sheet.cell(std::size_t(i), csv::index_of(sheet, "time", "s"));
      throw InputError(
          sheet.place(cell),
          fmt::format("time {} s comes after {} s; sort the lines by time, each once", block.time[i], last_time_));
    }
    last_time_ = block.time[i];
    ++n_samples_;
  }
}

bool ForceBlocks::next(ForceRecord &block)
{
  block.time.resize(0);
  for (std::string lines; block.time.size() == 0 && read_lines(lines);) {
    const bool first = header_.empty();
    const int before = lines_before_;
    lines_before_ += lines_in(lines);
    bool has_rows = false;
    each_content(lines, [&](const std::string &line, const int number) {
      has_rows = !header_.empty();
      if (header_.empty()) {
        header_      = line.back() == '\n' ? line : line + "\n";
        header_line_ = before + number;
      }
      return has_rows;
    });
    if (!has_rows)
      continue;  // comments, or the header alone
    try {
      parse(first ? std::move(lines) : header_ + lines, block);
    } catch (InputError &e) {
      // The header stands before every piece: line 2 there is the first behind the earlier pieces.
      for (Problem &problem : e.problems)
        problem.place.line = first                    ? problem.place.line + before
                             : problem.place.line > 1 ? problem.place.line + before - 1
                                                      : header_line_;
      throw InputError(e.problems);
    }
  }
  if (block.time.size() > 0)
    return true;
  if (n_samples_ < 2)
    throw InputError(Place{path_, 1, 1}, fmt::format("{} in this record; at least two are needed",
                                                     n_samples_ == 0 ? "no sample" : "only one sample"));
  return false;
}
}  // namespace mill
