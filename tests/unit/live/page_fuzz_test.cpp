#include "core/base/errors.h"
#include "tests/support/raw_client.h"
#include "twin/live/page/page_command.h"
#include "twin/live/page/page_server.h"
#include <cstdlib>
#include <gtest/gtest.h>
#include <random>

// Requests and commands with mistakes at random places: nothing may crash, hang or be done.  The long form:
// MILLSTAND_FUZZ=1000000 (heads and commands each; in a build with sanitizers).
namespace live = mill::live;

namespace {
int inputs()
{
  const char *given = std::getenv("MILLSTAND_FUZZ");
  return given ? std::atoi(given) : 1000;
}

class Mutator {
public:
  explicit Mutator(const unsigned seed) : random_(seed) {}
  std::size_t below(const std::size_t n)
  {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
  }
  // One to four changes: a byte, a piece twice, a piece less, a piece of another text, digits.
  std::string changed(std::string text, const std::vector<std::string> &others)
  {
    for (std::size_t k = 1 + below(4); k > 0 && !text.empty(); --k) {
      const std::size_t position = below(text.size()), n = 1 + below(12);
      switch (below(6)) {
      case 0:
        text[position] = char(below(256));
        break;
      case 1:
        text.insert(position, text.substr(position, n));
        break;
      case 2:
        text.erase(position, n);
        break;
      case 3: {
        const std::string &other = others[below(others.size())];
        text.insert(position, other.substr(below(other.size() + 1), 4 * n));
        break;
      }
      case 4:
        text.insert(position, std::string(below(40), "0\r\n \"{[:9\0\xff"[below(12)]));
        break;
      default:
        text.resize(position);
      }
    }
    return text;
  }

private:
  std::mt19937 random_;
};

const std::vector<std::string> commands{
    R"({"command":"set","key":"K3","factor":1.1})", R"({"command":"reset"})", R"({"command":"adopt","id":3})",
    R"({"command":"place","place":"a"})",           R"([[[{"a":1e308}]]])",   R"("\ud800\u0000\"")"};
}  // namespace

TEST(PageFuzz, CommandsAreReadOrRefused)
{
  Mutator mutator(1);
  const int n = inputs();
  int read    = 0;
  for (int k = 0; k < n; ++k) {
    const std::string text = mutator.changed(commands[mutator.below(commands.size())], commands);
    try {
      const auto command = live::page_command(text);
      EXPECT_TRUE(command.factor >= 0.5 && command.factor <= 1.5) << text;
      EXPECT_LE(command.key.size(), 64u);
      ++read;
    } catch (const mill::InputError &) {
    }
  }
  EXPECT_GT(read, 0);  // some changes do no harm
  EXPECT_LT(read, n / 2);
}

TEST(PageFuzz, HeadsAreAnsweredOrCutAndNothingIsDoneWithoutTheToken)
{
  int done = 0;
  live::PageSettings settings;
  settings.port = 0;
  live::PageServer server(
      settings, "{}",
      [&](const std::string &) {
        ++done;
        return live::CommandReply{};
      },
      [] { return std::string(); });
  const std::string host = "Host: 127.0.0.1:" + std::to_string(server.port()) + "\r\n";
  const std::string type = "X-Millstand-Token: wrong\r\nContent-Type: application/json\r\n";
  const std::vector<std::string> heads{
      "GET / HTTP/1.1\r\n" + host + "\r\n",
      "GET /events?token=x HTTP/1.1\r\n" + host + "Last-Event-ID: 7\r\nAccept: text/event-stream\r\n\r\n",
      "POST /command HTTP/1.1\r\n" + host + type + "Content-Length: 20\r\n\r\n{\"command\":\"reset\"}\n",
      "POST /command HTTP/1.1\r\n" + host + type +
          "Transfer-Encoding: chunked\r\n\r\n5;a=b\r\n{\"com\r\n0\r\nX: y\r\n\r\n",
      "GET /metrics HTTP/1.0\r\n" + host + "Origin: http://evil.example\r\nExpect: 100-continue\r\n\r\n",
      "OPTIONS * HTTP/1.1\r\nHost: [::1]\r\nConnection: upgrade\r\nUpgrade: websocket\r\n\r\n"};
  Mutator mutator(2);
  const int n  = inputs();
  int answered = 0;
  for (int k = 0; k < n; ++k) {
    RawClient client(server.port());
    ASSERT_TRUE(client.connected()) << k;
    client.send(mutator.changed(heads[mutator.below(heads.size())], heads));
    client.end_of_sending();
    answered += client.rest(8).compare(0, 9, "HTTP/1.1 ") == 0;
  }
  EXPECT_EQ(done, 0);
  EXPECT_GT(answered, n / 2);
  EXPECT_EQ(ask(server.port(), get_request(server.port(), "/")).status, 200);
}
