#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace mill::web {
// What a request must be before anything is done about it; no sockets here.

/// What is compiled in, by the path under which it is asked for.
struct PageFile {
  const char *path;  ///< "/page.js"
  const char *type;  ///< "text/javascript; charset=utf-8"
  const char *text;
};

/// A path that is not a file.
struct PageRoute {
  std::string path;               ///< "/stand"
  std::string method = "GET";     ///< or POST, whose body is JSON
  bool token         = true;      ///< the request needs the token
  bool query_token   = false;     ///< a browser opens it without headers: the token may stand in the query
  bool below         = false;     ///< every path below it belongs to it too, "/run/7/report.html"
  bool events        = false;     ///< a stream of server-sent events
  bool slow          = false;     ///< answered in one of two threads, so that the server goes on
  std::size_t body   = 64 << 10;  ///< bytes of a body, at most
};

/// All paths of a page.
struct PageTable {
  std::vector<PageFile> files;
  std::vector<PageRoute> routes;
};

/// The parts of a request head that the rules look at.
struct RequestHead {
  std::string method;               ///< "GET"
  std::string target;               ///< "/events?token=..."
  std::vector<std::string> host;    ///< every Host line
  std::vector<std::string> origin;  ///< every Origin line
  std::string content_type;         ///< empty: none
  std::string token;                ///< of X-Millstand-Token or Authorization: Bearer; empty: none
};

struct RequestRules {
  std::vector<std::string> hosts;  ///< lower case, "127.0.0.1:8460"
  std::string token;
};

struct RequestVerdict {
  int status           = 200;  ///< 200: go on; otherwise the answer
  const PageFile *file = nullptr;
  std::size_t route    = 0;  ///< number in PageTable::routes, where the route is not a file
  std::string path;          ///< without the query
  std::string error;         ///< one sentence, of a status that is not 200
  std::string allow;         ///< of 405
};

/// In this order: one Host line, one of the list (400, 403); Origin absent or that of the Host (403); path in the
/// table (404), method (405), token (401), application/json of a POST (415).
RequestVerdict judge(const RequestHead &head, const RequestRules &rules, const PageTable &table);

/// Host lines under which a server is asked: each name without and with the port.
/// @param names  "127.0.0.1", "[::1]"; one with a port of its own is taken as it is
std::vector<std::string> host_lines(const std::vector<std::string> &names, int port);

/// Takes the same time wherever the two differ.
bool same_token(const std::string &given, const std::string &right);
}  // namespace mill::web
