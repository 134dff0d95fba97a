#pragma once
#include <string>

namespace mill::web {
/// Head and body of an answer as they go over the line, with the lines that tell a browser what a page may not do.
/// @param policy      Content-Security-Policy; empty: nothing but files of this server
/// @param more_lines  further lines of the head, each with its end "\r\n"
std::string http_answer(int status, const std::string &type, const std::string &body, bool keep,
                        const std::string &more_lines = "", const std::string &policy = "");
/// Head of a stream of server-sent events, and the time (1 s) after which a browser comes again.
std::string event_stream_head();
/// {"error": "..."}
std::string error_json(const std::string &message);
}  // namespace mill::web
