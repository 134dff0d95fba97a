#include "twin/live/source/data_port.h"
#include "core/base/errors.h"
#include <atomic>
#include <boost/asio.hpp>
#include <chrono>
#include <deque>
#include <fmt/format.h>
#include <netinet/tcp.h>
#include <set>
#include <sys/socket.h>
#include <thread>

namespace mill::live {
namespace {
namespace asio = boost::asio;
using Tcp      = asio::ip::tcp;
using Error    = boost::system::error_code;

constexpr std::size_t most_clients = 4;
constexpr std::chrono::seconds patience{5};
constexpr std::chrono::milliseconds full_queue_waits{5}, rest_without_numbers{100};
// s of silence after which the system asks for a sign of life, s between two questions, questions without an
// answer after which it closes the connection; ms that an answer of ours is repeated.
constexpr int asks_after = 30, asks_every = 10, asks = 3, repeats = 60'000;

// A sender that has vanished without a word, by loss of power or of the network, is gone after a minute.
void notice_its_end(Tcp::socket &socket)
{
  Error ignored;
  socket.set_option(asio::socket_base::keep_alive(true), ignored);
  const auto set = [&](const int option, const int value) {
    ::setsockopt(socket.native_handle(), IPPROTO_TCP, option, &value, sizeof value);
  };
  set(TCP_KEEPIDLE, asks_after);
  set(TCP_KEEPINTVL, asks_every);
  set(TCP_KEEPCNT, asks);
  set(TCP_USER_TIMEOUT, repeats);
}
}  // namespace

class DataClient;

struct DataPort::State {
  explicit State(SampleQueue &samples) : queue(samples), acceptor(io), rest(io) {}
  asio::io_context io{1};
  SampleQueue &queue;
  Tcp::acceptor acceptor;
  asio::steady_timer rest;
  SourceRules rules;
  std::string notice;
  std::set<std::shared_ptr<DataClient>> clients;
  DataClient *sender = nullptr;      // whose head was taken
  std::atomic<bool> sending{false};  // there is one
  std::string sender_name;
  std::thread thread;

  void accept();
};

// One connection: a line is read, judged, put into the queue and answered before the next one is looked at.
class DataClient : public std::enable_shared_from_this<DataClient> {
public:
  DataClient(DataPort::State &state, Tcp::socket socket)
      : state_(state), socket_(std::move(socket)), deadline_(state.io), retry_(state.io), session_(state.rules)
  {
    Error error;
    const auto remote = socket_.remote_endpoint(error);
    name_             = error ? "?" : fmt::format("{}:{}", remote.address().to_string(), remote.port());
    notice_its_end(socket_);
    socket_.set_option(Tcp::no_delay(true), error);
  }

  void start()
  {
    limit_time();
    read();
  }
  void refuse_and_close(const std::string &reply)
  {
    closing_ = true;
    answer(reply);
  }
  void close()
  {
    if (closed_)
      return;
    closed_ = true;
    Error ignored;
    deadline_.cancel(ignored);
    retry_.cancel(ignored);
    socket_.shutdown(Tcp::socket::shutdown_both, ignored);
    socket_.close(ignored);
    if (state_.sender == this) {
      state_.sender  = nullptr;
      state_.sending = false;
      Message note   = SourceNote{"connection", fmt::format("{} ({}) has gone", state_.sender_name, name_)};
      state_.queue.try_push(note);
    }
    state_.clients.erase(shared_from_this());
  }

private:
  void limit_time()
  {
    deadline_.expires_after(patience);
    deadline_.async_wait([self = shared_from_this()](const Error &error) {
      if (!error)
        self->close();
    });
  }
  void unlimited()
  {
    deadline_.cancel();
  }

  void read()
  {
    if (closed_)
      return;
    if (session_.has_head() && cutter_.rest().empty())
      unlimited();  // a source may be silent between two lines
    else if (!timed_line_) {
      timed_line_ = true;
      limit_time();
    }
    socket_.async_read_some(
        asio::buffer(bytes_),
        [self = shared_from_this()](const Error &error, const std::size_t n) { self->on_read(error, n); });
  }
  void on_read(const Error &error, const std::size_t n)
  {
    if (error) {
      close();
      return;
    }
    cutter_.add({bytes_.data(), n}, [&](const std::string_view line) {
      lines_.emplace_back(line);
      timed_line_ = timed_line_ && !session_.has_head();  // before the head one limit holds for all
    });
    next_line();
  }
  void next_line()
  {
    if (closed_ || closing_)
      return;
    LineSession::Answer answer;
    while (!lines_.empty() && !answer.message && answer.reply.empty()) {  // blank lines say nothing
      answer = session_.take(lines_.front());
      lines_.pop_front();
    }
    if (!answer.message && answer.reply.empty()) {
      read();
      return;
    }
    closing_ = answer.close;
    reply_   = std::move(answer.reply);
    message_ = std::move(answer.message);
    if (message_ && std::holds_alternative<SourceHead>(*message_) && !may_send()) {
      message_.reset();
      closing_ = true;
      reply_   = fmt::format("{{\"rejected\":\"another source is sending from {}; one at a time\"}}",
                             state_.sender->name_);
    }
    pass_on();
  }
  bool may_send()
  {
    if (state_.sender && state_.sender != this)
      return false;
    const auto &head = std::get<SourceHead>(*message_);
    if (!state_.sender) {
      state_.sender      = this;
      state_.sending     = true;
      state_.sender_name = head.source.empty() ? "a source without a name" : head.source;
      Message note       = SourceNote{"connection", fmt::format("{} ({}) sends", state_.sender_name, name_)};
      state_.queue.try_push(note);
    }
    return true;
  }
  // Nothing is read while the queue is full.
  void pass_on()
  {
    if (closed_)
      return;
    if (message_ && !state_.queue.try_push(*message_)) {
      if (state_.queue.closed()) {
        close();
        return;
      }
      unlimited();
      retry_.expires_after(full_queue_waits);
      retry_.async_wait([self = shared_from_this()](const Error &error) {
        if (!error)
          self->pass_on();
      });
      return;
    }
    message_.reset();
    answer(reply_);
  }
  void answer(const std::string &text)
  {
    reply_ = text + "\n";
    limit_time();
    asio::async_write(socket_, asio::buffer(reply_), [self = shared_from_this()](const Error &error, std::size_t) {
      self->timed_line_ = false;
      self->reply_.clear();
      if (error || self->closing_)
        self->close();
      else
        self->next_line();
    });
  }

  DataPort::State &state_;
  Tcp::socket socket_;
  asio::steady_timer deadline_, retry_;
  LineSession session_;
  LineCutter cutter_;
  std::array<char, 1 << 16> bytes_{};
  std::deque<std::string> lines_;
  std::optional<Message> message_;
  std::string reply_, name_;
  bool closing_ = false, closed_ = false, timed_line_ = false;
};

void DataPort::State::accept()
{
  acceptor.async_accept([this](const Error &error, Tcp::socket socket) {
    if (error == asio::error::operation_aborted)
      return;
    if (error) {  // out of file numbers, most likely: later there are some again
      rest.expires_after(rest_without_numbers);
      rest.async_wait([this](const Error &stopped) {
        if (!stopped)
          accept();
      });
      return;
    }
    const auto client = std::make_shared<DataClient>(*this, std::move(socket));
    const bool room   = clients.size() < most_clients;
    if (room) {
      clients.insert(client);
      client->start();
    } else
      client->refuse_and_close(fmt::format("{{\"rejected\":\"{} clients are connected already\"}}", most_clients));
    accept();
  });
}

DataPort::DataPort(const DataPortSettings &settings, SampleQueue &queue) : state_(new State(queue))
{
  State &state = *state_;
  state.rules  = settings.rules;
  Error error;
  const auto address = asio::ip::make_address(settings.address, error);
  if (error)
    throw InputError(fmt::format(
        "--input tcp:{}: this is not a literal address; write for example 127.0.0.1 or ::1", settings.address));
  if (!address.is_loopback() && settings.rules.token.empty())
    throw InputError(
        fmt::format("--input tcp:{}:{}: this address is reached from other machines, so a token is needed "
                    "that the senders know: --token-file FILE",
                    settings.address, settings.port));
  if (!address.is_loopback())
    state.notice =
        fmt::format("the data port at {}:{} is not encrypted: whoever is on the way reads and changes what "
                    "is sent; put a TLS proxy in front",
                    settings.address, settings.port);
  const Tcp::endpoint endpoint(address, (unsigned short)settings.port);
  state.acceptor.open(endpoint.protocol(), error);
  if (!error)
    state.acceptor.set_option(Tcp::acceptor::reuse_address(true), error);
  if (!error)
    state.acceptor.bind(endpoint, error);
  if (!error)
    state.acceptor.listen(16, error);
  if (error == asio::error::address_in_use)
    throw InputError(fmt::format("--input tcp:{}:{}: the port is taken, perhaps by another millstand live; choose "
                                 "another one",
                                 settings.address, settings.port));
  if (error)
    throw InputError(
        fmt::format("--input tcp:{}:{}: cannot listen: {}", settings.address, settings.port, error.message()));
  state.accept();
  state.thread = std::thread([this] { state_->io.run(); });
}

DataPort::~DataPort()
{
  asio::post(state_->io, [this] {
    Error ignored;
    state_->acceptor.close(ignored);
    const auto all = state_->clients;
    for (const auto &client : all)
      client->close();
    state_->io.stop();
  });
  if (state_->thread.joinable())
    state_->thread.join();
}

bool DataPort::has_sender() const
{
  return state_->sending;
}

int DataPort::port() const
{
  Error ignored;
  return state_->acceptor.local_endpoint(ignored).port();
}

std::string DataPort::notice() const
{
  return state_->notice;
}
}  // namespace mill::live
