#include "app/export/stream_command.h"
#include "app/export/exported_stand.h"
#include "app/process/console.h"
#include "app/process/cut_signal.h"
#include "app/run/run_kind.h"
#include "app/verbs/driven_case.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/name_part.h"
#include "core/base/uninterrupted.h"
#include "core/model/case.h"
#include "dynamics/response/hold_stepper.h"
#include "dynamics/response/record_walk.h"
#include "dynamics/response/response.h"
#include "dynamics/response/running_spectrum.h"
#include "twin/records/force_blocks.h"
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>

namespace fs = std::filesystem;

namespace mill {
namespace {
using dynamics::Step;

constexpr Eigen::Index longest_segment = 1 << 17;  // of a spectrum

// A file that is written piece by piece aside and takes its name at the end.
class GrowingFile {
public:
  explicit GrowingFile(std::string path) : path_(std::move(path)), aside_(name_aside(path_))
  {
    file_ = uninterrupted([&] { return std::fopen(aside_.c_str(), "wbx"); });
    if (!file_)
      refuse_file(errno, "cannot write " + path_ + ": " + std::strerror(errno));
    lock_file(fileno(file_), LOCK_EX | LOCK_NB);  // remove_stale_parts() sees by it that the writer is alive
  }
  ~GrowingFile()
  {
    if (file_) {
      std::fclose(file_);
      std::remove(aside_.c_str());
    }
  }
  GrowingFile(const GrowingFile &)            = delete;
  GrowingFile &operator=(const GrowingFile &) = delete;

  void add(const char *bytes, const std::size_t n)
  {
    if (std::fwrite(bytes, 1, n, file_) != n)
      refuse();
  }
  void publish()
  {
    std::FILE *const file = file_;
    file_                 = nullptr;
    const bool whole      = std::fflush(file) == 0;
    if (std::fclose(file) != 0 || !whole || std::rename(aside_.c_str(), path_.c_str()) != 0) {
      const int error = errno;
      std::remove(aside_.c_str());
      errno = error;
      refuse();
    }
  }

private:
  [[noreturn]] void refuse() const
  {
    refuse_file(errno, "cannot write " + path_ + ": " + std::strerror(errno));
  }
  std::string path_, aside_;
  std::FILE *file_ = nullptr;
};

// The pass with the mean of the record as its load, and without a stored record.
template <class Spec> void drive_by(Spec &spec, const std::string &wanted, const double mean)
{
  for (Pass &pass : spec.passes)
    if (wanted.empty() || pass.name == name_part(wanted)) {
      if (std::isnan(pass.load))
        pass.load = mean;
      pass.force_file.clear();
      pass.synthetic_range = {not_given, not_given};
      return;
    }
}

Case driven_by_mean(Case the_case, const std::string &pass, const double mean)
{
  if (auto *stand = std::get_if<FourHigh>(&the_case.spec))
    drive_by(*stand, pass, mean);
  else if (auto *lumped = std::get_if<Lumped>(&the_case.spec))
    drive_by(*lumped, pass, mean);
  return the_case;
}

std::vector<std::pair<std::string, double>> stage(const char *name)
{
  return {std::pair<std::string, double>(name, 1)};
}

dynamics::RecordSurvey surveyed(twin::ForceBlocks &blocks, std::vector<std::string> &notes,
                                console::ProgressBar &bar)
{
  ForceRecord block;
  dynamics::RecordSurvey survey;
  while (blocks.next(block)) {
    for (Eigen::Index i = 0; i < block.time.size(); ++i)
      survey.add(block.time[i], block.force[i]);
    bar.show("first pass over the record", blocks.fraction());
  }
  notes = block.notes;
  return survey;
}

// The same, once more where the first rows of the record were misleading.
dynamics::RecordSurvey survey_of(twin::ForceBlocks &blocks, std::vector<std::string> &notes, const bool quiet)
{
  console::next_bar_ends_at(0.3);  // reading is cheaper than stepping
  console::ProgressBar bar(stage("first pass over the record"), quiet);
  dynamics::RecordSurvey survey;
  try {
    survey = surveyed(blocks, notes, bar);
  } catch (const InputError &) {
    if (!blocks.look_at_all_rows())
      throw;
    survey = surveyed(blocks, notes, bar);
  }
  bar.finish();
  blocks.rewind();
  return survey;
}

// What is known of a signal without keeping it.
struct RunningLevel {
  double peak = 0, sum = 0;
  void add(const double value)
  {
    peak = std::max(peak, std::abs(value));
    sum += value * value;
  }
};

// Steps through the record and gives away whole rows.
class StreamedResponse {
public:
  StreamedResponse(const dynamics::DrivenModel &model, const dynamics::RecordSurvey &survey, const double rate)
      : model_(model), mean_(survey.mean()), walk_(survey, rate),
        stepper_(model.system, survey.first_force - mean_), column_(model.system.C.rows())
  {
    const Eigen::Index length = dynamics::segment_length_for(walk_.grid().n, longest_segment);
    spectra_.emplace_back(rate, length, mean_);
    spectra_.emplace_back(rate, length);
    spectra_.emplace_back(rate, length);
    keep(0, survey.first_force);
  }

  void add(const ForceRecord &block)
  {
    for (Eigen::Index i = 0; i < block.time.size(); ++i)
      walk_.add(block.time[i], block.force[i] - mean_, [&](const Step &step) {
        stepper_.advance(step.length, step.F0, step.F1);
        if (step.output > 0)
          keep(step.output, step.F1 + mean_);
      });
  }

  // Rows since the last call.
  dynamics::Response take()
  {
    const auto rows      = Eigen::Index(force_.size());
    const Eigen::Index m = column_.size() - 1;
    dynamics::Response block;
    block.labels = model_.labels;
    block.time.resize(rows);
    for (Eigen::Index i = 0; i < rows; ++i)
      block.time[i] = walk_.grid().begin + double(taken_ + i) * walk_.grid().step;
    block.force = Eigen::Map<const Eigen::VectorXd>(force_.data(), rows);
    const Eigen::Map<const Eigen::MatrixXd> output(outputs_.data(), m + 1, rows);
    block.acceleration = output.topRows(m).transpose();
    block.load_cell    = output.row(m).transpose().array() + model_.load_cell_share * mean_;
    taken_ += rows;
    force_.clear();
    outputs_.clear();
    return block;
  }

  long long rows() const
  {
    return taken_;
  }
  double end() const
  {
    return walk_.grid().begin + double(taken_ - 1) * walk_.grid().step;
  }
  const dynamics::HoldStepper &stepper() const
  {
    return stepper_;
  }
  const RunningLevel &level(const std::size_t roll) const
  {
    return levels_[roll];
  }
  dynamics::Spectrum spectrum(const std::size_t signal) const
  {
    return spectra_[signal].spectrum();
  }

private:
  void keep(const Eigen::Index, const double force)
  {
    stepper_.output(force - mean_, column_);
    force_.push_back(force);
    outputs_.insert(outputs_.end(), column_.begin(), column_.end());
    const double upper = column_[dynamics::upper_work_roll], lower = column_[dynamics::lower_work_roll];
    levels_[0].add(upper);
    levels_[1].add(lower);
    spectra_[0].add(force);
    spectra_[1].add(upper);
    spectra_[2].add(lower);
  }

  const dynamics::DrivenModel &model_;
  double mean_;
  dynamics::RecordWalk walk_;
  dynamics::HoldStepper stepper_;
  Eigen::VectorXd column_;
  std::vector<double> force_, outputs_;
  std::vector<dynamics::RunningSpectrum> spectra_;
  RunningLevel levels_[2];
  long long taken_ = 0;
};

std::string spectrum_csv(const StreamedResponse &response)
{
  const auto force = response.spectrum(0), upper = response.spectrum(1), lower = response.spectrum(2);
  Table table;
  table.add("frequency", "Hz", force.frequency)
      .add("force", "N/sqrt(Hz)", force.density)
      .add("upper_work_roll", "g/sqrt(Hz)", upper.density / dynamics::standard_gravity)
      .add("lower_work_roll", "g/sqrt(Hz)", lower.density / dynamics::standard_gravity);
  return csv_text(table);
}

constexpr const char *kind_of_summary = "millstand simulate --stream";

void require_stream_folder(const std::string &folder, const std::string &case_name, const bool overwrite)
{
  std::error_code error;
  if (overwrite || !fs::exists(folder, error) || (fs::is_directory(folder, error) && fs::is_empty(folder, error)))
    return;
  if (const auto text = text_if_readable(folder + "/summary.json")) {
    const auto summary = nlohmann::json::parse(*text, nullptr, false);
    const auto says    = [&](const char *member, const std::string &wanted) {
      return summary.value(member, std::string()) == wanted;
    };
    if (summary.is_object() && says("made_by", kind_of_summary) && says("case", case_name))
      return;
  }
  throw InputError(folder + " exists and holds no streamed response of this case; choose another with -o, or give "
                            "--force-overwrite");
}

// Second pass: rows up to the end or the cut.  False: not one block was read.
bool write_rows(twin::ForceBlocks &blocks, StreamedResponse &response, GrowingFile &rows, const CutSignal &cut,
                const bool quiet)
{
  console::ProgressBar bar(stage("response"), quiet);
  ForceRecord block;
  bool first = true;
  while (cut.asked() == 0 && blocks.next(block)) {
    response.add(block);
    const std::string text = csv_text(dynamics::response_table(response.take()));
    const std::size_t skip = first ? 0 : text.find('\n') + 1;
    rows.add(text.data() + skip, text.size() - skip);
    first = false;
    bar.show("response", blocks.fraction());
  }
  bar.finish();
  return !first;
}

nlohmann::ordered_json summary_of(const StreamedResponse &response, const dynamics::RecordSurvey &survey)
{
  nlohmann::ordered_json s;
  s["samples"]              = survey.n;
  s["mean_force_N"]         = survey.mean();
  s["force_N"]              = {survey.smallest, survey.largest};
  s["record_s"]             = {survey.first, survey.last};
  s["rows"]                 = response.rows();
  s["reached_s"]            = response.end();
  const char *const rolls[] = {"upper_work_roll", "lower_work_roll"};
  for (std::size_t roll = 0; roll < 2; ++roll) {
    const RunningLevel &level = response.level(roll);
    s["peak_g"][rolls[roll]]  = level.peak / dynamics::standard_gravity;
    s["rms_g"][rolls[roll]]   = std::sqrt(level.sum / double(response.rows())) / dynamics::standard_gravity;
  }
  s["note"] = response.stepper().note();
  return s;
}
}  // namespace

int stream_command(const CommandLine &command, const Case &the_case)
{
  if (command.force.empty())
    throw InputError("millstand simulate --stream needs the record: --force FILE");
  if (!run_kind(the_case).driven)
    throw InputError("millstand simulate --stream: kind = \"" + the_case.kind + "\" has no stand that vibrates (" +
                     the_case.path + "); it drives cases of kind four-high and lumped");
  const std::string folder = command.output.empty() ? "out/" + the_case.name + "-stream" : command.output;
  if (fs::is_directory(folder))
    remove_stale_parts(folder);
  require_stream_folder(folder, the_case.name, command.force_overwrite);
  std::vector<std::string> notes;
  twin::ForceBlocks blocks(command.force);
  const auto survey = survey_of(blocks, notes, command.quiet);
  console::next_bar_ends_at(0.6);
  const DrivenStand stand = driven_case(command, driven_by_mean(the_case, command.pass, survey.mean()));
  say_warnings(stand.warnings);
  const auto model = driven_of(stand);
  fs::create_directories(folder);
  const CutSignal cut;  // before this there is nothing to keep
  GrowingFile rows(folder + "/response.csv");
  StreamedResponse response(model, survey, stand.dynamics.output_rate);
  if (!write_rows(blocks, response, rows, cut, command.quiet))
    return 128 + cut.asked();
  nlohmann::ordered_json summary;
  summary["made_by"]       = kind_of_summary;
  summary["case"]          = the_case.name;
  summary["pass"]          = stand.pass.name;
  summary["force"]         = command.force;
  summary["cut_by_signal"] = cut.asked();
  summary.update(summary_of(response, survey));
  summary["notes"] = notes;
  rows.publish();
  write_atomically(folder + "/spectrum.csv", spectrum_csv(response));
  write_atomically(folder + "/summary.json", summary.dump(2) + "\n");
  if (cut.asked())
    console::say(fmt::format("cut by signal {} at {:.6g} s of {:.6g} s; the record is whole up to there\n",
                             cut.asked(), response.end(), survey.last));
  if (!command.quiet)
    console::print(
        fmt::format("{}/response.csv: {} rows up to {:.6g} s, peaks {:.4g} g (upper), {:.4g} g (lower work "
                    "roll)\n",
                    folder, response.rows(), response.end(), summary["peak_g"]["upper_work_roll"].get<double>(),
                    summary["peak_g"]["lower_work_roll"].get<double>()));
  return cut.asked() ? 128 + cut.asked() : 0;
}
}  // namespace mill
