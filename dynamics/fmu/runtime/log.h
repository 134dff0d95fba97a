#pragma once
#include <string>
#include <vector>

namespace mill::fmu {
/// As both versions of the interface number them; pending is never returned.
enum class Status { ok, warning, discard, error, fatal };

/// Categories of messages, as modelDescription.xml lists them.
struct LogCategory {
  const char *name;
  const char *description;
};
const std::vector<LogCategory> &log_categories();

/// Where the messages of one instance go.
class Log {
public:
  virtual ~Log() = default;

  /// A message of a call that did not go well, in the category of its status; returns the status.
  Status refuse(Status status, const std::string &message) const;
  /// What the instance does.
  void event(const std::string &message) const;

  /// Switches categories on or off; none named: all.  @return  the name that is not a category; empty: each is one
  std::string enable(bool on, const std::vector<std::string> &categories);

protected:
  /// What is sent before the client switches categories on or off.
  enum class Start { nothing, failures, all };
  explicit Log(Start start);
  /// Hands a finished text to the client.
  virtual void send(Status status, const char *category, const std::string &message) const = 0;

private:
  void say(Status status, const char *category, const std::string &message) const;
  std::vector<bool> enabled_;
};
}  // namespace mill::fmu
