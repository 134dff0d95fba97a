#include "twin/live/source/mqtt_source.h"
#include "core/base/errors.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <thread>
#ifdef MILLSTAND_MQTT
#include <mosquitto.h>
#endif

namespace mill::live {
MqttSettings mqtt_settings(const std::string &text)
{
  const auto slash = text.find('/');
  const auto colon = text.rfind(':', slash);
  MqttSettings settings;
  settings.host  = text.substr(0, std::min(colon, slash));
  settings.stand = slash == std::string::npos ? "" : text.substr(slash + 1);
  double port    = 1883;
  if (colon < slash && !parse_number(text.substr(colon + 1, slash - colon - 1), port))
    port = 0;
  const bool plain = !has_any(settings.stand, "/#+");
  if (settings.host.empty() || settings.stand.empty() || !plain || !(port >= 1 && port <= 65535) ||
      port != std::floor(port))
    throw InputError(fmt::format("--input mqtt:{}: broker and stand are needed, for example "
                                 "--input mqtt:127.0.0.1:1883/stand-3",
                                 text));
  settings.port = int(port);
  return settings;
}

#ifndef MILLSTAND_MQTT
bool has_mqtt()
{
  return false;
}
struct MqttSource::State {};
MqttSource::MqttSource(MqttSettings, SampleQueue &)
{
  throw InputError(
      "--input mqtt: this program was built without libmosquitto; install libmosquitto-dev and build it "
      "again, or bridge the topic to --input tcp:");
}
MqttSource::~MqttSource() = default;
void MqttSource::publish(const std::string &) {}
bool MqttSource::connected() const
{
  return false;
}
#else
bool has_mqtt()
{
  return true;
}

struct MqttSource::State {
  State(MqttSettings its_settings, SampleQueue &samples)
      : settings(std::move(its_settings)), queue(samples), session(rules())
  {
    mosquitto_lib_init();
    const std::string id = "millstand-" + settings.stand;
    client               = mosquitto_new(id.c_str(), false, this);
    if (!client)
      throw SystemError("no memory for the client of MQTT");
    mosquitto_connect_callback_set(client, [](mosquitto *, void *self, const int refused) {
      static_cast<State *>(self)->connected(refused);
    });
    mosquitto_message_callback_set(client, [](mosquitto *, void *self, const mosquitto_message *message) {
      static_cast<State *>(self)->take(
          {static_cast<const char *>(message->payload), std::size_t(message->payloadlen)});
    });
    mosquitto_disconnect_callback_set(client, [](mosquitto *, void *self, int) {
      if (static_cast<State *>(self)->is_connected.exchange(false))
        static_cast<State *>(self)->note("connection to the broker lost; it is tried again");
    });
  }
  ~State()
  {
    stop = true;
    if (thread.joinable())
      thread.join();
    mosquitto_disconnect(client);
    mosquitto_destroy(client);
    mosquitto_lib_cleanup();
  }

  SourceRules rules() const
  {
    SourceRules its = settings.rules;
    its.closes      = false;  // there is no sender to be cut off
    its.clock       = [] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    };
    return its;
  }
  std::string topic(const char *end) const
  {
    return fmt::format("millstand/{}/{}", settings.stand, end);
  }
  void note(const std::string &text)
  {
    Message message = SourceNote{"connection", fmt::format("mqtt {}:{}: {}", settings.host, settings.port, text)};
    queue.try_push(message);
  }
  void connected(const int refused)
  {
    answered = true;
    if (refused != 0) {
      note(std::string("the broker refused the connection: ") + mosquitto_connack_string(refused));
      return;
    }
    is_connected = was_connected = true;
    mosquitto_subscribe(client, nullptr, topic("in").c_str(), 1);
    note("connected");
  }
  // One message holds one line or several.
  void take(std::string_view payload)
  {
    while (!payload.empty()) {
      const auto end = payload.find('\n');
      give(session.take(payload.substr(0, end)));
      payload.remove_prefix(end == std::string_view::npos ? payload.size() : end + 1);
    }
  }
  void give(LineSession::Answer answer)
  {
    if (!answer.message)
      return;
    if (auto *block = std::get_if<SourceBlock>(&*answer.message))
      queue.push_or_drop(std::move(*block));
    else
      queue.try_push(*answer.message);
  }
  // Up to the next failure.  The connection is made inside the loop, so that `stop` is asked while a broker does
  // not answer; the system tries for minutes.
  int converse()
  {
    int error = mosquitto_connect_async(client, settings.host.c_str(), settings.port, 30);
    while (error == MOSQ_ERR_SUCCESS && !stop)
      error = mosquitto_loop(client, 50, 100);
    return error;
  }
  void run()
  {
    constexpr double shortest = 0.1, longest = 5;  // s
    double waits = shortest;
    bool noted   = false;
    while (!stop) {
      was_connected = answered = false;
      const int error          = converse();
      is_connected             = false;
      if (was_connected) {
        waits = shortest;
        noted = false;
      } else if (!noted && !answered && !stop) {
        note(fmt::format("no connection: {}; it is tried again", mosquitto_strerror(error)));
        noted = true;
      }
      for (double waited = 0; waited < waits && !stop; waited += 0.05)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      waits = std::min(2 * waits, longest);
    }
  }

  MqttSettings settings;
  SampleQueue &queue;
  LineSession session;
  mosquitto *client = nullptr;
  std::atomic<bool> stop{false}, is_connected{false};
  bool was_connected = false, answered = false;  // at the last attempt
  std::thread thread;
};

MqttSource::MqttSource(MqttSettings settings, SampleQueue &queue)
    : state_(std::make_unique<State>(std::move(settings), queue))
{
  mosquitto_threaded_set(state_->client, true);  // publish() comes from other threads
  state_->thread = std::thread([this] { state_->run(); });
}

MqttSource::~MqttSource() = default;

bool MqttSource::connected() const
{
  return state_->is_connected;
}

void MqttSource::publish(const std::string &json)
{
  if (!state_->is_connected)
    return;
  mosquitto_publish(state_->client, nullptr, state_->topic("out").c_str(), int(json.size()), json.data(), 0,
                    false);
}
#endif
}  // namespace mill::live
