#include "twin/live/page/page_server.h"
#include <gtest/gtest.h>

namespace live = mill::live;
namespace web  = mill::web;

namespace {
const std::string token = "0123456789abcdefghijklmnop";

web::RequestRules rules()
{
  return {web::host_lines({"127.0.0.1", "localhost", "[::1]", "mill-3.example.com", "proxy:9000"}, 8460), token};
}

web::RequestHead head(const std::string &method, const std::string &target,
                      const std::string &host = "127.0.0.1:8460")
{
  web::RequestHead out;
  out.method       = method;
  out.target       = target;
  out.host         = {host};
  out.content_type = "application/json";
  out.token        = token;
  return out;
}

int status(const web::RequestHead &request)
{
  return web::judge(request, rules(), live::page_table()).status;
}
}  // namespace

TEST(PageRules, HostIsComparedAsAWhole)
{
  for (const char *host : {"127.0.0.1:8460", "127.0.0.1", "localhost:8460", "LOCALHOST", "[::1]:8460", "[::1]",
                           "mill-3.example.com", "mill-3.example.com:8460", "proxy:9000"})
    EXPECT_EQ(status(head("GET", "/", host)), 200) << host;
  for (const char *host : {"127.evil.example",
                           "127.0.0.1.evil.example",
                           "127.0.0.1:8461",
                           "127.0.0.1:84600",
                           "127.0.0.1:8460.evil.example",
                           "127.0.0.2",
                           "127.1",
                           "2130706433",
                           "0.0.0.0",
                           "localhost.",
                           "localhost.evil.example",
                           "evil.example",
                           "mill-3.example.com.evil.example",
                           "proxy",
                           "proxy:8460",
                           "[::1",
                           "::1",
                           "[::]",
                           "",
                           " ",
                           "127.0.0.1:8460 ",
                           "user@127.0.0.1:8460",
                           "http://127.0.0.1:8460"})
    EXPECT_EQ(status(head("GET", "/", host)), 403) << host;
  auto two = head("GET", "/");
  two.host = {"127.0.0.1", "127.0.0.1"};
  EXPECT_EQ(status(two), 400);
  two.host = {};
  EXPECT_EQ(status(two), 400);
}

TEST(PageRules, OriginIsAbsentOrTheOneAsked)
{
  auto request = head("POST", "/command");
  for (const char *own : {"http://127.0.0.1:8460", "https://127.0.0.1:8460"}) {
    request.origin = {own};
    EXPECT_EQ(status(request), 200) << own;
  }
  for (const char *foreign : {"http://localhost:8460", "http://127.0.0.1", "http://127.0.0.1:9000", "null", "",
                              "*", "http://evil.example", "http://127.0.0.1:8460.evil.example", "file://"}) {
    request.origin = {foreign};
    EXPECT_EQ(status(request), 403) << foreign;
  }
  request.origin = {"http://127.0.0.1:8460", "http://evil.example"};
  EXPECT_EQ(status(request), 403);
}

TEST(PageRules, PathsAreATable)
{
  for (const auto &file : live::page_table().files) {
    const auto verdict = web::judge(head("GET", file.path), rules(), live::page_table());
    EXPECT_EQ(verdict.status, 200) << file.path;
    ASSERT_NE(verdict.file, nullptr);
    EXPECT_GT(std::string(verdict.file->text).size(), 100u) << file.path;
  }
  for (const char *path :
       {"/../", "/..%2f..%2fetc/passwd", "//", "/page.js/", "/page.js/..", "/PAGE.JS", "/index.html", "/%2e%2e/",
        "page.js", "", "*", "http://127.0.0.1:8460/", "/events/", "/command/x", "/.git"})
    EXPECT_EQ(status(head("GET", path)), 404) << path;
}

TEST(PageRules, MethodTokenAndTypeAreAskedFor)
{
  for (const char *method : {"POST", "HEAD", "OPTIONS", "PUT", "DELETE", "TRACE", "CONNECT", "get"})
    EXPECT_EQ(status(head(method, "/stand")), 405) << method;
  EXPECT_EQ(web::judge(head("GET", "/command"), rules(), live::page_table()).allow, "POST");

  auto request = head("POST", "/command");
  for (const std::string &wrong :
       {std::string(), token + "x", token.substr(1), std::string("0123456789abcdefghijklmnoP")}) {
    request.token = wrong;
    EXPECT_EQ(status(request), 401) << wrong;
  }
  auto events  = head("GET", "/events?token=" + token);
  events.token = "";
  EXPECT_EQ(status(events), 200);
  events.target = "/events?token=" + token + "&x=1";
  EXPECT_EQ(status(events), 401);
  auto stand  = head("GET", "/stand?token=" + token);  // a query names the token of /events alone
  stand.token = "";
  EXPECT_EQ(status(stand), 401);
  auto metrics  = head("GET", "/metrics");
  metrics.token = "";
  EXPECT_EQ(status(metrics), 200);

  request.token = token;
  for (const char *type : {"application/json", "Application/JSON; charset=utf-8", "application/json ;x"}) {
    request.content_type = type;
    EXPECT_EQ(status(request), 200) << type;
  }
  for (const char *type : {"text/plain", "", "application/jsonp", "application/x-www-form-urlencoded",
                           "text/plain; application/json", "application/json, text/plain"}) {
    request.content_type = type;
    EXPECT_EQ(status(request), 415) << type;
  }
}

TEST(PageRules, AnEmptyTokenOpensNothing)
{
  EXPECT_FALSE(web::same_token("", ""));
  EXPECT_FALSE(web::same_token(token, ""));
  EXPECT_TRUE(web::same_token(token, token));
}
