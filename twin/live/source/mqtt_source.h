#pragma once
#include "twin/live/queue/sample_queue.h"
#include "twin/live/source/line_session.h"
#include <atomic>
#include <functional>
#include <memory>
#include <string>

namespace mill::live {
struct MqttSettings {
  std::string host = "127.0.0.1";
  int port         = 1883;
  std::string stand;  ///< topics millstand/<stand>/in and ../out
  SourceRules rules;
};
/// "HOST/STAND" or "HOST:PORT/STAND".  @throws InputError
MqttSettings mqtt_settings(const std::string &text);
/// Was the program built with libmosquitto?
bool has_mqtt();

/// JSON lines from a broker: quality 1, persistent session, so that the broker keeps what comes while we are away.
/// It drops what is beyond its own queue without a word: loss is counted from `s`.  A full queue here drops whole
/// blocks, which are counted too.  A lost connection is made again.
class MqttSource {
public:
  /// @throws InputError  built without libmosquitto
  MqttSource(MqttSettings settings, SampleQueue &queue);
  ~MqttSource();
  MqttSource(const MqttSource &)            = delete;
  MqttSource &operator=(const MqttSource &) = delete;
  /// A result for ../out, quality 0; any thread.
  void publish(const std::string &json);
  bool connected() const;  ///< with the broker; any thread

private:
  struct State;
  std::unique_ptr<State> state_;
};
}  // namespace mill::live
