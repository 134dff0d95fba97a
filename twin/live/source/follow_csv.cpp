#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "twin/live/source/csv_feed.h"
#include "twin/live/source/file_sources.h"
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace mill::live {
namespace {
using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds poll_every{20};
constexpr std::chrono::milliseconds head_waits{500};  // for more lines to tell the rate by
constexpr int quiet_polls          = 3;               // at the end of a renamed file
constexpr std::size_t print_length = 256;  // byte of the beginning of a file that tell whether it is the same

class GrowingCsv {
public:
  GrowingCsv(const FileSource &source, SampleQueue &queue, const std::atomic<bool> &stop)
      : source_(source), queue_(queue), stop_(stop), feed_(source.path, source.rules), resumed_(source.resumed)
  {
  }
  ~GrowingCsv()
  {
    close();
  }
  GrowingCsv(const GrowingCsv &)            = delete;
  GrowingCsv &operator=(const GrowingCsv &) = delete;

  void run()
  {
    while (!stop_ && !queue_.closed() && !feed_.closed()) {
      if (file_ < 0 && !open()) {
        std::this_thread::sleep_for(poll_every);
        continue;
      }
      if (read_more())
        continue;
      rest();
      if (!pass_on())
        return;
      say_file();
      std::this_thread::sleep_for(poll_every);
    }
    pass_on();
  }

private:
  bool open()
  {
    file_ = ::open(source_.path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
    if (file_ < 0) {
      if (errno != ENOENT && !first_read_)
        refuse_file(errno, fmt::format("{} cannot be read: {}", source_.path, std::strerror(errno)));
      if (!said_missing_)
        note("note",
             errno == ENOENT
                 ? source_.path + " is not there yet; it is waited for"
                 // a program that changes files may set the rights of the new one a little later
                 : fmt::format("{} cannot be read: {}; it is waited for", source_.path, std::strerror(errno)));
      said_missing_ = true;
      return false;
    }
    said_missing_ = false;
    struct stat info;
    if (::fstat(file_, &info) != 0 || !S_ISREG(info.st_mode))
      throw InputError("tail:" + source_.path + " is not a regular file");
    device_ = info.st_dev;
    inode_  = info.st_ino;
    done_   = 0;
    number_ = 0;
    quiet_  = 0;
    forget_beginning();
    return true;
  }

  void close()
  {
    if (file_ >= 0)
      ::close(file_);
    file_ = -1;
  }

  // True when something was read.  What a file says now is read only while it is the one that was read before.
  bool read_more()
  {
    if (truncated())
      return true;
    char bytes[1 << 16];
    const ssize_t n = ::pread(file_, bytes, sizeof bytes, off_t(done_));
    if (n <= 0)
      return false;
    if (print_.size() < print_length)
      print_.append(bytes, std::min(std::size_t(n), print_length - print_.size()));
    done_ += n;
    quiet_ = 0;
    if (!first_read_) {
      first_read_ = Clock::now();
      resume(true);
    }
    cutter_.add({bytes, std::size_t(n)}, [&](std::string_view line) {
      if (++number_ == 1 && line.rfind(utf8_mark, 0) == 0)
        line.remove_prefix(utf8_mark.size());
      look_at(line);
      feed_.line(line, number_);
    });
    pass_on();
    say_file();
    return true;
  }

  // The lines that tell the columns have rows of numbers among them, and by these a file is known again.
  void look_at(const std::string_view line)
  {
    if (std::size_t(number_) > twin::CsvRows::lines_looked_at)
      return;
    (beginning_ += line) += '\n';
    if (std::size_t(number_) < twin::CsvRows::lines_looked_at)
      return;
    known_as_ = hash_of(beginning_);
    resume(known_as_ != source_.print);
  }

  // A file only grows: one that had these lines before the restart and has them not is another one.
  void resume(const bool other)
  {
    if (!resumed_)
      return;
    resumed_->other = other && !source_.print.empty();
    feed_.resume(*resumed_);
  }

  // Of the same recorder, in this run: the feed goes on by itself.
  void next_file()
  {
    resumed_.reset();
    feed_.new_file();
  }

  // Once for each file, behind samples of it.
  void say_file()
  {
    if (said_file_ || !feed_.first_of_file() || known_as_.empty())
      return;
    said_file_ = true;
    message(SourceFile{known_as_, *feed_.first_of_file()});
  }

  void forget_beginning()
  {
    print_.clear();
    beginning_.clear();
    known_as_.clear();
    said_file_ = false;
  }

  bool truncated()
  {
    struct stat info;
    if (::fstat(file_, &info) != 0)
      return false;
    bool other = info.st_size < done_;
    if (!other && !print_.empty()) {
      std::string now(print_.size(), '\0');
      other = ::pread(file_, now.data(), now.size(), 0) != ssize_t(now.size()) || now != print_;
    }
    if (!other)
      return false;
    note("loss", fmt::format("{} was truncated in place at byte {}: what was written between the last reading and "
                             "that may be lost",
                             source_.path, done_));
    drop_half_line();
    done_   = 0;
    number_ = 0;
    quiet_  = 0;
    forget_beginning();
    next_file();
    return true;
  }

  void drop_half_line()
  {
    if (cutter_.rest().empty())
      return;
    message(RefusedLine{fmt::format("{}:{}: the line was never finished", source_.path, number_ + 1), 0, 0});
    cutter_ = {};
  }

  // At the end of what there is: has the name gone to another file?
  void rest()
  {
    if (feed_.rate() > 0 || (first_read_ && Clock::now() - *first_read_ > head_waits))
      feed_.settle();
    struct stat info;
    if (::stat(source_.path.c_str(), &info) != 0 || (info.st_dev == device_ && info.st_ino == inode_))
      return;
    if (info.st_size == 0 || ++quiet_ < quiet_polls)
      return;  // the writer may still be at the old one
    note("note", source_.path + " was renamed; it was read to its end, the new file goes on");
    drop_half_line();
    close();
    next_file();
  }

  bool message(Message what)
  {
    return queue_.push(std::move(what));
  }
  void note(const std::string &kind, const std::string &text)
  {
    message(SourceNote{kind, text});
  }
  bool pass_on()
  {
    for (Message &ready : feed_.take())
      if (stop_ || !message(std::move(ready)))
        return false;
    return true;
  }

  const FileSource &source_;
  SampleQueue &queue_;
  const std::atomic<bool> &stop_;
  CsvFeed feed_;
  std::optional<ResumedFile> resumed_;  // while the first file of this run is read
  LineCutter cutter_;
  int file_ = -1, number_ = 0, quiet_ = 0;
  dev_t device_      = 0;
  ino_t inode_       = 0;
  std::int64_t done_ = 0;
  std::string print_, beginning_, known_as_;  // first bytes; first lines, and their hash when they are complete
  bool said_missing_ = false, said_file_ = false;
  std::optional<Clock::time_point> first_read_;
};
}  // namespace

void follow_csv(const FileSource &source, SampleQueue &queue, const std::atomic<bool> &stop)
{
  GrowingCsv(source, queue, stop).run();
}
}  // namespace mill::live
