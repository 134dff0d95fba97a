#pragma once
#include "twin/web/server/event_frames.h"
#include "twin/web/server/page_rules.h"
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace mill::web {
struct PageSettings {
  std::string address = "127.0.0.1";  ///< literal address; any but a loopback one needs a token that was given
  int port            = 8460;         ///< 0: any that is free
  std::string token;                  ///< empty: made (at least 128 bit)
  bool token_given = false;           ///< the user named the token (--token-file)
  /// Where a made token is kept for the next start, so that a page that is open finds a restarted program again;
  /// written with mode 0600.  Empty: a new token at every start.
  std::string token_keeper;
  std::vector<std::string>
      hosts;  ///< "mill-3.example.com": further names, of a TLS proxy in front, by which browsers ask
};

/// A request that the rules have let through.
struct PageRequest {
  std::size_t route = 0;  ///< number in PageTable::routes
  std::string path;       ///< "/run/7/report.html"
  std::string body;       ///< of a POST
};

struct PageReply {
  int status = 200;  ///< 200 done, 202 begun (an event follows), 400 refused with {"error": ".."}, 409 not now
  std::string body   = "{}";
  std::string type   = "application/json";
  std::string policy = "";  ///< Content-Security-Policy of a page with scripts of its own; empty: the strict one
};

/// What a server serves.
struct PageSite {
  std::string program;  ///< "millstand live", for messages
  PageTable table;
  EventKinds events;
  /// Answers a route that is not a stream; a slow one in one of two threads, the others in the thread of the
  /// server, which all browsers wait for.  An InputError is answered with status 400.
  std::function<PageReply(const PageRequest &request)> answer;
};

struct PageStatistics {
  int connections               = 0;  ///< now
  int event_streams             = 0;  ///< now
  std::int64_t frames_sent      = 0;
  std::int64_t frames_dropped   = 0;  ///< display frames that a slow browser did not take in time
  std::int64_t requests         = 0;  ///< answered with 2xx
  std::int64_t requests_refused = 0;  ///< answered with 4xx or 5xx, or cut off by a limit
  std::int64_t forgotten        = 0;  ///< of the histories: a browser that connects now does not get them
};

/// Serves a page: its files, a fixed table of routes, one stream of events for each browser.
/// One thread of its own, and two for slow answers; every operation has a time limit.
/// The token travels as "X-Millstand-Token: T", "Authorization: Bearer T", or as "?token=T" where the route says
/// so. Limits: header 8 kB, body as the route says, 32 connections, 16 event streams, 5 s for a request, 30 s for
/// a browser that takes nothing.  A slow browser has the two latest display frames waiting; older ones are dropped
/// and counted.  Events that the site names whole are never dropped.
class PageServer {
public:
  /// Listens when it returns.
  /// @throws InputError  the address is not a literal, is not of this machine, is taken, is not loopback and no
  /// token was given; the token has less than 128 bit (22 characters)
  PageServer(const PageSettings &settings, PageSite site);
  ~PageServer();  ///< closes every connection
  PageServer(const PageServer &)            = delete;
  PageServer &operator=(const PageServer &) = delete;

  /// Sends an event to every browser, and keeps what later browsers need (EventKinds).  From any thread; returns
  /// at once.
  void publish(const std::string &event, const std::string &json);

  int port() const;
  const std::string &token() const;
  std::string url() const;  ///< "http://127.0.0.1:8460/#<token>"
  /// What has to be said of an address that is not loopback, or of a token that cannot be kept; empty otherwise.
  std::string notice() const;
  PageStatistics statistics() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The token of these settings: given, kept from an earlier start, or made (and kept).
/// @throws InputError  shorter than 22 characters; SystemError  it cannot be kept
std::string page_token(const PageSettings &settings);
/// 43 characters of 258 random bits from the system.
std::string made_token();
/// First line of a file, at least 22 characters of printable ASCII without blanks.
/// @throws InputError  file cannot be read, is readable by others than its owner, holds a short token
std::string token_of_file(const std::string &path);
}  // namespace mill::web
