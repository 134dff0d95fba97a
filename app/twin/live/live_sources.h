#pragma once
#include "app/command/live_options.h"
#include "app/twin/live/live_input.h"
#include "twin/live/queue/sample_queue.h"
#include "twin/live/source/data_port.h"
#include "twin/live/source/mqtt_source.h"
#include "twin/live/source/source_thread.h"
#include <memory>
#include <string>

namespace mill {
/// The source that the user asked for, running.
class LiveSources {
public:
  /// @param skip_to  sample behind the last one of an earlier run of the same file; 0: none
  /// @throws InputError  a file or an address that is not there
  LiveSources(const LiveInput &input, const LiveOptions &options, const live::SourceRules &rules,
              std::int64_t skip_to, live::SampleQueue &queue);

  const std::string &description() const  ///< "tcp 127.0.0.1:8461"
  {
    return description_;
  }
  std::string notice() const;
  /// A result for those who listen at the source (MQTT).
  void publish(const std::string &json);
  /// @throws what the reader threw, after its end
  void rethrow() const;

private:
  std::string description_;
  std::unique_ptr<live::SourceThread> thread_;
  std::unique_ptr<live::DataPort> port_;
  std::unique_ptr<live::MqttSource> mqtt_;
};
}  // namespace mill
