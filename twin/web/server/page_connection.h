#pragma once
#include "twin/web/server/event_frames.h"
#include "twin/web/server/page_rules.h"
#include "twin/web/server/page_server.h"
#include <atomic>
#include <cstdint>
#include <set>
#include <string>

namespace boost {
namespace asio {
class io_context;
class thread_pool;
}  // namespace asio
}  // namespace boost

namespace mill::web {
class PageConnection;

/// What all connections of a page server share.  In its thread, but for the counts.
struct PageShared {
  explicit PageShared(PageSite served) : site(std::move(served)), store(site.events) {}
  const PageSite site;
  RequestRules rules;  ///< without the address at which a connection arrived
  int port = 0;
  FrameStore store;
  std::set<PageConnection *> streams;
  int connections = 0, refusals = 0;
  std::atomic<int> open_connections{0}, open_streams{0};
  std::atomic<std::int64_t> frames_sent{0}, frames_dropped{0}, requests{0}, refused{0}, forgotten{0};
};

/// Answers the requests of an accepted connection until one side closes it.
/// @param slow  threads of the answers that take long
/// @param accepted  socket, which is taken over
/// @param too_many  the connection gets this answer only
void serve_connection(boost::asio::io_context &io, boost::asio::thread_pool &slow, int accepted, bool v6,
                      PageShared &shared, bool too_many);

/// To every stream of events that is open.
void send_to_all(PageShared &shared, const FramePointer &frame);
}  // namespace mill::web
