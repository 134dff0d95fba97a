#pragma once
#include "twin/live/page/event_frames.h"
#include "twin/live/page/page_rules.h"
#include "twin/live/page/page_server.h"
#include <atomic>
#include <cstdint>
#include <functional>
#include <set>
#include <string>

namespace boost {
namespace asio {
class io_context;
}
}  // namespace boost

namespace mill::live {
class PageConnection;

/// What all connections of a page server share.  In its thread, but for the counts.
struct PageShared {
  RequestRules rules;  ///< without the address at which a connection arrived
  int port = 0;
  std::string stand;
  std::function<CommandReply(const std::string &)> command;
  std::function<std::string()> metrics;
  FrameStore store;
  std::set<PageConnection *> streams;
  int connections = 0, refusals = 0;
  std::atomic<int> open_connections{0}, open_streams{0};
  std::atomic<std::int64_t> frames_sent{0}, frames_dropped{0}, requests{0}, refused{0};
};

/// Answers the requests of an accepted connection until one side closes it.
/// @param accepted  socket, which is taken over
/// @param too_many  the connection gets this answer only
void serve_connection(boost::asio::io_context &io, int accepted, bool v6, PageShared &shared, bool too_many);

/// To every stream of events that is open.
void send_to_all(PageShared &shared, const FramePointer &frame);
}  // namespace mill::live
