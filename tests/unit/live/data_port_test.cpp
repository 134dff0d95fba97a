#include "core/base/errors.h"
#include "tests/support/raw_client.h"
#include "twin/live/source/data_port.h"
#include <chrono>
#include <gtest/gtest.h>
#include <thread>

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
  first->send(head);
  first->until("\n");
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
  const std::string said = garbage.rest();
  EXPECT_NE(said.find("\"line\":6,\"closed\":\"five bad lines in a row\"}\n"), std::string::npos) << said;
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
