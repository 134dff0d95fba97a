#include "twin/web/server/page_rules.h"
#include <algorithm>

namespace mill::web {
namespace {
std::string lower_case(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
                 [](const unsigned char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : char(c); });
  return text;
}

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
  return query.rfind(name, 0) == 0 ? query.substr(name.size()) : "";
}

bool is_json(const std::string &content_type)
{
  std::string type = lower_case(content_type.substr(0, content_type.find(';')));
  while (!type.empty() && (type.back() == ' ' || type.back() == '\t'))
    type.pop_back();
  return type == "application/json";
}

const PageRoute *route_of(const PageTable &table, const std::string &path)
{
  const auto row = std::find_if(table.routes.begin(), table.routes.end(), [&](const PageRoute &r) {
    return path == r.path || (r.below && path.rfind(r.path + "/", 0) == 0);
  });
  return row == table.routes.end() ? nullptr : &*row;
}

RequestVerdict judge_route(const RequestHead &head, const RequestRules &rules, const PageTable &table)
{
  const auto mark         = head.target.find('?');
  const std::string path  = head.target.substr(0, mark);
  const std::string query = mark == std::string::npos ? "" : head.target.substr(mark + 1);
  RequestVerdict out;
  out.path               = path;
  const PageRoute *route = route_of(table, path);
  if (route) {
    out.route = std::size_t(route - table.routes.data());
  } else {
    const auto file =
        std::find_if(table.files.begin(), table.files.end(), [&](const PageFile &f) { return path == f.path; });
    if (file == table.files.end())
      return refused(404, "there is nothing at this path");
    out.file = &*file;
  }
  const std::string method = route ? route->method : "GET";
  if (head.method != method) {
    auto wrong  = refused(405, "this path takes another method");
    wrong.allow = method;
    return wrong;
  }
  std::string token = head.token;
  if (token.empty() && route && route->query_token)
    token = token_of_query(query);
  if (route && route->token && !same_token(token, rules.token))
    return refused(401,
                   "the token is missing or is not that of the running program; open the address that it printed");
  if (method == "POST" && !is_json(head.content_type))
    return refused(415, "Content-Type application/json is needed");
  return out;
}
}  // namespace

RequestVerdict judge(const RequestHead &head, const RequestRules &rules, const PageTable &table)
{
  if (head.host.size() != 1)
    return refused(400, "one Host line is needed");
  const std::string host = lower_case(head.host.front());
  if (std::find(rules.hosts.begin(), rules.hosts.end(), host) == rules.hosts.end())
    return refused(403, "this Host is not in the list of names of this program");
  for (const std::string &line : head.origin) {
    const std::string origin = lower_case(line);
    const std::string plain = "http://" + host, secure = "https://" + host;
    if (origin != plain && origin != secure)
      return refused(403, "requests from pages of another origin are refused");
  }
  return judge_route(head, rules, table);
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
}  // namespace mill::web
