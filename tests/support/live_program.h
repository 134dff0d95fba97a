#pragma once
#include <string>
#include <sys/types.h>
#include <vector>

/// Words of a command that runs the built `millstand live`; without --listen its page is at a port that is free.
std::vector<std::string> live_words(const std::vector<std::string> &arguments);

/// `millstand live`, or a script that ends in it, as processes of their own (one group), with the page that it
/// says.
class LiveProgram {
public:
  /// Waits until it has said its page.
  /// @param words   program and arguments;  @param folder  for what it prints
  /// @throws std::runtime_error  with all that it printed, when it ended instead or said nothing for 20 s
  LiveProgram(std::vector<std::string> words, const std::string &folder);
  ~LiveProgram();  ///< kills it, if it runs
  LiveProgram(const LiveProgram &)            = delete;
  LiveProgram &operator=(const LiveProgram &) = delete;

  /// Onto its standard input.
  void send(const std::string &text);
  /// Sends a signal to the group, as Ctrl-C does (0: closes the standard input alone), and waits for the end of
  /// the first process.  @return its exit code, 128 + a signal
  int end(int signal);

  const std::string &url() const;    ///< "http://127.0.0.1:41234/#token"
  const std::string &token() const;  ///< what stands behind the #
  int port() const;
  pid_t process() const;
  std::string printed() const;
  /// Value of a counter at /metrics; -1: there is none.
  long counter(const std::string &name) const;

private:
  pid_t pid_ = -1;
  int input_ = -1;
  std::string log_, url_, token_;
  int port_ = 0;
};
