#include "twin/live/page/page_rules.h"
#include "twin/live/page/embedded.h"
#include <algorithm>

namespace mill::live {
namespace {
std::string lower_case(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
                 [](const unsigned char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : char(c); });
  return text;
}

// One row for each path that is not a file.
struct RouteRow {
  const char *path;
  PageRoute route;
  const char *method;
  bool token;
};
constexpr RouteRow route_rows[] = {
    {"/stand", PageRoute::stand, "GET", true},
    {"/events", PageRoute::events, "GET", true},
    {"/metrics", PageRoute::metrics, "GET", false},
    {"/command", PageRoute::command, "POST", true},
};

RequestVerdict refused(const int status, const char *error)
{
  RequestVerdict out;
  out.status = status;
  out.error  = error;
  return out;
}

// "token=T" of "/events?token=T"; the only thing that a query may hold.
std::string token_of_query(const std::string &query)
{
  const std::string name = "token=";
  return query.compare(0, name.size(), name) == 0 ? query.substr(name.size()) : "";
}

bool is_json(const std::string &content_type)
{
  std::string type = lower_case(content_type.substr(0, content_type.find(';')));
  while (!type.empty() && (type.back() == ' ' || type.back() == '\t'))
    type.pop_back();
  return type == "application/json";
}

RequestVerdict judge_route(const RequestHead &head, const RequestRules &rules)
{
  const auto mark         = head.target.find('?');
  const std::string path  = head.target.substr(0, mark);
  const std::string query = mark == std::string::npos ? "" : head.target.substr(mark + 1);
  RequestVerdict out;
  std::string method = "GET";
  bool needs_token   = false;
  const auto row     = std::find_if(std::begin(route_rows), std::end(route_rows),
                                    [&](const RouteRow &r) { return path == r.path; });
  if (row != std::end(route_rows)) {
    out.route   = row->route;
    method      = row->method;
    needs_token = row->token;
  } else {
    const auto file =
        std::find_if(page_files().begin(), page_files().end(), [&](const PageFile &f) { return path == f.path; });
    if (file == page_files().end())
      return refused(404, "there is nothing at this path");
    out.file = &*file;
  }
  if (head.method != method) {
    auto wrong  = refused(405, "this path takes another method");
    wrong.allow = method;
    return wrong;
  }
  std::string token = head.token;
  if (token.empty() && out.route == PageRoute::events)
    token = token_of_query(query);
  if (needs_token && !same_token(token, rules.token))
    return refused(401,
                   "the token is missing or is not that of the running program; open the address that it printed");
  if (out.route == PageRoute::command && !is_json(head.content_type))
    return refused(415, "Content-Type application/json is needed");
  return out;
}
}  // namespace

const std::vector<PageFile> &page_files()
{
  static const char *const script = "text/javascript; charset=utf-8";
  static const std::vector<PageFile> all{
      {"/", "text/html; charset=utf-8", embedded::index_html},
      {"/page.css", "text/css; charset=utf-8", embedded::page_css},
      {"/page.js", script, embedded::page_js},
      {"/canvas.js", script, embedded::canvas_js},
      {"/stand.js", script, embedded::stand_js},
      {"/charts.js", script, embedded::charts_js},
      {"/histories.js", script, embedded::histories_js},
      {"/tables.js", script, embedded::tables_js},
      {"/answers.js", script, embedded::answers_js},
      {"/icon.svg", "image/svg+xml", embedded::icon_svg},
  };
  return all;
}

RequestVerdict judge(const RequestHead &head, const RequestRules &rules)
{
  if (head.host.size() != 1)
    return refused(400, "one Host line is needed");
  const std::string host = lower_case(head.host.front());
  if (std::find(rules.hosts.begin(), rules.hosts.end(), host) == rules.hosts.end())
    return refused(403, "this Host is not in the list of names of this program");
  for (const std::string &line : head.origin) {
    const std::string origin = lower_case(line);
    if (origin != "http://" + host && origin != "https://" + host)
      return refused(403, "requests from pages of another origin are refused");
  }
  return judge_route(head, rules);
}

std::vector<std::string> host_lines(const std::vector<std::string> &names, const int port)
{
  std::vector<std::string> out;
  for (const std::string &name : names) {
    out.push_back(lower_case(name));
    const auto colon   = name.rfind(':');
    const bool literal = !name.empty() && name.back() == ']';  // an IPv6 address has colons inside its brackets
    if (colon == std::string::npos || literal)
      out.push_back(lower_case(name) + ":" + std::to_string(port));
  }
  return out;
}

bool same_token(const std::string &given, const std::string &right)
{
  unsigned different = given.size() == right.size() ? 0 : 1;
  for (std::size_t i = 0; i < right.size(); ++i)
    different |= unsigned(static_cast<unsigned char>(right[i])) ^
                 unsigned(static_cast<unsigned char>(i < given.size() ? given[i] : 0));
  return different == 0 && !right.empty();
}
}  // namespace mill::live
