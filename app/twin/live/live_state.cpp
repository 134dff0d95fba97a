#include "app/twin/live/live_state.h"
#include "core/base/errors.h"
#include "core/base/file_ending.h"
#include "core/base/files.h"
#include "twin/live/recording/npy_header.h"
#include "twin/live/recording/recorder.h"
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace fs = std::filesystem;

namespace mill {
namespace {
constexpr std::uintmax_t largest_file = std::uintmax_t(64) << 20;  // bytes
constexpr int most_attempts           = 100;                       // of a lock that others remove

// A program that ends removes the file of its lock, perhaps between our open() and our lock: a third one would
// then lock another file of that name.
bool lost_its_name(const int file, const std::string &path)
{
  struct stat ours {};
  struct stat named {};
  return ::fstat(file, &ours) == 0 &&
         (::lstat(path.c_str(), &named) != 0 || ours.st_dev != named.st_dev || ours.st_ino != named.st_ino);
}
}  // namespace

RecordLock::RecordLock(const std::string &folder) : path_(folder + "/.recording")
{
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file_ < 0)
      return;  // the recording itself reports why nothing can be written
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      ::close(file_);
      throw InputError("the folder " + folder +
                       " is in use: another millstand live records into it; choose another with --record");
    }
    if (!lost_its_name(file_, path_))
      return;
    ::close(std::exchange(file_, -1));
  }
}

RecordLock::~RecordLock()
{
  if (file_ < 0)
    return;
  ::unlink(path_.c_str());
  ::close(file_);
}

LiveState::LiveState(const std::string &folder) : path_(folder + "/state.json")
{
  remove_stale_parts(folder);  // what a kill left while a text was written aside
}

std::optional<nlohmann::json> LiveState::read(const std::function<void(const std::string &)> &report) const
{
  std::error_code error;
  if (!fs::exists(path_, error))
    return {};
  const bool small = fs::file_size(path_, error) <= largest_file && !error;
  const auto text  = small ? text_if_readable(path_) : std::nullopt;
  auto json        = nlohmann::json::parse(text ? *text : "", nullptr, false);
  if (json.is_object())
    return json;
  const std::string aside = path_ + ".damaged";
  fs::rename(path_, aside, error);
  report(fmt::format("the stored state {} is damaged and cannot be read; the twin starts without it{}", path_,
                     error ? "" : ", it is kept as " + aside));
  return {};
}

bool LiveState::write(const nlohmann::json &state, live::Background &background,
                      std::function<void(const std::string &)> failed) const
{
  if (background.waiting() > 2)
    return false;
  // bytes that are not UTF-8 are replaced, so that the state is stored in any case
  background.run([path = path_, text = state.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace),
                  failed = std::move(failed)] {
    try {
      write_atomically(path, text + "\n");
    } catch (const std::exception &error) {
      failed(error.what());
    }
  });
  return true;
}

std::optional<std::int64_t> recorded_up_to(const std::string &folder, const live::LiveSource &source,
                                           const std::int64_t from)
{
  std::optional<std::int64_t> last;
  std::error_code error;
  for (const std::string &name : names_in(folder, error)) {
    const fs::path path = fs::path(folder) / name;
    const auto at       = name.find("Z_");
    if (at == std::string::npos || !has_ending(path, FileEnding::npy))
      continue;
    const std::int64_t first = std::strtoll(name.c_str() + at + 2, nullptr, 10);
    if (first < from)
      continue;
    const auto text    = text_if_readable(path.parent_path() / (path.stem().string() + ".json"));
    const auto sidecar = nlohmann::json::parse(text ? *text : "", nullptr, false);
    const auto start   = live::utc_text(source.start_time + double(first) / source.rate);
    if (!sidecar.is_object() || !sidecar.contains("start") || sidecar["start"] != start)  // of any type
      continue;
    std::ifstream file(path, std::ios::binary);
    std::string bytes(1 << 17, '\0');
    file.read(bytes.data(), std::streamsize(bytes.size()));
    bytes.resize(std::size_t(file.gcount()));
    live::NpyHeader header;
    if (!live::read_npy_header(bytes, header) || header.rows < 1)
      continue;
    file.clear();
    file.seekg(std::streamoff(header.bytes + std::size_t(header.rows) * header.row_bytes() - 8));
    unsigned char number[8] = {};
    if (!file.read(reinterpret_cast<char *>(number), 8))
      continue;
    std::uint64_t s = 0;
    for (int i = 0; i < 8; ++i)
      s |= std::uint64_t(number[i]) << 8 * i;
    last = std::max(last.value_or(0), std::int64_t(s) + 1);
  }
  return last;
}
}  // namespace mill
