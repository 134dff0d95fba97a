#include "twin/web/server/page_connection.h"
#include "core/base/errors.h"
#include "twin/web/server/http_answer.h"
#include <algorithm>
#include <boost/asio.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <fmt/format.h>
#include <optional>

// One connection of the page: requests, answers, events.  All of it runs in the thread of the server, so nothing
// here is locked.
namespace mill::web {
namespace {
namespace asio = boost::asio;
namespace http = boost::beast::http;
using asio::ip::tcp;
using Seconds = std::chrono::milliseconds;
using Failure = boost::system::error_code;

constexpr std::size_t header_limit  = 8 * 1024;
constexpr std::size_t buffer_limit  = header_limit + 80 * 1024;  // of what is read and not yet parsed
constexpr std::size_t smallest_body = 64 << 10;
constexpr int most_streams          = 16;
constexpr int send_buffer           = 64 * 1024;  // bytes: what lies in the system's buffer is late already
constexpr Seconds request_time{5000}, answer_time{5000}, stream_time{30000}, farewell_time{1000};

// Runs one step at a time against one deadline.
class Deadline {
public:
  explicit Deadline(const tcp::socket::executor_type &executor) : timer_(executor) {}

  template <class Owner, class Late> void set(const Seconds time, const std::shared_ptr<Owner> &owner, Late late)
  {
    const auto mine = ++number_;
    timer_.expires_after(time);
    timer_.async_wait([this, mine, owner, late](const Failure &failure) {
      if (!failure && mine == number_)
        late();
    });
  }
  void clear()
  {
    ++number_;
    timer_.cancel();
  }

private:
  asio::steady_timer timer_;
  std::uint64_t number_ = 0;
};

PageReply reply_to(const PageSite &site, const PageRequest &request)
{
  try {
    return site.answer(request);
  } catch (const InputError &mistake) {
    return {400, error_json(mistake.problems.empty() ? mistake.what() : mistake.problems.front().message)};
  } catch (const std::exception &) {  // the answer stands; the program goes on
    return {500, error_json("the program failed; its log says why")};
  }
}
}  // namespace

class PageConnection : public std::enable_shared_from_this<PageConnection> {
public:
  PageConnection(tcp::socket socket, asio::thread_pool &slow, PageShared &shared, const bool too_many)
      : socket_(std::move(socket)), slow_(slow), deadline_(socket_.get_executor()), shared_(shared),
        too_many_(too_many)
  {
    ++(too_many_ ? shared_.refusals : shared_.connections);
    shared_.open_connections = shared_.connections;
  }
  ~PageConnection()
  {
    --(too_many_ ? shared_.refusals : shared_.connections);
    shared_.open_connections = shared_.connections;
    leave_streams();
  }
  PageConnection(const PageConnection &)            = delete;
  PageConnection &operator=(const PageConnection &) = delete;

  void start()
  {
    Failure ignored;
    socket_.set_option(tcp::no_delay(true), ignored);
    if (too_many_)
      refuse(503, "there are 32 connections already", "Retry-After: 2\r\n");
    else
      read_head();
  }

  void push(const FramePointer &frame)
  {
    const auto before = queue_.dropped();
    queue_.push(frame);
    shared_.frames_dropped += queue_.dropped() - before;
    if (queue_.overfull())
      close();
    else
      send_frames();
  }

  void close()
  {
    Failure ignored;
    deadline_.clear();
    socket_.close(ignored);
    leave_streams();
  }

private:
  // -- one request ---------------------------------------------------------------------------------------------
  void read_head()
  {
    late_ = false;
    parser_.emplace();
    parser_->header_limit(header_limit);
    parser_->body_limit(smallest_body);  // until the route is known
    deadline_.set(request_time, shared_from_this(), [this] {
      late_ = true;
      Failure ignored;
      socket_.cancel(ignored);
    });
    http::async_read_header(
        socket_, buffer_, *parser_,
        [self = shared_from_this()](const Failure &failure, std::size_t) { self->got_head(failure); });
  }

  void got_head(const Failure &failure)
  {
    if (failure)
      return cannot_read(failure);
    const auto verdict = judge(request_head(), rules_here(), shared_.site.table);
    if (verdict.status != 200)
      return refuse(verdict.status, verdict.error,
                    !verdict.allow.empty()  ? "Allow: " + verdict.allow + "\r\n"
                    : verdict.status == 401 ? "WWW-Authenticate: Bearer\r\n"
                                            : "");
    verdict_ = verdict;
    if (!verdict.file)
      parser_->body_limit(route().body);
    if (parser_->content_length() && *parser_->content_length() > body_limit())
      return refuse_body();
    if (http::token_list{parser_->get()[http::field::expect]}.exists("100-continue")) {
      static const std::string go_on = "HTTP/1.1 100 Continue\r\n\r\n";
      asio::async_write(socket_, asio::buffer(go_on),
                        [self = shared_from_this()](const Failure &broken, std::size_t) {
                          if (broken)
                            self->close();
                          else
                            self->read_body();
                        });
    } else {
      read_body();
    }
  }

  void read_body()
  {
    http::async_read(socket_, buffer_, *parser_, [self = shared_from_this()](const Failure &failure, std::size_t) {
      if (failure)
        self->cannot_read(failure);
      else
        self->answer();
    });
  }

  void cannot_read(const Failure &failure)
  {
    if (late_ && (parser_->got_some() || buffer_.size() > 0))
      return refuse(408, "a request has five seconds");
    if (failure == http::error::header_limit || failure == http::error::buffer_overflow)
      return refuse(431, "the head of a request has at most 8 kB");
    if (failure == http::error::body_limit)
      return refuse_body();
    if (failure != http::error::end_of_stream && failure != http::error::partial_message &&
        failure.category() == http::make_error_code(http::error::end_of_stream).category())
      return refuse(400, "this is not a request of HTTP/1.1");
    close();
  }

  const PageRoute &route() const
  {
    return shared_.site.table.routes[verdict_.route];
  }

  std::size_t body_limit() const
  {
    return verdict_.file ? smallest_body : route().body;
  }

  void refuse_body()
  {
    refuse(413, fmt::format("the body of a request has at most {} kB", body_limit() >> 10));
  }

  RequestHead request_head() const
  {
    const auto &request = parser_->get();
    const auto all      = [&](const http::field field) {
      std::vector<std::string> lines;
      const auto range = request.equal_range(field);
      for (auto entry = range.first; entry != range.second; ++entry)
        lines.emplace_back(entry->value());
      return lines;
    };
    RequestHead head;
    head.method              = std::string(request.method_string());
    head.target              = std::string(request.target());
    head.host                = all(http::field::host);
    head.origin              = all(http::field::origin);
    head.content_type        = std::string(request[http::field::content_type]);
    head.token               = std::string(request["X-Millstand-Token"]);
    const std::string bearer = "Bearer ", authorization(request[http::field::authorization]);
    if (head.token.empty() && authorization.compare(0, bearer.size(), bearer) == 0)
      head.token = authorization.substr(bearer.size());
    return head;
  }

  // A browser may also name the very address at which it arrived, where the server listens on all of them.
  RequestRules rules_here() const
  {
    RequestRules rules = shared_.rules;
    Failure unknown_address;
    const auto here = socket_.local_endpoint(unknown_address).address();
    if (!unknown_address) {
      const std::string name = here.is_v6() ? "[" + here.to_string() + "]" : here.to_string();
      for (std::string &line : host_lines({name}, shared_.port))
        rules.hosts.push_back(std::move(line));
    }
    return rules;
  }

  // -- answers -------------------------------------------------------------------------------------------------
  void answer()
  {
    if (verdict_.file)
      return respond({200, verdict_.file->text, verdict_.file->type});
    if (route().events)
      return begin_stream();
    PageRequest request{verdict_.route, verdict_.path, std::move(parser_->get().body())};
    if (!route().slow)
      return respond(reply_to(shared_.site, request));
    deadline_.clear();
    // Handed over and not kept: the connection ends in the thread of the server, whose counts and streams it
    // changes.
    asio::post(slow_, [self = shared_from_this(), request = std::move(request)]() mutable {
      const auto back = self->socket_.get_executor();
      auto reply      = reply_to(self->shared_.site, request);
      asio::post(back, [self = std::move(self), reply = std::move(reply)] {
        if (self->socket_.is_open())
          self->respond(reply);
      });
    });
  }

  void refuse(const int status, const std::string &message, const std::string &more_lines = "")
  {
    ++shared_.refused;
    send(http_answer(status, "application/json", error_json(message), false, more_lines), false);
  }

  void respond(const PageReply &reply)
  {
    ++(reply.status < 400 ? shared_.requests : shared_.refused);
    const bool keep = parser_->get().keep_alive();
    send(http_answer(reply.status, reply.type, reply.body, keep, "", reply.policy), keep);
  }

  void send(std::string text, const bool keep)
  {
    answer_ = std::move(text);
    deadline_.set(answer_time, shared_from_this(), [this] { close(); });
    asio::async_write(socket_, asio::buffer(answer_),
                      [self = shared_from_this(), keep](const Failure &failure, std::size_t) {
                        if (failure)
                          self->close();
                        else if (keep)
                          self->read_head();
                        else
                          self->say_farewell();
                      });
  }

  // What was not read would make the system reset the connection before the other side has read the answer.
  void say_farewell()
  {
    Failure ignored;
    socket_.shutdown(tcp::socket::shutdown_send, ignored);
    deadline_.set(farewell_time, shared_from_this(), [this] { close(); });
    read_and_forget();
  }

  void read_and_forget()
  {
    socket_.async_read_some(asio::buffer(forgotten_),
                            [self = shared_from_this()](const Failure &failure, std::size_t) {
                              if (failure)
                                self->close();
                              else
                                self->read_and_forget();
                            });
  }

  // -- events --------------------------------------------------------------------------------------------------
  void begin_stream()
  {
    if (shared_.streams.size() >= most_streams)
      return refuse(503, "there are 16 browsers already", "Retry-After: 5\r\n");
    ++shared_.requests;
    shared_.streams.insert(this);
    shared_.open_streams = int(shared_.streams.size());
    Failure ignored;
    socket_.set_option(asio::socket_base::send_buffer_size(send_buffer), ignored);
    answer_  = event_stream_head();
    sending_ = shared_.store.present_state();
    read_and_forget();  // so that a browser that goes is noticed
    write_frames();
  }

  void send_frames()
  {
    if (busy_ || queue_.empty())
      return;
    sending_ = queue_.take();
    answer_.clear();
    write_frames();
  }

  void write_frames()
  {
    busy_ = true;
    std::vector<asio::const_buffer> pieces{asio::buffer(answer_)};
    for (const FramePointer &frame : sending_)
      pieces.push_back(asio::buffer(frame->text));
    deadline_.set(stream_time, shared_from_this(), [this] { close(); });
    asio::async_write(socket_, pieces, [self = shared_from_this()](const Failure &failure, std::size_t) {
      self->busy_ = false;
      self->deadline_.clear();
      if (failure)
        return self->close();
      self->shared_.frames_sent += std::int64_t(self->sending_.size());
      self->sending_.clear();
      self->send_frames();
    });
  }

  void leave_streams()
  {
    shared_.streams.erase(this);
    shared_.open_streams = int(shared_.streams.size());
  }

  tcp::socket socket_;
  asio::thread_pool &slow_;
  Deadline deadline_;
  PageShared &shared_;
  bool too_many_;
  bool late_ = false, busy_ = false;
  boost::beast::flat_buffer buffer_{buffer_limit};
  std::optional<http::request_parser<http::string_body>> parser_;
  RequestVerdict verdict_;
  std::string answer_;
  char forgotten_[1024];
  FrameQueue queue_;
  std::vector<FramePointer> sending_;
};

void serve_connection(asio::io_context &io, asio::thread_pool &slow, const int accepted, const bool v6,
                      PageShared &shared, const bool too_many)
{
  tcp::socket socket(io, v6 ? tcp::v6() : tcp::v4(), accepted);
  std::make_shared<PageConnection>(std::move(socket), slow, shared, too_many)->start();
}

void send_to_all(PageShared &shared, const FramePointer &frame)
{
  const std::vector<PageConnection *> all(shared.streams.begin(), shared.streams.end());  // push() may close one
  for (PageConnection *stream : all)
    if (shared.streams.count(stream))
      stream->push(frame);
}
}  // namespace mill::web
