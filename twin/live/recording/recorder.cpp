#include "twin/live/recording/recorder.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "twin/live/recording/npy_header.h"
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>
#include <utility>

namespace fs = std::filesystem;

namespace mill::live {
namespace {
constexpr std::int64_t first_of_all = std::numeric_limits<std::int64_t>::min();

// All bytes at a place of a file, or the error number.
int write_at(const int file, const char *bytes, std::size_t n, std::int64_t offset)
{
  while (n > 0) {
    const ssize_t done = ::pwrite(file, bytes, n, off_t(offset));
    if (done < 0 && errno == EINTR)
      continue;
    if (done <= 0)
      return done < 0 ? errno : ENOSPC;
    bytes += done;
    n -= std::size_t(done);
    offset += done;
  }
  return 0;
}

// Puts a part on the disk, gives it its name and closes it.  0, or the error number; then it stays a part, which
// the next program finishes.
int named_after_all_is_written(const int file, const std::string &name)
{
  int error = ::fsync(file) == 0 ? 0 : errno;
  if (error == 0 && std::rename((name + ".npy.part").c_str(), (name + ".npy").c_str()) != 0)
    error = errno;
  ::close(file);
  return error;
}

// One file that grows.
struct OpenPart {
  std::string name;  // without an ending
  int file = -1;
  std::vector<std::string> fields;
  std::size_t header_bytes = 0;
  std::int64_t rows = 0, first = 0;
  nlohmann::ordered_json sidecar;

  std::size_t row_bytes() const
  {
    return 4 * fields.size() + 8;
  }
};

void put_row(std::string &bytes, const Eigen::MatrixXd &rows, const Eigen::Index row, const std::int64_t s)
{
  for (Eigen::Index c = 0; c < rows.cols(); ++c) {
    const float value = float(rows(row, c));
    std::uint32_t bits;
    std::memcpy(&bits, &value, 4);
    for (int i = 0; i < 4; ++i)
      bytes += char((bits >> 8 * i) & 0xff);
  }
  for (int i = 0; i < 8; ++i)
    bytes += char((std::uint64_t(s) >> 8 * i) & 0xff);
}
}  // namespace

struct Recorder::State {
  RecorderSettings settings;
  Background &background;
  std::function<void(const std::string &, const std::string &)> note;
  AccountText account;
  std::optional<LiveSource> source;
  std::optional<OpenPart> part;
  std::string unsaved;
  std::int64_t next = first_of_all, resumed = first_of_all, unsaved_rows = 0;
  double saved_at = 0, written = 0;
  std::atomic<bool> stopped{false};
  std::string trouble;

  void open(std::int64_t first);
  void save();
  void close();
  void refuse(const std::string &what, int error);
};

Recorder::Recorder(RecorderSettings settings, Background &background,
                   std::function<void(const std::string &, const std::string &)> note, AccountText account)
    : state_(new State{std::move(settings), background, std::move(note), std::move(account)})
{
}

Recorder::~Recorder()
{
  finish();
}

void Recorder::State::refuse(const std::string &what, const int error)
{
  trouble = fmt::format("{}: {}; recording stopped, the twin goes on", what, std::strerror(error));
  stopped = true;
  note("recording", trouble);
  if (part) {  // what is on the disk stays as it is, counted by its header up to the last save
    ::close(part->file);
    part.reset();
  }
  unsaved.clear();
  unsaved_rows = 0;
}

void Recorder::State::open(const std::int64_t first)
{
  const double began     = source->start_time + double(first) / source->rate;
  const std::string stem = fmt::format("{}/{}_{}", settings.folder, utc_name(began), first);
  OpenPart opened;
  std::vector<std::string> names;
  for (const LiveChannel &channel : source->channels)
    names.push_back(channel.name);
  opened.fields = field_names(names);
  opened.first  = first;
  for (int copy = 1; copy < 1000 && opened.file < 0; ++copy) {
    opened.name = copy == 1 ? stem : fmt::format("{}-{}", stem, copy);
    std::error_code error;
    if (fs::exists(opened.name + ".npy", error))
      continue;  // a record of the same time: it stays
    if (error) {
      refuse("cannot write " + opened.name + ".npy.part", error.value());
      return;
    }
    opened.file = ::open((opened.name + ".npy.part").c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (opened.file < 0 && errno != EEXIST) {
      refuse("cannot write " + opened.name + ".npy.part", errno);
      return;
    }
  }
  if (opened.file < 0) {
    refuse("cannot write " + stem + ".npy.part", EEXIST);
    return;
  }
  lock_file(opened.file, LOCK_EX | LOCK_NB);  // says to finish_parts() that the writer lives
  auto &sidecar        = opened.sidecar;
  sidecar["made_by"]   = "millstand live";
  sidecar["case"]      = settings.case_name;
  sidecar["case_hash"] = settings.case_hash;
  sidecar["source"]    = source->name;
  sidecar["rate"]      = source->rate;
  sidecar["start"]     = utc_text(began);
  sidecar["first"]     = first;
  for (std::size_t c = 0; c < names.size(); ++c) {
    sidecar["units"][opened.fields[c]] = source->channels[c].unit;
    if (opened.fields[c] != names[c])
      sidecar["names"][opened.fields[c]] = names[c];
  }
  sidecar["complete"]      = false;
  const std::string header = npy_header(opened.fields, 0);
  opened.header_bytes      = header.size();
  const int error          = write_at(opened.file, header.data(), header.size(), 0);
  part                     = std::move(opened);
  if (error != 0) {
    refuse("cannot write " + part->name + ".npy.part", error);
    return;
  }
  try {
    write_atomically(part->name + ".json",
                     part->sidecar.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  } catch (const InputError &) {
    refuse("cannot write " + part->name + ".json", ENOSPC);
  }
}

// Rows first, then their number: a header never promises what is not there.
void Recorder::State::save()
{
  if (!part || unsaved_rows == 0)
    return;
  const auto position = std::int64_t(part->header_bytes) + part->rows * std::int64_t(part->row_bytes());
  int error           = write_at(part->file, unsaved.data(), unsaved.size(), position);
  if (error == 0) {
    const std::string header = npy_header(part->fields, part->rows + unsaved_rows);
    error                    = write_at(part->file, header.data(), header.size(), 0);
  }
  if (error != 0) {
    refuse("cannot write " + part->name + ".npy.part", error);
    return;
  }
  part->rows += unsaved_rows;
  written += double(unsaved_rows) / source->rate;
  unsaved.clear();
  unsaved_rows = 0;
}

void Recorder::State::close()
{
  save();
  if (!part)
    return;
  part->sidecar["samples"]  = part->rows;
  part->sidecar["account"]  = nlohmann::ordered_json::parse(account ? account() : "{}", nullptr, false);
  part->sidecar["complete"] = true;
  const std::string text    = part->sidecar.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  background.run(
      [name = part->name, file = part->file, text, tell = note, folder = settings.folder, kept = settings.kept] {
        try {
          const int refused = named_after_all_is_written(file, name);
          if (refused != 0) {
            tell("recording", fmt::format("{}.npy: {}", name, std::strerror(refused)));
            return;
          }
          write_atomically(name + ".json", text);
          sync_to_disk(folder);
          for (const std::string &gone : remove_old_records(folder, kept, double(std::time(nullptr))))
            tell("note", gone + " is beyond what is kept and was removed");
        } catch (const std::exception &error) {
          tell("recording", error.what());
        }
      });
  part.reset();
}

void Recorder::begin(const LiveSource &source)
{
  State &s = *state_;
  s.close();
  s.source = source;
  s.next   = std::exchange(s.resumed, first_of_all);
}

void Recorder::resume(const std::int64_t next)
{
  (state_->source ? state_->next : state_->resumed) = next;
}

void Recorder::add(const std::int64_t first, const Eigen::MatrixXd &rows)
{
  State &s = *state_;
  for (Eigen::Index i = 0; i < rows.rows() && !s.stopped; ++i) {
    const std::int64_t number = first + i;
    if (number < s.next)
      continue;
    if (s.part && double(number - s.part->first) >= s.settings.seconds_per_file * s.source->rate)
      s.close();
    if (!s.part)
      s.open(number);
    if (s.stopped)
      return;
    put_row(s.unsaved, rows, i, number);
    ++s.unsaved_rows;
    s.next = number + 1;
    if (double(s.unsaved_rows) >= s.settings.longest_unsaved * s.source->rate)
      s.save();
  }
}

void Recorder::tick(const double now)
{
  State &s = *state_;
  if (now - s.saved_at < s.settings.longest_unsaved / 2)
    return;
  s.saved_at = now;
  s.save();
}

void Recorder::save()
{
  state_->save();
}

void Recorder::finish()
{
  state_->close();
}

std::int64_t Recorder::next() const
{
  return state_->next;
}

double Recorder::seconds() const
{
  return state_->written;
}

const std::string &Recorder::trouble() const
{
  return state_->trouble;
}
}  // namespace mill::live
