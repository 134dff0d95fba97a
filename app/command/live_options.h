#pragma once
#include <string>

namespace mill {
/// Options of `millstand live` as texts.
struct LiveOptions {
  std::string input;       ///< FILE.csv, tail:FILE.csv, -, tcp:ADDR:PORT, mqtt:HOST:PORT/STAND; empty: tcp
  std::string listen;      ///< of the page, ADDR:PORT, "none"; empty: 127.0.0.1:8460
  std::string record;      ///< folder; empty: nothing is recorded
  std::string keep;        ///< 24h, 50GB; empty: all
  std::string speed;       ///< of a replay, "1", "10", "max"
  std::string token_file;  ///< for page and data port
  std::string host;        ///< host name that a reverse proxy uses for the page
  std::string response;    ///< CSV of the twin's accelerations; empty: none
};
}  // namespace mill
