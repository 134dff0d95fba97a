#pragma once
#include <string>

namespace mill {
/// Options of `millstand studio` as texts.
struct StudioOptions {
  std::string listen;      ///< of the page, ADDR:PORT; empty: 127.0.0.1:8470, any free port where it is taken
  std::string token_file;  ///< for the page; empty: a token is made
  std::string host;        ///< host name that a reverse proxy uses for the page
};
}  // namespace mill
