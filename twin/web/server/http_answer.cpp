#include "twin/web/server/http_answer.h"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mill::web {
namespace {
// No line of CORS: what is not said is not allowed.
const char *const own_files = "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
const char *const security_lines = "X-Content-Type-Options: nosniff\r\n"
                                   "Referrer-Policy: no-referrer\r\n"
                                   "Cross-Origin-Resource-Policy: same-origin\r\n"
                                   "Cache-Control: no-store\r\n";

const char *reason(const int status)
{
  switch (status) {
  case 200:
    return "OK";
  case 202:
    return "Accepted";
  case 400:
    return "Bad Request";
  case 401:
    return "Unauthorized";
  case 403:
    return "Forbidden";
  case 404:
    return "Not Found";
  case 405:
    return "Method Not Allowed";
  case 408:
    return "Request Timeout";
  case 409:
    return "Conflict";
  case 413:
    return "Payload Too Large";
  case 415:
    return "Unsupported Media Type";
  case 431:
    return "Request Header Fields Too Large";
  case 500:
    return "Internal Server Error";
  case 503:
    return "Service Unavailable";
  default:
    return "Other";
  }
}
}  // namespace

std::string http_answer(const int status, const std::string &type, const std::string &body, const bool keep,
                        const std::string &more_lines, const std::string &policy)
{
  return fmt::format("HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\n"
                     "Content-Security-Policy: {}\r\n{}{}Connection: {}\r\n\r\n{}",
                     status, reason(status), type, body.size(), policy.empty() ? own_files : policy,
                     security_lines, more_lines, keep ? "keep-alive" : "close", body);
}

std::string event_stream_head()
{
  return fmt::format("HTTP/1.1 200 OK\r\nContent-Type: text/event-stream; charset=utf-8\r\n"
                     "Content-Security-Policy: {}\r\n{}Connection: close\r\n\r\nretry: 1000\n\n",
                     own_files, security_lines);
}

std::string error_json(const std::string &message)
{
  return nlohmann::json{{"error", message}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}
}  // namespace mill::web
