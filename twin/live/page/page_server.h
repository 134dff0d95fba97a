#pragma once
#include "twin/web/server/page_server.h"
#include <functional>
#include <memory>
#include <string>

namespace mill::live {
using web::PageSettings;
using web::PageStatistics;

struct CommandReply {
  int status = 200;  ///< 200 done, 202 begun (an event follows), 400 refused with {"error": "..."}, 409 not now
  std::string json = "{}";
};

/// Files and routes of the page of the live twin.
///   GET  /  /page.css  /*.js  /icon.svg   the page, compiled in
///   GET  /stand                           what the page draws (stand_text), token
///   GET  /events                          server-sent events, token
///   GET  /metrics                         OpenMetrics text, no token
///   POST /command                         JSON, token
const web::PageTable &page_table();
/// Alarms, proposals, parameters and advice are never dropped; of the first two all that are open and, of the
/// others, the last ones up to 200 in all are kept for a browser that connects later.
const web::EventKinds &event_kinds();

/// Serves the page of the live twin.
class PageServer {
public:
  /// Listens when it returns.
  /// @param stand_json  stand_text() of event_text.h
  /// @param command     takes the JSON of a command (page_command() reads it); runs in the thread of the server,
  ///                    so it hands long work on and returns at once
  /// @param metrics     OpenMetrics text without the closing "# EOF"; same thread
  /// @throws InputError  as web::PageServer
  PageServer(const PageSettings &settings, std::string stand_json,
             std::function<CommandReply(const std::string &json_body)> command,
             std::function<std::string()> metrics);
  ~PageServer();  ///< closes every connection
  PageServer(const PageServer &)            = delete;
  PageServer &operator=(const PageServer &) = delete;

  /// Another stand_text(), when more is known of it; who shows the old one reads it with the next "parameters".
  /// From any thread.
  void set_stand(std::string stand_json);

  /// Sends an event to every browser.  From any thread; returns at once.  Fits live::Publish.
  /// @param event  a name of event_names (event_text.h)
  void publish(const std::string &event, const std::string &json);

  int port() const;
  const std::string &token() const;
  std::string url() const;     ///< "http://127.0.0.1:8460/#<token>"
  std::string notice() const;  ///< as web::PageServer
  PageStatistics statistics() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};
}  // namespace mill::live
