#include "core/base/errors.h"
#include "twin/live/source/mqtt_source.h"
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace mill;
namespace fs = std::filesystem;

namespace {
void wait(const int milliseconds)
{
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

// A broker of this test alone, which keeps ten messages for who is away.
class Broker {
public:
  Broker() : folder_(fs::temp_directory_path() / ("millstand-mqtt-" + std::to_string(getpid())))
  {
    fs::create_directories(folder_);
    port = 20000 + int(getpid() % 20000);
    std::ofstream(folder_ / "broker.conf")
        << "listener " << port << " 127.0.0.1\nallow_anonymous true\n"
        << "max_queued_messages 10\nmax_inflight_messages 1\n"
        << "persistence true\npersistence_location " << folder_.string() << "/\n";
  }
  ~Broker()
  {
    stop();
    fs::remove_all(folder_);
  }
  bool start()
  {
    for (const char *program : {"/usr/sbin/mosquitto", "/usr/bin/mosquitto"})
      if (fs::exists(program)) {
        pid_ = fork();
        if (pid_ == 0) {
          std::freopen("/dev/null", "w", stderr);
          execl(program, program, "-c", (folder_ / "broker.conf").c_str(), nullptr);
          _exit(127);
        }
        wait(300);
        return true;
      }
    return false;
  }
  void stop()
  {
    if (pid_ <= 0)
      return;
    kill(pid_, SIGTERM);
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }
  int port = 0;

private:
  fs::path folder_;
  pid_t pid_ = -1;
};

struct Came {
  std::int64_t samples = 0, dropped = 0, missing = 0, next = 0;
  void take(live::SampleQueue &queue, const double seconds)
  {
    while (const auto message = queue.pop(seconds)) {
      if (const auto *block = std::get_if<live::SourceBlock>(&*message)) {
        missing += block->first - next;
        next = block->first + block->value.rows();
        samples += block->value.rows();
      }
      if (const auto *lost = std::get_if<live::DroppedBlock>(&*message)) {
        missing += lost->first - next;
        next = lost->first + lost->n;
        dropped += lost->n;
      }
    }
  }
};

bool publish(const Broker &broker, const std::string &lines)
{
  const std::string file =
      (fs::temp_directory_path() / ("millstand-mqtt-lines-" + std::to_string(getpid()))).string();
  std::ofstream(file) << lines;
  const std::string command = "mosquitto_pub -h 127.0.0.1 -p " + std::to_string(broker.port) +
                              " -t millstand/stand-3/in -q 1 -l <" + file + " 2>/dev/null";
  const bool sent = std::system(command.c_str()) == 0;
  fs::remove(file);
  return sent;
}

std::string blocks(const int from, const int to)
{
  std::string text;
  for (int k = from; k < to; ++k)
    text += "{\"s\":" + std::to_string(100 * k) + ",\"force\":[976" + [] {
      std::string more;
      for (int i = 1; i < 100; ++i)
        more += ",976";
      return more;
    }() + "]}\n";
  return text;
}

const std::string head = "{\"millstand\":1,\"rate\":1000,\"units\":{\"force\":\"kN\"},\"source\":\"daq-1\"}\n";

// A port that answers no further connection, as an address without a machine behind it does: the only place
// of its queue is taken.
class SilentPort {
public:
  SilentPort()
  {
    sockaddr_in address{};
    address.sin_family      = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size          = sizeof address;
    auto *const place       = reinterpret_cast<sockaddr *>(&address);
    listens                 = ::bind(files_[0], place, size) == 0 && ::listen(files_[0], 0) == 0 &&
              ::getsockname(files_[0], place, &size) == 0;
    port = ntohs(address.sin_port);
    for (std::size_t i = 1; i < files_.size(); ++i)
      ::connect(files_[i], place, size);
  }
  ~SilentPort()
  {
    for (const int file : files_)
      ::close(file);
  }
  SilentPort(const SilentPort &)            = delete;
  SilentPort &operator=(const SilentPort &) = delete;
  int port                                  = 0;
  bool listens                              = false;

private:
  static int socket()
  {
    return ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  }
  std::array<int, 4> files_{socket(), socket(), socket(), socket()};
};

live::MqttSettings settings(const Broker &broker)
{
  return live::mqtt_settings("127.0.0.1:" + std::to_string(broker.port) + "/stand-3");
}
}  // namespace

TEST(Mqtt, UnderstandsItsAddress)
{
  const auto all = live::mqtt_settings("broker.mill:1884/stand-3");
  EXPECT_EQ(all.host, "broker.mill");
  EXPECT_EQ(all.port, 1884);
  EXPECT_EQ(all.stand, "stand-3");
  EXPECT_EQ(live::mqtt_settings("127.0.0.1/a").port, 1883);
  for (const std::string text : {"", "broker", "broker:0/a", "broker:x/a", "/a", "broker/a/b", "broker/#"})
    try {
      live::mqtt_settings(text);
      FAIL() << text;
    } catch (const InputError &error) {
      EXPECT_EQ(error.problems.front().message,
                "--input mqtt:" + text +
                    ": broker and stand are needed, for example --input mqtt:127.0.0.1:1883/stand-3");
    }
}

// TW-33: what a broker drops while no client reads is counted from the numbers, exactly; a new start of the broker
// and of the connection loses nothing that the broker kept.
TEST(Mqtt, CountsExactlyTheSamplesThatWereLost)
{
  Broker broker;
  if (!live::has_mqtt() || !broker.start() || std::system("command -v mosquitto_pub >/dev/null") != 0)
    GTEST_SKIP() << "mosquitto, mosquitto-clients or libmosquitto is not installed";
  live::SampleQueue queue;
  Came came;
  {
    live::MqttSource source(settings(broker), queue);
    wait(250);
    EXPECT_TRUE(source.connected());
    ASSERT_TRUE(publish(broker, head + blocks(0, 8)));
    came.take(queue, 0.4);
    EXPECT_EQ(came.samples, 800);
    EXPECT_EQ(came.missing, 0);
  }
  // away: of 50 blocks the broker keeps ten and one that is under way at most
  ASSERT_TRUE(publish(broker, blocks(8, 65)));
  live::SourceRules assumed;
  assumed.assumed = live::SourceHead{1000, {}, "daq-1", {{"force", "N"}}, {1000}};
  auto again      = settings(broker);
  again.rules     = assumed;
  live::MqttSource source(again, queue);
  wait(400);
  came.take(queue, 0.5);
  ASSERT_TRUE(publish(broker, blocks(65, 70)));
  came.take(queue, 0.4);
  EXPECT_EQ(came.next, 7000);
  EXPECT_EQ(came.samples + came.missing + came.dropped, 7000);
  EXPECT_GE(came.missing, 3900) << "the broker was to lose some forty blocks";
  EXPECT_EQ(came.missing % 100, 0) << "whole blocks";
  // the broker goes and comes back
  const auto before = came;
  broker.stop();
  wait(300);
  EXPECT_FALSE(source.connected());
  ASSERT_TRUE(broker.start());
  wait(700);
  ASSERT_TRUE(publish(broker, blocks(70, 75)));
  came.take(queue, 0.6);
  EXPECT_EQ(came.samples - before.samples, 500);
  EXPECT_EQ(came.missing, before.missing);
}

// A reader that does not keep pace: whole blocks are dropped here, and counted.
TEST(Mqtt, AFullQueueDropsWholeBlocks)
{
  Broker broker;
  if (!live::has_mqtt() || !broker.start() || std::system("command -v mosquitto_pub >/dev/null") != 0)
    GTEST_SKIP() << "mosquitto, mosquitto-clients or libmosquitto is not installed";
  live::SampleQueue queue;  // 2000 samples
  live::MqttSource source(settings(broker), queue);
  wait(250);
  ASSERT_TRUE(publish(broker, head));
  for (int k = 0; k < 50; k += 5)  // slower than what the broker would drop
    ASSERT_TRUE(publish(broker, blocks(k, k + 5)));
  wait(250);
  Came came;
  came.take(queue, 0.5);
  EXPECT_EQ(came.samples, 2000);
  EXPECT_EQ(came.dropped, 3000);
  EXPECT_EQ(came.missing, 0);
}

// Ctrl-C while a connection is being made: the system tries for two minutes.
TEST(Mqtt, EndsWhileABrokerDoesNotAnswer)
{
  const SilentPort silent;
  if (!live::has_mqtt())
    GTEST_SKIP() << "libmosquitto is not installed";
  ASSERT_TRUE(silent.listens);
  using Clock = std::chrono::steady_clock;
  live::SampleQueue queue;
  auto source = std::make_unique<live::MqttSource>(
      live::mqtt_settings("127.0.0.1:" + std::to_string(silent.port) + "/stand-3"), queue);
  wait(200);
  const auto asked = Clock::now();
  source.reset();
  EXPECT_LT(std::chrono::duration<double>(Clock::now() - asked).count(), 2);
}
