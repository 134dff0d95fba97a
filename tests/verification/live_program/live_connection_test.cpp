#include "tests/support/live_chain.h"
#include "tests/support/live_program.h"
#include "tests/support/program.h"
#include "tests/support/raw_client.h"
#include "tests/support/slowness.h"
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <regex>
#include <thread>

namespace {
// One second at 1 kHz from sample `s` on, constant.
std::string second_from(const int s)
{
  std::string force = "976200";
  for (int k = 1; k < 1000; ++k)
    force += ",976200";
  return "{\"s\":" + std::to_string(s) + ",\"force\":[" + force + "]}\n";
}

std::string head_at(const std::string &second)
{
  return "{\"millstand\":1,\"rate\":1000,\"start\":\"2026-01-05T10:00:" + second +
         "Z\",\"units\":{\"force\":\"N\"},\"source\":\"daq-1\"}\n";
}

int data_port_of(const LiveProgram &program)
{
  const std::regex words("source: tcp 127\\.0\\.0\\.1:([0-9]+)\n");
  for (const double end = steady_seconds() + 20 * slowness(); steady_seconds() < end;) {
    const std::string printed = program.printed();
    if (std::smatch match; std::regex_search(printed, match, words))
      return std::atoi(match[1].str().c_str());
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return 0;
}

// An event "account" of a new stream that holds these words, at last.
bool accounts_say(const LiveProgram &program, const std::regex &words)
{
  for (const double end = steady_seconds() + 15 * slowness(); steady_seconds() < end;) {
    RawClient page(program.port());
    page.send(get_request(program.port(), "/events", "X-Millstand-Token: " + program.token() + "\r\n"));
    page.until("event: account\n", 3 * slowness());
    if (std::regex_search(page.until("\n\n"), words))
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}
}  // namespace

// What a sender and the page hear of a connection by TCP: the number at which to go on, in the numbers of the
// sender, and whether anything sends.
TEST(LiveConnection, SenderAndPageHearHowItStands)
{
  const std::string folder = scratch("live-connection");
  std::ofstream(folder + "/chain.toml") << chain_case();
  LiveProgram program(live_words({folder + "/chain.toml", "--input", "tcp:127.0.0.1:0"}), folder);
  const int port = data_port_of(program);
  ASSERT_GT(port, 0) << program.printed();
  {
    RawClient sender(port);
    sender.send(head_at("00") + second_from(0) + second_from(1000));
    ASSERT_EQ(sender.until("{\"ack\":1000}\n"), "{\"millstand\":1}\n{\"ack\":0}\n{\"ack\":1000}\n");
    EXPECT_TRUE(accounts_say(program, std::regex("\"connected\":true.*\"load\":[0-9.]+[,e]")))
        << program.printed();
  }
  EXPECT_TRUE(accounts_say(program, std::regex("\"connected\":false"))) << program.printed();
  RawClient again(port);
  again.send(head_at("01"));
  EXPECT_EQ(again.until("\n"), "{\"millstand\":1,\"next\":1000}\n") << "it began a second later";
  EXPECT_TRUE(accounts_say(program, std::regex("\"connected\":true"))) << program.printed();
}
