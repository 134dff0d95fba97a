#include "twin/web/server/page_server.h"
#include "core/base/errors.h"
#include "twin/web/server/page_connection.h"
#include <boost/asio.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <thread>

// Everything but publish() and statistics() runs in the thread of the server, so nothing here is locked.
namespace mill::web {
namespace {
namespace asio = boost::asio;
using asio::ip::tcp;
using Seconds = std::chrono::milliseconds;
using Failure = boost::system::error_code;

constexpr int most_connections = 32;
constexpr int most_refusals    = 16;  // connections beyond the limit that get the answer "too many"
constexpr Seconds heartbeat{10000};

// A program that this one starts gets no copy of a socket, which would hold the port after our end.
template <class Socket> void keep_to_ourselves(Socket &socket)
{
  fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC);
}

asio::ip::address literal_address(const std::string &text)
{
  Failure failure;
  const auto address = asio::ip::make_address(text, failure);
  if (failure)
    throw InputError(
        fmt::format("--listen: '{}' is not a literal address; write for example 127.0.0.1 or ::1", text));
  return address;
}
}  // namespace

struct PageServer::State {
  PageShared shared;  // outlives what runs in `io` and `slow`
  asio::io_context io{1};
  asio::thread_pool slow{2};
  tcp::acceptor acceptor{io};
  asio::steady_timer beat{io}, rest{io};
  std::string token, url, notice;
  int port = 0;
  std::thread thread;

  explicit State(PageSite site) : shared(std::move(site)) {}

  void listen(const PageSettings &settings, const asio::ip::address &address)
  {
    const tcp::endpoint endpoint(address, static_cast<unsigned short>(settings.port));
    Failure failure;
    const auto go = [&](auto step) {
      if (!failure)
        step();
    };
    acceptor.open(endpoint.protocol(), failure);
    go([&] { keep_to_ourselves(acceptor); });
    go([&] { acceptor.set_option(asio::socket_base::reuse_address(true), failure); });
    go([&] { acceptor.bind(endpoint, failure); });
    go([&] { acceptor.listen(64, failure); });
    if (failure == asio::error::address_in_use)
      throw InputError(fmt::format("--listen: port {} of {} is taken, perhaps by another {}; another port, "
                                   "or 0 for any that is free",
                                   settings.port, settings.address, shared.site.program));
    if (failure)
      throw InputError(fmt::format("--listen: cannot listen at {} port {}: {}", settings.address, settings.port,
                                   failure.message()));
    port = acceptor.local_endpoint().port();
  }

  void accept()
  {
    acceptor.async_accept([this](const Failure &failure, tcp::socket socket) {
      if (failure == asio::error::operation_aborted)
        return;
      if (failure) {  // out of file numbers, most likely: later there are some again
        rest.expires_after(Seconds(100));
        rest.async_wait([this](const Failure &stopped) {
          if (!stopped)
            accept();
        });
        return;
      }
      keep_to_ourselves(socket);
      const bool too_many = shared.connections >= most_connections;
      if (!too_many || shared.refusals < most_refusals)
        serve_connection(io, slow, socket.release(), acceptor_is_v6(), shared, too_many);
      else
        ++shared.refused;
      accept();
    });
  }

  bool acceptor_is_v6() const
  {
    Failure ignored;
    return acceptor.local_endpoint(ignored).address().is_v6();
  }

  // A comment line now and then: a connection whose other end has vanished shows when it is written to.
  void keep_alive()
  {
    static const auto comment = std::make_shared<const EventFrame>(EventFrame{"", ":\n\n", true});
    beat.expires_after(heartbeat);
    beat.async_wait([this](const Failure &stopped) {
      if (stopped)
        return;
      send_to_all(shared, comment);
      keep_alive();
    });
  }
};

PageServer::PageServer(const PageSettings &settings, PageSite site)
    : state_(std::make_unique<State>(std::move(site)))
{
  State &state       = *state_;
  const auto address = literal_address(settings.address);
  if (settings.port < 0 || settings.port > 65535)
    throw InputError(fmt::format("--listen: port {} is not in 0 .. 65535", settings.port));
  if (!address.is_loopback() && !settings.token_given)
    throw InputError(
        fmt::format("--listen: {} is reached from other machines, so a token is needed that its users know: "
                    "add --token-file FILE",
                    settings.address));
  try {
    state.token = page_token(settings);
  } catch (const std::exception &problem) {
    if (!settings.token.empty())
      throw;
    state.token  = made_token();  // a full disk does not keep the page away
    state.notice = std::string(problem.what()) + "; after its next start the page has another address";
  }
  state.listen(settings, address);
  const std::string literal = address.is_v6() ? "[" + address.to_string() + "]" : address.to_string();
  state.url                 = fmt::format("http://{}:{}/#{}", literal, state.port, state.token);
  if (!address.is_loopback())
    state.notice =
        fmt::format("the page at {}:{} is not encrypted: whoever is on the way reads it and its token; put a "
                    "TLS proxy in front",
                    literal, state.port);
  std::vector<std::string> names{"127.0.0.1", "localhost", "[::1]", literal};
  names.insert(names.end(), settings.hosts.begin(), settings.hosts.end());
  PageShared &shared = state.shared;
  shared.rules       = {host_lines(names, state.port), state.token};
  shared.port        = state.port;
  state.accept();
  state.keep_alive();
  state.thread = std::thread([&state] { state.io.run(); });
}

PageServer::~PageServer()
{
  state_->slow.join();  // an answer that is on its way is finished
  state_->io.stop();
  if (state_->thread.joinable())
    state_->thread.join();
}

void PageServer::publish(const std::string &event, const std::string &json)
{
  asio::post(state_->io, [state = state_.get(), event, json] {
    PageShared &shared = state->shared;
    const auto frame   = shared.store.add(event, json);
    shared.forgotten   = shared.store.forgotten();
    send_to_all(shared, frame);
  });
}

int PageServer::port() const
{
  return state_->port;
}

const std::string &PageServer::token() const
{
  return state_->token;
}

std::string PageServer::url() const
{
  return state_->url;
}

std::string PageServer::notice() const
{
  return state_->notice;
}

PageStatistics PageServer::statistics() const
{
  const PageShared &shared = state_->shared;
  return {shared.open_connections, shared.open_streams, shared.frames_sent, shared.frames_dropped,
          shared.requests,         shared.refused,      shared.forgotten};
}
}  // namespace mill::web
