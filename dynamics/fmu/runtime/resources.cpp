#include "resources.h"
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#ifdef _WIN32
#include <windows.h>
#endif

namespace mill::fmu {
namespace {
int hex_digit(const char c)
{
  if (c >= '0' && c <= '9')
    return c - '0';
  if (c >= 'a' && c <= 'f')
    return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::string decoded(const std::string &text)
{
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += text[i];
      continue;
    }
    const int high = i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
    const int low  = i + 2 < text.size() ? hex_digit(text[i + 2]) : -1;
    if (high < 0 || low < 0)
      throw std::runtime_error("resourceLocation " + text + " has a % without two hexadecimal digits");
    out += char(16 * high + low);
    i += 2;
  }
  return out;
}

bool begins(const std::string &text, const char *prefix)
{
  return text.compare(0, std::strlen(prefix), prefix) == 0;
}

// fopen for a path in UTF-8.
std::FILE *open_for_reading(const std::string &path)
{
#ifdef _WIN32
  const int n = MultiByteToWideChar(CP_UTF8, 0, path.c_str(), -1, nullptr, 0);
  std::wstring wide(std::size_t(n > 0 ? n : 1), L'\0');
  MultiByteToWideChar(CP_UTF8, 0, path.c_str(), -1, &wide[0], n);
  return _wfopen(wide.c_str(), L"rb");
#else
  return std::fopen(path.c_str(), "rb");
#endif
}
}  // namespace

std::string folder_of_path(const std::string &path)
{
  std::string folder = path;
  while (folder.size() > 1 && (folder.back() == '/' || folder.back() == '\\'))
    folder.pop_back();
  return folder + "/";
}

std::string folder_of_uri(const std::string &uri)
{
  if (!begins(uri, "file:")) {
    const std::size_t scheme = uri.find("://");
    if (scheme != std::string::npos)
      throw std::runtime_error("resourceLocation " + uri + " is not a file: URI");
    return folder_of_path(uri);
  }
  std::string path = uri.substr(5);
  if (begins(path, "//localhost/"))
    path = path.substr(11);
  else if (begins(path, "///"))
    path = path.substr(2);
  path = decoded(path);
#ifdef _WIN32
  if (path.size() > 2 && path[0] == '/' && path[2] == ':')  // "/C:/folder"
    path = path.substr(1);
#endif
  return folder_of_path(path);
}

std::string read_file(const std::string &path)
{
  errno = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE *)> file(open_for_reading(path), std::fclose);
  if (!file)
    throw std::runtime_error("cannot read " + path + (errno ? std::string(": ") + std::strerror(errno) : ""));
  std::string text;
  char block[65536];
  for (std::size_t n; (n = std::fread(block, 1, sizeof block, file.get())) > 0;)
    text.append(block, n);
  if (std::ferror(file.get()))
    throw std::runtime_error("cannot read " + path + ": the disk gives an error");
  return text;
}
}  // namespace mill::fmu
