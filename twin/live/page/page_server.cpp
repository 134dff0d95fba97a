#include "twin/live/page/page_server.h"
#include "twin/live/page/embedded.h"
#include "twin/live/page/event_text.h"
#include "twin/live/page/proposal_state.h"
#include <fmt/format.h>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

namespace mill::live {
namespace {
enum Route : std::size_t { stand_route, events_route, metrics_route, command_route };

web::PageRoute stream_of_events()
{
  web::PageRoute route{"/events"};
  route.query_token = true;
  route.events      = true;
  return route;
}

// Of an alarm or a proposal.
bool is_over(const nlohmann::json &data)
{
  const auto over = data.find("over"), state = data.find("state");
  return over != data.end() ? *over == true : state == data.end() || *state != word_of(ProposalState::open);
}

std::string with_statistics(std::string text, const PageStatistics &statistics)
{
  const auto row = [&](const char *name, const char *type, const char *ending, const std::int64_t value) {
    text += fmt::format("# TYPE millstand_page_{0} {1}\nmillstand_page_{0}{2} {3}\n", name, type, ending, value);
  };
  row("event_streams", "gauge", "", statistics.event_streams);
  row("frames_sent", "counter", "_total", statistics.frames_sent);
  row("frames_dropped", "counter", "_total", statistics.frames_dropped);
  row("requests", "counter", "_total", statistics.requests);
  row("requests_refused", "counter", "_total", statistics.requests_refused);
  row("history_forgotten", "counter", "_total", statistics.forgotten);
  return text + "# EOF\n";
}
}  // namespace

const web::PageTable &page_table()
{
  static const char *const script = "text/javascript; charset=utf-8";
  static const web::PageTable table{
      {
          {"/", "text/html; charset=utf-8", embedded::index_html},
          {"/theme.css", "text/css; charset=utf-8", embedded::theme_css},
          {"/page.css", "text/css; charset=utf-8", embedded::page_css},
          {"/page.js", script, embedded::page_js},
          {"/canvas.js", script, embedded::canvas_js},
          {"/stand.js", script, embedded::stand_js},
          {"/charts.js", script, embedded::charts_js},
          {"/histories.js", script, embedded::histories_js},
          {"/tables.js", script, embedded::tables_js},
          {"/answers.js", script, embedded::answers_js},
          {"/icon.svg", "image/svg+xml", embedded::icon_svg},
      },
      {{"/stand"}, stream_of_events(), {"/metrics", "GET", false}, {"/command", "POST"}}};
  return table;
}

const web::EventKinds &event_kinds()
{
  static const web::EventKinds kinds{
      {event_names::alarm, event_names::proposal, event_names::parameters, event_names::advice},
      {event_names::alarm, event_names::proposal},
      is_over};
  return kinds;
}

struct PageServer::State {
  std::mutex access;
  std::string stand;
  std::function<CommandReply(const std::string &)> command;
  std::function<std::string()> metrics;
  std::optional<web::PageServer> server;

  web::PageReply answer(const web::PageRequest &request)
  {
    if (request.route == command_route) {
      const CommandReply reply = command(request.body);
      return {reply.status, reply.json};
    }
    const std::lock_guard lock(access);
    if (request.route == metrics_route)
      return {200, with_statistics(metrics_text(), server->statistics()),
              "application/openmetrics-text; version=1.0.0; charset=utf-8"};
    return {200, stand};
  }
  std::string metrics_text() const
  {
    try {
      return metrics();
    } catch (const std::exception &) {
      return "";
    }
  }
};

PageServer::PageServer(const PageSettings &settings, std::string stand_json,
                       std::function<CommandReply(const std::string &)> command,
                       std::function<std::string()> metrics)
    : state_(std::make_unique<State>())
{
  state_->stand   = std::move(stand_json);
  state_->command = std::move(command);
  state_->metrics = std::move(metrics);
  const std::lock_guard lock(state_->access);  // a request that comes at once waits for the server
  state_->server.emplace(
      settings, web::PageSite{"millstand live", page_table(), event_kinds(),
                              [state = state_.get()](const web::PageRequest &r) { return state->answer(r); }});
}

PageServer::~PageServer() = default;

void PageServer::set_stand(std::string stand_json)
{
  const std::lock_guard lock(state_->access);
  state_->stand = std::move(stand_json);
}

void PageServer::publish(const std::string &event, const std::string &json)
{
  state_->server->publish(event, json);
}

int PageServer::port() const
{
  return state_->server->port();
}

const std::string &PageServer::token() const
{
  return state_->server->token();
}

std::string PageServer::url() const
{
  return state_->server->url();
}

std::string PageServer::notice() const
{
  return state_->server->notice();
}

PageStatistics PageServer::statistics() const
{
  return state_->server->statistics();
}
}  // namespace mill::live
