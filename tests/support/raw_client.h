#pragma once
#include <string>

/// One TCP connection to a server on this machine, byte by byte: what a browser never sends can be sent.
class RawClient {
public:
  /// @param receive_buffer  bytes the system keeps for what was not read; 0: its own choice
  explicit RawClient(int port, int receive_buffer = 0);
  ~RawClient();
  RawClient(const RawClient &)            = delete;
  RawClient &operator=(const RawClient &) = delete;

  bool connected() const;
  /// False when the other side has closed.
  bool send(const std::string &text);
  /// Says that no more will be sent; answers still come.
  void end_of_sending();
  /// What comes until the other side closes or the time is over.
  std::string rest(double seconds = 3);
  /// What comes until `mark` is among it, the other side closes or the time is over.
  std::string until(const std::string &mark, double seconds = 3);
  /// So many bytes, fewer when the other side closes or the time is over.
  std::string exactly(std::size_t bytes, double seconds = 3);

private:
  bool read_more(double deadline);
  int socket_ = -1;
  std::string unread_;
};

/// Seconds of a clock that never goes back.
double steady_seconds();

struct HttpAnswer {
  int status = 0;    ///< 0: none came
  std::string head;  ///< with its line ends
  std::string body;
};
/// One request with "Connection: close" in it or an answer that closes.
HttpAnswer ask(int port, const std::string &request, double seconds = 3);
/// The same for an answer with Content-Length on a connection that stays.
HttpAnswer ask(RawClient &client, const std::string &request, double seconds = 3);

/// A request as a browser would make it, "Connection: close".
std::string get_request(int port, const std::string &target, const std::string &more_lines = "");
std::string post_request(int port, const std::string &target, const std::string &body,
                         const std::string &more_lines = "");
