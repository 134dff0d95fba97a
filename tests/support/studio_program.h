#pragma once
#include "tests/support/live_program.h"
#include "tests/support/raw_client.h"
#include <cstdlib>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

// The built `millstand studio` as a process of its own, asked as the page asks.
class StudioProgram {
public:
  /// @param folder  with the case `stand.toml`, or without it; the runs are below it
  StudioProgram(const std::string &folder, const std::string &listen = "127.0.0.1:0",
                const std::vector<std::string> &more = {})
  {
    std::vector<std::string> words{MILLSTAND_PROGRAM, "studio", folder + "/stand.toml", "-o", folder + "/runs",
                                   "--listen",        listen};
    words.insert(words.end(), more.begin(), more.end());
    program_ = std::make_unique<LiveProgram>(words, folder);
  }
  HttpAnswer answer(const std::string &path, const std::string &body, const double seconds = 20) const
  {
    return ask(program_->port(),
               post_request(program_->port(), path, body,
                            "X-Millstand-Token: " + program_->token() + "\r\nContent-Type: application/json\r\n"),
               seconds);
  }
  nlohmann::json post(const std::string &path, const nlohmann::json &body) const
  {
    const HttpAnswer reply = answer(path, body.dump());
    return reply.status == 200 || reply.status == 202
               ? nlohmann::json::parse(reply.body)
               : nlohmann::json{{"status", reply.status}, {"refused", reply.body}};
  }
  nlohmann::json get(const std::string &path) const
  {
    const HttpAnswer reply =
        ask(program_->port(),
            get_request(program_->port(), path, "X-Millstand-Token: " + program_->token() + "\r\n"), 20);
    return reply.status == 200 ? nlohmann::json::parse(reply.body)
                               : nlohmann::json{{"status", reply.status}, {"refused", reply.body}};
  }
  nlohmann::json edit(const std::string &id, const std::string &key, const std::string &value) const
  {
    return post("/check", {{"edits", {{{"id", id}, {"key", key}, {"value", value}}}}});
  }
  LiveProgram &program()
  {
    return *program_;
  }

private:
  std::unique_ptr<LiveProgram> program_;
};

/// tests/reference/studio-sheet.csv, as it is pasted.
inline std::string text_of_sheet()
{
  std::ifstream in(std::string(MILLSTAND_SOURCE_DIR) + "/tests/reference/studio-sheet.csv");
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Rows of tests/reference/studio-sheet.csv: 31 values of a stand, as one reads them from drawings; [[pass]] by
/// its number.
inline std::vector<std::pair<std::string, std::string>> sheet_of_paper()
{
  std::ifstream in(std::string(MILLSTAND_SOURCE_DIR) + "/tests/reference/studio-sheet.csv");
  std::vector<std::pair<std::string, std::string>> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const auto comma = line.find(',');
    std::string key  = line.substr(0, comma);
    if (key.rfind("pass.", 0) == 0)
      key = "pass.0." + key.substr(5);
    rows.emplace_back(key, line.substr(comma + 1));
  }
  return rows;
}
