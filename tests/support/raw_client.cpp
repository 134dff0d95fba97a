#include "tests/support/raw_client.h"
#include <arpa/inet.h>
#include <chrono>
#include <cstdlib>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

double steady_seconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

RawClient::RawClient(const int port, const int receive_buffer)
    : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0))
{
  if (receive_buffer > 0)
    setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  sockaddr_in address{};
  address.sin_family      = AF_INET;
  address.sin_port        = htons(static_cast<unsigned short>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(socket_, reinterpret_cast<const sockaddr *>(&address), sizeof address) != 0) {
    close(socket_);
    socket_ = -1;
  }
}

RawClient::~RawClient()
{
  if (socket_ >= 0)
    close(socket_);
}

bool RawClient::connected() const
{
  return socket_ >= 0;
}

bool RawClient::send(const std::string &text)
{
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::send(socket_, text.data() + done, text.size() - done, MSG_NOSIGNAL);
    if (n <= 0)
      return false;
    done += std::size_t(n);
  }
  return true;
}

void RawClient::end_of_sending()
{
  shutdown(socket_, SHUT_WR);
}

bool RawClient::read_more(const double deadline)
{
  pollfd wait{socket_, POLLIN, 0};
  const int left = int((deadline - steady_seconds()) * 1000);
  if (left <= 0 || poll(&wait, 1, left) <= 0)
    return false;
  char bytes[65536];
  const ssize_t n = recv(socket_, bytes, sizeof bytes, 0);
  if (n <= 0)
    return false;
  unread_.append(bytes, std::size_t(n));
  return true;
}

std::string RawClient::rest(const double seconds)
{
  const double deadline = steady_seconds() + seconds;
  while (read_more(deadline)) {
  }
  return std::move(unread_);
}

std::string RawClient::until(const std::string &mark, const double seconds)
{
  const double deadline = steady_seconds() + seconds;
  std::size_t found     = std::string::npos;
  while ((found = unread_.find(mark)) == std::string::npos && read_more(deadline)) {
  }
  const std::size_t end = found == std::string::npos ? unread_.size() : found + mark.size();
  const std::string out = unread_.substr(0, end);
  unread_.erase(0, end);
  return out;
}

std::string RawClient::exactly(const std::size_t bytes, const double seconds)
{
  const double deadline = steady_seconds() + seconds;
  while (unread_.size() < bytes && read_more(deadline)) {
  }
  const std::string out = unread_.substr(0, bytes);
  unread_.erase(0, out.size());
  return out;
}

namespace {
HttpAnswer taken_apart(const std::string &text)
{
  HttpAnswer answer;
  const auto end = text.find("\r\n\r\n");
  if (text.compare(0, 9, "HTTP/1.1 ") != 0 || end == std::string::npos)
    return answer;
  answer.status = std::atoi(text.c_str() + 9);
  answer.head   = text.substr(0, end + 2);
  answer.body   = text.substr(end + 4);
  return answer;
}
}  // namespace

HttpAnswer ask(const int port, const std::string &request, const double seconds)
{
  RawClient client(port);
  client.send(request);
  return taken_apart(client.rest(seconds));
}

HttpAnswer ask(RawClient &client, const std::string &request, const double seconds)
{
  client.send(request);
  std::string text      = client.until("\r\n\r\n", seconds);
  const std::string key = "Content-Length:";
  const auto position   = text.find(key);
  if (position != std::string::npos)
    text += client.exactly(std::size_t(std::atol(text.c_str() + position + key.size())), seconds);
  return taken_apart(text);
}

std::string get_request(const int port, const std::string &target, const std::string &more_lines)
{
  return "GET " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\nConnection: close\r\n" +
         more_lines + "\r\n";
}

std::string post_request(const int port, const std::string &target, const std::string &body,
                         const std::string &more_lines)
{
  return "POST " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
         "\r\nConnection: close\r\nContent-Length: " + std::to_string(body.size()) + "\r\n" + more_lines + "\r\n" +
         body;
}
