#include "tests/support/raw_client.h"
#include "tests/support/refusal.h"
#include "twin/live/page/event_text.h"
#include "twin/live/page/page_command.h"
#include "twin/live/page/page_server.h"
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <thread>

namespace live = mill::live;
namespace fs   = std::filesystem;

namespace {
// A server whose commands are counted.
struct Served {
  std::atomic<int> commands{0};
  std::string last;
  live::PageServer server;

  explicit Served(const live::PageSettings &settings = at_any_port())
      : server(
            settings, R"({"name":"test"})",
            [this](const std::string &json) {
              live::page_command(json);
              last = json;
              ++commands;
              return live::CommandReply{};
            },
            [] { return std::string("# TYPE millstand_samples counter\nmillstand_samples_total 5\n"); })
  {
  }
  static live::PageSettings at_any_port()
  {
    live::PageSettings settings;
    settings.port = 0;
    return settings;
  }
  std::string with_token() const
  {
    return "X-Millstand-Token: " + server.token() + "\r\n";
  }
  std::string json_with_token() const
  {
    return with_token() + "Content-Type: application/json\r\n";
  }
  std::string stream_request() const
  {
    return get_request(server.port(), "/events?token=" + server.token());
  }
};

const std::string a_command = R"({"command":"set","key":"K3","factor":1.1})";

template <class Holds> bool comes_true(const Holds &holds, const double seconds = 3)
{
  for (const double end = steady_seconds() + seconds; steady_seconds() < end;
       std::this_thread::sleep_for(std::chrono::milliseconds(2)))
    if (holds())
      return true;
  return false;
}

std::string own_folder()
{
  static const fs::path folder = fs::temp_directory_path() / ("millstand-page-test-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  return folder.string();
}
}  // namespace

TEST(PageServer, AnswersWithThePageTheStandAndMetrics)
{
  Served served;
  const int port  = served.server.port();
  const auto page = ask(port, get_request(port, "/"));
  EXPECT_EQ(page.status, 200);
  for (const char *line : {"Content-Security-Policy: default-src 'self'; base-uri 'none'; form-action 'none'; "
                           "frame-ancestors 'none'\r\n",
                           "X-Content-Type-Options: nosniff\r\n", "Cache-Control: no-store\r\n",
                           "Content-Type: text/html; charset=utf-8\r\n"})
    EXPECT_NE(page.head.find(line), std::string::npos) << line << page.head;
  EXPECT_EQ(page.head.find("Access-Control"), std::string::npos);
  const auto stand = ask(port, get_request(port, "/stand", served.with_token()));
  EXPECT_EQ(stand.body, R"({"name":"test"})");
  EXPECT_EQ(
      ask(port, get_request(port, "/stand", "Authorization: Bearer " + served.server.token() + "\r\n")).status,
      200);
  const auto metrics = ask(port, get_request(port, "/metrics"));
  EXPECT_NE(metrics.head.find("Content-Type: application/openmetrics-text; version=1.0.0; charset=utf-8\r\n"),
            std::string::npos);
  EXPECT_EQ(metrics.body.find("# TYPE millstand_samples counter\nmillstand_samples_total 5\n# TYPE "), 0u)
      << metrics.body;
  EXPECT_NE(
      metrics.body.find("\n# TYPE millstand_page_frames_dropped counter\nmillstand_page_frames_dropped_total 0\n"),
      std::string::npos);
  EXPECT_EQ(metrics.body.substr(metrics.body.size() - 6), "# EOF\n");
}

// The page has nothing inline that its own policy would refuse, and names nothing outside.
TEST(PageServer, ThePageKeepsItsOwnPolicy)
{
  Served served;
  const int port  = served.server.port();
  const auto has  = [](const std::string &text, const char *what) { return text.find(what) != std::string::npos; };
  const auto html = ask(port, get_request(port, "/")).body;
  for (const char *inside : {"<style", " style=", " onclick=", " onload=", "javascript:", "<script>"})
    EXPECT_FALSE(has(html, inside)) << inside;
  for (const char *path : {"/", "/page.css", "/page.js", "/canvas.js", "/stand.js", "/charts.js", "/histories.js",
                           "/tables.js", "/answers.js"}) {
    const auto text = ask(port, get_request(port, path)).body;
    EXPECT_GT(text.size(), 1000u) << path;
    EXPECT_FALSE(has(text, "://")) << path << " names another place";
    EXPECT_FALSE(has(text, "innerHTML") || has(text, "eval(")) << path;
  }
}

TEST(PageServer, CommandsArriveOnceAndAreAnswered)
{
  Served served;
  const int port = served.server.port();
  EXPECT_EQ(ask(port, post_request(port, "/command", a_command, served.json_with_token())).status, 200);
  EXPECT_EQ(served.last, a_command);
  const auto wrong = ask(port, post_request(port, "/command", R"({"command":"stop"})", served.json_with_token()));
  EXPECT_EQ(wrong.status, 400);
  EXPECT_EQ(wrong.body,
            R"({"error":"command: unknown; there are set, reset, adopt, acknowledge, place, advice"})");
  EXPECT_EQ(served.commands, 1);
  // Two requests on one connection, the second in one piece with the first.
  RawClient client(port);
  const std::string request = "POST /command HTTP/1.1\r\nHost: localhost:" + std::to_string(port) + "\r\n" +
                              served.json_with_token() + "Content-Length: " + std::to_string(a_command.size()) +
                              "\r\n\r\n" + a_command;
  EXPECT_EQ(ask(client, request + request).status, 200);
  EXPECT_EQ(ask(client, "").status, 200);
  EXPECT_EQ(served.commands, 3);
}

// TW-31, item by item: 4xx, and nothing is done.
TEST(PageServer, RefusesForbiddenRequestsWithoutEffect)
{
  Served served;
  const int port         = served.server.port();
  const std::string good = served.json_with_token();
  const auto host        = [&](const std::string &name) {
    return "POST /command HTTP/1.1\r\nHost: " + name + "\r\nContent-Length: " + std::to_string(a_command.size()) +
           "\r\n" + good + "\r\n" + a_command;
  };
  const auto post = [&](const std::string &lines) { return post_request(port, "/command", a_command, lines); };
  const std::string type = "Content-Type: application/json\r\n";
  const struct {
    const char *what;
    std::string request;
    int status;
  } rows[] = {
      {"host with the address as its beginning", host("127.evil.example"), 403},
      {"host of another port", host("127.0.0.1:1"), 403},
      {"no host", "POST /command HTTP/1.1\r\nContent-Length: 0\r\n" + good + "\r\n", 400},
      {"two hosts", post("Host: evil.example\r\n" + good), 400},
      {"foreign origin", post(good + "Origin: http://evil.example\r\n"), 403},
      {"no token", post(type), 401},
      {"wrong token", post(type + "X-Millstand-Token: " + std::string(43, 'A') + "\r\n"), 401},
      {"token in the query of a command",
       post_request(port, "/command?token=" + served.server.token(), a_command, type), 401},
      {"text/plain", post(served.with_token() + "Content-Type: text/plain\r\n"), 415},
      {"no type", post(served.with_token()), 415},
      {"body of 65 kB", post_request(port, "/command", std::string(65 * 1024 + 1, ' '), good), 413},
      {"body of 65 kB in pieces",
       "POST /command HTTP/1.1\r\nHost: 127.0.0.1\r\nTransfer-Encoding: chunked\r\n" + good + "\r\n10400\r\n" +
           std::string(0x10400, ' ') + "\r\n0\r\n\r\n",
       413},
      {"head of 9 kB", get_request(port, "/", "X: " + std::string(9000, 'x') + "\r\n"), 431},
      {"no end of the target", "GET /" + std::string(9000, 'x'), 431},
      {"/../", get_request(port, "/../"), 404},
      {"/..%2f", get_request(port, "/..%2f..%2fetc%2fpasswd"), 404},
      {"another method", "DELETE /command HTTP/1.1\r\nHost: 127.0.0.1\r\n" + good + "\r\n", 405},
      {"a request of CORS", "OPTIONS /command HTTP/1.1\r\nHost: 127.0.0.1\r\nOrigin: http://evil.example\r\n\r\n",
       403},
      {"events without token", get_request(port, "/events"), 401},
      {"stand without token", get_request(port, "/stand"), 401},
      {"no HTTP", "\x16\x03\x01\x02\r\n\r\n", 400},
      {"length that is none",
       "POST /command HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: -5\r\n" + good + "\r\n", 400},
      {"length and pieces",
       "POST /command HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 5\r\nTransfer-Encoding: chunked\r\n" + good +
           "\r\n0\r\n\r\n",
       400},
  };
  for (const auto &row : rows) {
    const auto answer = ask(port, row.request);
    EXPECT_EQ(answer.status, row.status) << row.what << ": " << answer.head << answer.body.substr(0, 200);
    EXPECT_EQ(nlohmann::json::parse(answer.body, nullptr, false).count("error"), 1u) << row.what;
    EXPECT_NE(answer.head.find("Content-Security-Policy: default-src 'self'"), std::string::npos) << row.what;
  }
  EXPECT_EQ(served.commands, 0);
  EXPECT_EQ(served.server.statistics().requests_refused, std::int64_t(std::size(rows)));
}

TEST(PageServer, ARequestHasFiveSeconds)
{
  Served served;
  const int port = served.server.port();
  RawClient head(port), body(port), silent(port);
  const double begin = steady_seconds();
  head.send("POST /command HTTP/1.1\r\nHost: 127.0.0.1");
  body.send("POST /command HTTP/1.1\r\nHost: 127.0.0.1\r\n" + served.json_with_token() +
            "Content-Length: 400\r\n\r\n{");
  std::thread drop_by_drop([&] {
    for (int k = 0; k < 40 && head.send("x"); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(150));
  });
  EXPECT_EQ(body.rest(8).compare(0, 12, "HTTP/1.1 408"), 0);
  const double took = steady_seconds() - begin;
  EXPECT_GT(took, 4.5);
  EXPECT_LT(took, 7.5);
  drop_by_drop.join();
  EXPECT_EQ(head.rest(3).compare(0, 12, "HTTP/1.1 408"), 0);
  EXPECT_EQ(silent.rest(3), "");  // it asked for nothing and receives nothing
  EXPECT_EQ(served.commands, 0);
}

TEST(PageServer, AStreamBeginsWithThePresentState)
{
  Served served;
  for (const char *event : {"numbers", "modes", "alarm", "numbers"})
    served.server.publish(event, "{}");
  RawClient client(served.server.port());
  client.send(served.stream_request());
  const std::string text = client.until("id: 4");
  EXPECT_NE(text.find("Content-Type: text/event-stream"), std::string::npos);
  EXPECT_NE(text.find("retry: 1000\n\nid: 2\nevent: modes\ndata: {}\n\nid: 3\nevent: alarm"), std::string::npos)
      << text;
  EXPECT_TRUE(comes_true([&] { return served.server.statistics().event_streams == 1; }));
  served.server.publish("numbers", R"({"s":5})");
  EXPECT_NE(client.until("{\"s\":5}\n\n").find("id: 5\nevent: numbers\ndata: {\"s\":5}\n\n"), std::string::npos);
}

TEST(PageServer, ABrowserThatLeavesIsForgotten)
{
  Served served;
  {
    RawClient client(served.server.port());
    client.send(served.stream_request());
    client.until("retry: 1000");
    EXPECT_EQ(served.server.statistics().event_streams, 1);
  }
  EXPECT_TRUE(comes_true([&] { return served.server.statistics().event_streams == 0; }));
}

// TW-30: 16 browsers of which 4 never read; those that read miss nothing, the next is refused.
TEST(PageServer, FourBrowsersThatNeverReadDoNotDisturbTheOthers)
{
  Served served;
  const int port = served.server.port();
  std::vector<std::unique_ptr<RawClient>> deaf, others;
  for (int k = 0; k < 16; ++k) {
    auto &list = k < 4 ? deaf : others;
    list.push_back(std::make_unique<RawClient>(port, k < 4 ? 4096 : 0));
    list.back()->send(served.stream_request());
    list.back()->until("retry: 1000");
  }
  EXPECT_EQ(ask(port, served.stream_request()).status, 503);
  EXPECT_EQ(ask(port, get_request(port, "/")).status, 200);  // pages and commands go on
  const std::string data = "\"" + std::string(6000, 'x') + "\"";
  constexpr int frames   = 100;
  double slowest         = 0;
  for (int k = 1; k <= frames; ++k) {
    const double sent = steady_seconds();
    served.server.publish("numbers", data);
    if (k % 25 == 0)
      served.server.publish("alarm", R"({"id":)" + std::to_string(k) + "}");
    for (auto &client : others)
      EXPECT_NE(client->until(data + "\n\n").find("event: numbers"), std::string::npos);
    slowest = std::max(slowest, steady_seconds() - sent);
  }
  EXPECT_LT(slowest, 1);  // all twelve have it; only a bound against standing still, the machine may be busy
  const auto after = served.server.statistics();
  EXPECT_EQ(after.event_streams, 16);
  EXPECT_GT(after.frames_dropped, 4 * frames / 2);
  EXPECT_LE(after.frames_dropped, 4 * frames);
  // One of the deaf listens at last: what is old is gone, the latest and every alarm are there.
  served.server.publish("numbers", "\"last\"");
  const std::string late = deaf[0]->until("\"last\"");
  for (const int id : {25, 50, 75, 100})
    EXPECT_NE(late.find("event: alarm\ndata: {\"id\":" + std::to_string(id) + "}"), std::string::npos) << id;
  std::size_t seen = 0;
  for (auto position = late.find("event: numbers"); position != std::string::npos;
       position      = late.find("event: numbers", position + 1))
    ++seen;
  EXPECT_LT(seen, frames / 2);
}

TEST(PageServer, RefusesTheThirtyThirdConnection)
{
  Served served;
  const int port = served.server.port();
  std::vector<std::unique_ptr<RawClient>> held;
  for (int k = 0; k < 32; ++k) {
    held.push_back(std::make_unique<RawClient>(port));
    held.back()->send("GET ");
  }
  EXPECT_TRUE(comes_true([&] { return served.server.statistics().connections == 32; }));
  EXPECT_EQ(ask(port, get_request(port, "/")).status, 503);
  held.clear();
  EXPECT_TRUE(comes_true([&] { return ask(port, get_request(port, "/")).status == 200; }));
}

TEST(PageServer, AnotherMachineNeedsATokenThatWasGiven)
{
  auto settings    = Served::at_any_port();
  settings.address = "0.0.0.0";
  EXPECT_EQ(refusal([&] { Served served(settings); }),
            "--listen: 0.0.0.0 is reached from other machines, so a token is needed that its users know: add "
            "--token-file FILE");
  settings.token       = "0123456789abcdefghijklmnop";
  settings.token_given = true;
  Served served(settings);
  EXPECT_EQ(served.server.notice(),
            "the page at 0.0.0.0:" + std::to_string(served.server.port()) +
                " is not encrypted: whoever is on the way reads it and its token; put a TLS "
                "proxy in front");
  EXPECT_EQ(ask(served.server.port(), get_request(served.server.port(), "/")).status, 200);
  settings.token = "0123456789abcdefghijk";
  EXPECT_EQ(
      refusal([&] { Served again(settings); }),
      "a token is 22 to 256 letters, digits, - _ . ~ without blanks (128 bit and more); `openssl rand -hex 24` "
      "makes one");
}

// A disk that is full, in the form of a folder that is not there: the page works, with a token of this start
// alone.
TEST(PageServer, ATokenThatCannotBeKeptIsReported)
{
  auto settings         = Served::at_any_port();
  settings.token_keeper = own_folder() + "/nowhere/page.token";
  Served served(settings);
  EXPECT_EQ(served.server.notice(),
            settings.token_keeper + ": error: the token of the page cannot be kept for the next start; after its "
                                    "next start the page has another address");
  EXPECT_EQ(ask(served.server.port(), get_request(served.server.port(), "/stand", served.with_token())).status,
            200);
}

TEST(PageServer, AnAddressThatCannotBeUsedIsExplained)
{
  auto settings    = Served::at_any_port();
  settings.address = "localhost";
  EXPECT_EQ(refusal([&] { Served served(settings); }),
            "--listen: 'localhost' is not a literal address; write for example 127.0.0.1 or ::1");
  settings         = Served::at_any_port();
  settings.address = "127.0.0.1";
  Served first;
  settings.port = first.server.port();
  EXPECT_EQ(
      refusal([&] { Served second(settings); }),
      "--listen: port " + std::to_string(first.server.port()) +
          " of 127.0.0.1 is taken, perhaps by another millstand live; another port, or 0 for any that is free");
  settings.port = 70000;
  EXPECT_EQ(refusal([&] { Served second(settings); }), "--listen: port 70000 is not in 0 .. 65535");
}

TEST(PageServer, TokensAreLongKeptAndGuarded)
{
  EXPECT_EQ(mill::web::made_token().size(), 43u);
  EXPECT_NE(mill::web::made_token(), mill::web::made_token());
  auto settings         = Served::at_any_port();
  settings.token_keeper = own_folder() + "/page.token";
  std::string first;
  {
    Served served(settings);
    first = served.server.token();
    EXPECT_EQ(served.server.url(), "http://127.0.0.1:" + std::to_string(served.server.port()) + "/#" + first);
  }
  struct stat facts {};
  ASSERT_EQ(stat(settings.token_keeper.c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 0777, 0600u);
  EXPECT_EQ(Served(settings).server.token(), first);
  fs::permissions(settings.token_keeper, fs::perms::others_read, fs::perm_options::add);
  EXPECT_NE(Served(settings).server.token(), first);  // others could have read it

  const std::string path = own_folder() + "/given.token";
  std::ofstream(path) << "0123456789abcdefghijklmnop\n";
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(mill::web::token_of_file(path), "0123456789abcdefghijklmnop");
  fs::permissions(path, fs::perms::group_read, fs::perm_options::add);
  EXPECT_EQ(refusal([&] { mill::web::token_of_file(path); }),
            "others than its owner may read the token; chmod 600 it");
  std::ofstream(path) << "short\n";
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(
      refusal([&] { mill::web::token_of_file(path); }),
      "a token is 22 to 256 letters, digits, - _ . ~ without blanks (128 bit and more); `openssl rand -hex 24` "
      "makes one");
  EXPECT_EQ(refusal([&] { mill::web::token_of_file(own_folder()); }),
            "is not a file; the token must be the first line of a file");
  fs::remove_all(own_folder());
}
