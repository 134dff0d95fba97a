#include "core/base/errors.h"
#include "core/base/files.h"
#include "twin/web/server/page_server.h"
#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

namespace mill::web {
namespace {
const char *const token_rule = "a token is 22 to 256 letters, digits, - _ . ~ without blanks (128 bit and more); "
                               "`openssl rand -hex 24` makes one";

bool is_token(const std::string &text)
{
  return text.size() >= 22 && text.size() <= 256 && std::all_of(text.begin(), text.end(), [](const char c) {
           return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' ||
                  c == '_' || c == '.' || c == '~';
         });
}

// A new file that only its owner reads; what stood at this path is replaced and not followed.
void keep_token(const std::string &path, const std::string &token)
{
  const std::string aside = name_aside(path);
  const int file          = open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
  const std::string line  = token + "\n";
  bool kept               = file >= 0 && write(file, line.data(), line.size()) == ssize_t(line.size());
  int error               = errno;
  if (file >= 0 && close(file) != 0 && kept) {
    kept  = false;
    error = errno;
  }
  if (kept && std::rename(aside.c_str(), path.c_str()) != 0) {
    kept  = false;
    error = errno;
  }
  if (!kept) {
    std::remove(aside.c_str());
    refuse_file(error, {path, 0, 0}, "the token of the page cannot be kept for the next start");
  }
}
}  // namespace

std::string page_token(const PageSettings &settings)
{
  if (!settings.token.empty()) {
    if (!is_token(settings.token))
      throw InputError(token_rule);
    return settings.token;
  }
  if (settings.token_keeper.empty())
    return made_token();
  try {
    return token_of_file(settings.token_keeper);
  } catch (const InputError &) {  // none yet, or one that others could have read
    const std::string token = made_token();
    keep_token(settings.token_keeper, token);
    return token;
  }
}

std::string made_token()
{
  static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  constexpr int characters    = 43;  // of six bits each
  std::uint8_t bytes[characters];
  if (getrandom(bytes, sizeof bytes, 0) != ssize_t(sizeof bytes))
    refuse_file(errno, "the system gives no random bytes for a token");
  std::string token;
  for (const std::uint8_t byte : bytes)
    token += letters[byte & 63];
  return token;
}

std::string token_of_file(const std::string &path)
{
  struct stat facts;
  if (stat(path.c_str(), &facts) != 0)
    refuse_file(errno, {path, 0, 0}, "the token cannot be read");
  if (!S_ISREG(facts.st_mode))
    throw InputError({path, 0, 0}, "is not a file; the token must be the first line of a file");
  if (facts.st_mode & (S_IRWXG | S_IRWXO))
    throw InputError({path, 0, 0}, "others than its owner may read the token; chmod 600 it");
  std::ifstream in(path);
  std::string token;
  std::getline(in, token);
  if (!token.empty() && token.back() == '\r')
    token.pop_back();
  if (!is_token(token))
    throw InputError({path, 1, 1}, token_rule);
  return token;
}
}  // namespace mill::web
