#include "core/base/errors.h"
#include "tests/support/raw_client.h"
#include "twin/live/source/data_port.h"
#include <chrono>
#include <ctime>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

using namespace mill;

namespace {
const std::string head = "{\"millstand\":1,\"rate\":1000,\"units\":{\"force\":\"kN\"},\"source\":\"daq-1\"}\n";

std::string block(const int s, const int n)
{
  std::string line = "{\"s\":" + std::to_string(s) + ",\"force\":[976";
  for (int i = 1; i < n; ++i)
    line += ",976";
  return line + "]}\n";
}

live::DataPortSettings settings(const std::string &token = "")
{
  live::DataPortSettings its;
  its.port        = 0;
  its.rules.token = token;
  return its;
}

// A client whose number as a file is known.
struct Plain {
  int file = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  ~Plain()
  {
    ::close(file);
  }
  bool connect(const int port) const
  {
    sockaddr_in to{};
    to.sin_family      = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port        = htons(std::uint16_t(port));
    return ::connect(file, reinterpret_cast<const sockaddr *>(&to), sizeof to) == 0;
  }
  std::string answer_to(const std::string &line) const
  {
    std::array<char, 256> bytes{};
    const bool sent = ::send(file, line.data(), line.size(), MSG_NOSIGNAL) == ssize_t(line.size());
    const ssize_t n = sent ? ::recv(file, bytes.data(), bytes.size(), 0) : 0;
    return {bytes.data(), std::size_t(std::max<ssize_t>(n, 0))};
  }
};

int port_of(const int file, int (*const end)(int, sockaddr *, socklen_t *))
{
  sockaddr_in address{};
  socklen_t size = sizeof address;
  return end(file, reinterpret_cast<sockaddr *>(&address), &size) == 0 ? ntohs(address.sin_port) : -1;
}

// The other end of a connection of this process; -1: there is none.
int other_end(const int file)
{
  for (int other = 0; other < 1024; ++other)
    if (port_of(other, ::getpeername) == port_of(file, ::getsockname))
      return other;
  return -1;
}

int tcp_option(const int file, const int option)
{
  int value      = 0;
  socklen_t size = sizeof value;
  return ::getsockopt(file, IPPROTO_TCP, option, &value, &size) == 0 ? value : -1;
}

double processor_seconds()
{
  timespec used{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return double(used.tv_sec) + 1e-9 * double(used.tv_nsec);
}

std::string refusal(const live::DataPortSettings &settings)
{
  live::SampleQueue queue;
  try {
    const live::DataPort port(settings, queue);
    return "it listens";
  } catch (const InputError &error) {
    return error.problems.front().message;
  }
}
}  // namespace

TEST(DataPort, AcknowledgesBlocks)
{
  live::SampleQueue queue;
  const live::DataPort port(settings(), queue);
  RawClient client(port.port());
  client.send(head + block(0, 10) + block(10, 10));
  EXPECT_EQ(client.until("{\"ack\":10}\n"), "{\"millstand\":1}\n{\"ack\":0}\n{\"ack\":10}\n");
  EXPECT_EQ(queue.samples(), 20);
}

// A full queue loses nothing: the sender waits for its acknowledgement.
TEST(DataPort, AFullQueueStopsTheReading)
{
  live::SampleQueue queue;  // two seconds: 2000 samples
  const live::DataPort port(settings(), queue);
  RawClient client(port.port());
  std::string all = head;
  for (int k = 0; k < 40; ++k)
    all += block(100 * k, 100);
  client.send(all);
  EXPECT_NE(client.until("{\"ack\":1900}\n", 5).find("{\"ack\":1900}\n"), std::string::npos);
  EXPECT_EQ(client.rest(0.1), "") << "nothing more is taken";
  EXPECT_EQ(queue.samples(), 2000);
  std::int64_t taken = 0;
  while (taken < 4000)
    if (const auto message = queue.pop(1)) {
      if (const auto *one = std::get_if<live::SourceBlock>(&*message)) {
        ASSERT_EQ(one->first, taken);
        taken += one->value.rows();
      }
    } else
      break;
  EXPECT_EQ(taken, 4000);
}

TEST(DataPort, OneSourceAtATimeAndFourClients)
{
  live::SampleQueue queue;
  const live::DataPort port(settings(), queue);
  auto first = std::make_unique<RawClient>(port.port());
  EXPECT_FALSE(port.has_sender()) << "a client alone sends nothing";
  first->send(head);
  first->until("\n");
  EXPECT_TRUE(port.has_sender());
  RawClient second(port.port());
  second.send(head);
  const std::string answer = second.rest();
  EXPECT_EQ(answer.rfind("{\"rejected\":\"another source is sending from 127.0.0.1:", 0), 0u) << answer;
  EXPECT_NE(answer.find("; one at a time\"}\n"), std::string::npos) << answer;
  RawClient a(port.port()), b(port.port()), c(port.port());
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  RawClient fifth(port.port());
  EXPECT_EQ(fifth.rest(), "{\"rejected\":\"4 clients are connected already\"}\n");
  first.reset();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(port.has_sender());
  a.send(head + block(0, 1));
  EXPECT_EQ(a.until("{\"ack\":0}\n"), "{\"millstand\":1}\n{\"ack\":0}\n");
}

TEST(DataPort, ClosesConnectionsThatAreNotASource)
{
  live::SampleQueue queue;
  const live::DataPort port(settings(), queue);
  EXPECT_EQ(
      [&] {
        RawClient browser(port.port());
        browser.send("POST / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n" + head + block(0, 1));
        return browser.rest();
      }(),
      "{\"rejected\":\"no JSON from byte 1 on\",\"line\":1,\"closed\":\"the first line has to be a head\"}\n");
  RawClient garbage(port.port());
  garbage.send(head + "x\nx\nx\nx\nx\n" + block(0, 1));
  const std::string answer = garbage.rest();
  EXPECT_NE(answer.find("\"line\":6,\"closed\":\"five bad lines in a row\"}\n"), std::string::npos) << answer;
  EXPECT_EQ(queue.samples(), 0);
  RawClient blank(port.port());
  blank.send(std::string(200000, '\n') + head);
  EXPECT_EQ(blank.until("\n"), "{\"millstand\":1}\n");
}

// Slow senders hold no place: a head has five seconds, a line that was begun too.
TEST(DataPort, FiveSecondsForTheHeadAndForALine)
{
  live::SampleQueue queue;
  const live::DataPort port(settings(), queue);
  RawClient silent(port.port()), slow(port.port()), idle(port.port());
  slow.send("{\"mill");
  idle.send(head);
  idle.until("\n");
  const double begun = steady_seconds();
  for (int k = 0; k < 8; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    slow.send("s");
  }
  silent.rest(4);
  slow.rest(4);
  const double took = steady_seconds() - begun;
  EXPECT_GT(took, 4.5);
  EXPECT_LT(took, 6.5);
  idle.send(block(0, 1));
  EXPECT_EQ(idle.until("\n"), "{\"ack\":0}\n") << "a source may be silent between two lines";
}

TEST(DataPort, RefusesAddressesWithAReason)
{
  auto its    = settings();
  its.address = "localhost";
  EXPECT_EQ(refusal(its),
            "--input tcp:localhost: this is not a literal address; write for example 127.0.0.1 or ::1");
  its.address = "0.0.0.0";
  its.port    = 8461;
  EXPECT_EQ(refusal(its),
            "--input tcp:0.0.0.0:8461: this address is reached from other machines, so a token is needed "
            "that the senders know: --token-file FILE");
  live::SampleQueue queue;
  const live::DataPort port(settings(), queue);
  its.address = "127.0.0.1";
  its.port    = port.port();
  EXPECT_EQ(refusal(its), "--input tcp:127.0.0.1:" + std::to_string(port.port()) +
                              ": the port is taken, perhaps by another millstand live; choose another one");
}

TEST(DataPort, AsksForATokenAndStatesTheRisk)
{
  live::SampleQueue queue;
  auto its    = settings("0123456789abcdef0123456789abcdef");
  its.address = "0.0.0.0";
  const live::DataPort port(its, queue);
  EXPECT_EQ(port.notice(),
            "the data port at 0.0.0.0:0 is not encrypted: whoever is on the way reads and changes what "
            "is sent; put a TLS proxy in front");
  RawClient client(port.port());
  client.send(head);
  EXPECT_EQ(client.rest(),
            "{\"rejected\":\"\\\"token\\\" is missing or wrong\",\"line\":1,\"closed\":\"the first line has "
            "to be a head\"}\n");
}

// A sender whose machine has lost its power says nothing: after a minute the system closes its connection, and the
// port takes another sender.
TEST(DataPort, ASenderThatHasVanishedIsFoundInAMinute)
{
  live::SampleQueue queue;
  const live::DataPort port(settings(), queue);
  const Plain client;
  ASSERT_TRUE(client.connect(port.port()));
  EXPECT_EQ(client.answer_to(head), "{\"millstand\":1}\n");
  const int served = other_end(client.file);
  ASSERT_GE(served, 0);
  EXPECT_LE(tcp_option(served, TCP_KEEPIDLE) + tcp_option(served, TCP_KEEPCNT) * tcp_option(served, TCP_KEEPINTVL),
            60)
      << "s, while it owes us nothing";
  EXPECT_GT(tcp_option(served, TCP_USER_TIMEOUT), 0) << "else a lost answer is repeated for a quarter of an hour";
  EXPECT_LE(tcp_option(served, TCP_USER_TIMEOUT), 60'000) << "ms";
}

// A connection that cannot be taken for lack of file numbers waits in the system; asking for it without a pause
// would keep a processor busy.
TEST(DataPort, RestsWhileThereAreNoFileNumbers)
{
  live::SampleQueue queue;
  const live::DataPort port(settings(), queue);
  const Plain client;
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const int lowest_free = ::dup(client.file);
  ::close(lowest_free);
  const rlimit full{rlim_t(lowest_free), before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &full), 0);
  const bool connected = client.connect(port.port());
  const double begun   = processor_seconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  const double used = processor_seconds() - begun;
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_TRUE(connected);
  EXPECT_LT(used, 0.05) << "s of a processor in 0.4 s";
  EXPECT_EQ(client.answer_to(head), "{\"millstand\":1}\n") << "it is taken once there are numbers again";
}
