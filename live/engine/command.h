#pragma once
#include <mutex>
#include <string>
#include <vector>

namespace mill::live {
/// What the page asks of the twin.
struct Command {
  enum class Kind { set, reset, adopt, acknowledge };
  Kind kind = Kind::reset;
  std::string key;      ///< set: "K1".."K7", "damping"
  double factor = 1;    ///< -, set: on the model's own value
  std::string subject;  ///< adopt: proposal; acknowledge: alarm
};

/// {"command":"set","key":"K3","factor":1.1}, {"command":"reset"}, {"command":"adopt","proposal":"id"},
/// {"command":"acknowledge","alarm":7}.  @throws InputError  a sentence about what is wrong
Command command_of(const std::string &json);

/// From the threads that receive commands to the engine, which takes them between two blocks.
class CommandQueue {
public:
  /// @throws InputError  it is no command, or too many wait
  void push(const std::string &json);
  std::vector<Command> take();

private:
  std::mutex mutex_;
  std::vector<Command> commands_;
};
}  // namespace mill::live
