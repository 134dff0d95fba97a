// The bytes of one connection to the server of a page, over a socket of this machine.  Nothing is done without the
// token, and the server answers the next one.
#include "tests/fuzz/fuzz_file.h"
#include "twin/web/server/page_server.h"
#include <arpa/inet.h>
#include <cstdlib>
#include <cstring>
#include <netinet/in.h>
#include <sys/socket.h>

namespace {
mill::web::PageServer &server()
{
  static mill::web::PageServer one = [] {
    mill::web::PageSettings settings;
    settings.port  = 0;
    settings.hosts = {"mill"};
    mill::web::PageSite site;
    site.program      = "fuzz";
    site.table.files  = {{"/", "text/html", "<p>page</p>"}};
    site.table.routes = {
        {"/stand"}, {"/command", "POST"}, {"/run", "GET", true, true, true}, {"/metrics", "GET", false}};
    site.answer = [](const mill::web::PageRequest &request) {
      if (request.route != 3)
        std::abort();  // done without the token
      return mill::web::PageReply{};
    };
    return mill::web::PageServer(settings, site);
  }();
  return one;
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  const int client = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family      = AF_INET;
  address.sin_port        = htons(std::uint16_t(server().port()));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (client < 0 || ::connect(client, reinterpret_cast<sockaddr *>(&address), sizeof address) != 0)
    std::abort();  // the server is gone
  ::send(client, data, size, MSG_NOSIGNAL);
  ::shutdown(client, SHUT_WR);
  char answer[4096];
  while (::recv(client, answer, sizeof answer, 0) > 0)
    continue;
  ::close(client);
  return 0;
}
