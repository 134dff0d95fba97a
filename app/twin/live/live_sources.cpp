#include "app/twin/live/live_sources.h"
#include "core/base/errors.h"
#include "twin/live/source/file_sources.h"
#include "twin/web/server/listen_address.h"
#include <filesystem>
#include <fmt/format.h>

namespace fs = std::filesystem;

namespace mill {
LiveSources::LiveSources(const LiveInput &input, const LiveOptions &options, const live::SourceRules &rules,
                         const std::int64_t skip_to, live::SampleQueue &queue)
{
  const double speed = replay_speed(options.speed);
  if (!options.speed.empty() && input.kind != LiveInput::Kind::replay)
    throw InputError(
        "--speed belongs to a record that is played (--input FILE.csv); other sources set their own pace");
  const live::FileSource file{input.target, rules, speed, skip_to};
  const auto start = [&](auto read) { thread_ = std::make_unique<live::SourceThread>(queue, std::move(read)); };
  using Kind       = LiveInput::Kind;
  switch (input.kind) {
  case Kind::replay:
    if (!fs::is_regular_file(input.target))
      throw InputError("the file " + input.target + " does not exist");
    description_ = "record " + input.target;
    start([file, &queue](const std::atomic<bool> &stop) { live::replay_csv(file, queue, stop); });
    break;
  case Kind::tail:
    description_ = "growing file " + input.target;
    start([file, &queue](const std::atomic<bool> &stop) { live::follow_csv(file, queue, stop); });
    break;
  case Kind::lines:
    description_ = "standard input";
    start([rules, &queue](const std::atomic<bool> &stop) { live::read_json_lines(0, rules, queue, stop); });
    break;
  case Kind::tcp: {
    const auto listen = web::address_and_port("--input", input.target, "tcp:127.0.0.1:8461");
    port_ = std::make_unique<live::DataPort>(live::DataPortSettings{listen.address, listen.port, rules}, queue);
    description_ = fmt::format("tcp {}:{}", listen.address, port_->port());
    break;
  }
  case Kind::mqtt: {
    live::MqttSettings settings = live::mqtt_settings(input.target);
    settings.rules              = rules;
    description_                = fmt::format("mqtt {}:{}/{}", settings.host, settings.port, settings.stand);
    mqtt_                       = std::make_unique<live::MqttSource>(settings, queue);
    break;
  }
  }
}

std::string LiveSources::notice() const
{
  return port_ ? port_->notice() : "";
}

void LiveSources::publish(const std::string &json)
{
  if (mqtt_)
    mqtt_->publish(json);
}

void LiveSources::rethrow() const
{
  if (thread_)
    thread_->rethrow();
}
}  // namespace mill
