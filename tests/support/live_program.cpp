#include "tests/support/live_program.h"
#include "tests/support/raw_client.h"
#include "tests/support/slowness.h"
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <regex>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

std::vector<std::string> live_words(const std::vector<std::string> &arguments)
{
  std::vector<std::string> words{MILLSTAND_PROGRAM, "live"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  if (std::find(arguments.begin(), arguments.end(), "--listen") == arguments.end())
    words.insert(words.end(), {"--listen", "127.0.0.1:0"});
  return words;
}

LiveProgram::LiveProgram(std::vector<std::string> words, const std::string &folder)
    : log_(folder + "/printed-" + std::to_string(steady_seconds()))
{
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe");
  std::signal(SIGPIPE, SIG_IGN);  // send() to a program that has ended
  pid_ = fork();
  if (pid_ == 0) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int log = open(log_.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    dup2(ends[0], 0);
    dup2(log, 1);
    dup2(log, 2);
    std::vector<char *> argv;
    for (std::string &word : words)
      argv.push_back(word.data());
    argv.push_back(nullptr);
    execv(argv[0], argv.data());
    _exit(127);
  }
  setpgid(pid_, pid_);  // whichever of the two comes first
  close(ends[0]);
  input_ = ends[1];
  const std::regex address("http://127\\.0\\.0\\.1:([0-9]+)/#(\\S+)\n");
  for (const double until = steady_seconds() + 20 * slowness(); url_.empty();) {
    const std::string text = printed();
    if (std::smatch match; std::regex_search(text, match, address)) {
      url_   = match.str().substr(0, match.str().size() - 1);
      port_  = std::atoi(match[1].str().c_str());
      token_ = match[2];
    } else if (steady_seconds() > until || waitpid(pid_, nullptr, WNOHANG) == pid_) {
      throw std::runtime_error("millstand live has not said its page: " + text);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

LiveProgram::~LiveProgram()
{
  end(SIGKILL);
}

void LiveProgram::send(const std::string &text)
{
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = write(input_, text.data() + done, text.size() - done);
    if (n <= 0)
      throw std::runtime_error("millstand live takes no more: " + printed());
    done += std::size_t(n);
  }
}

int LiveProgram::end(const int signal)
{
  if (input_ >= 0)
    close(input_);
  input_ = -1;
  if (pid_ < 0)
    return 0;
  if (signal != 0)
    kill(-pid_, signal);
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

const std::string &LiveProgram::url() const
{
  return url_;
}

const std::string &LiveProgram::token() const
{
  return token_;
}

int LiveProgram::port() const
{
  return port_;
}

std::string LiveProgram::printed() const
{
  std::ifstream file(log_);
  return {std::istreambuf_iterator<char>(file), {}};
}

long LiveProgram::counter(const std::string &name) const
{
  const std::string text = ask(port_, get_request(port_, "/metrics")).body;
  const auto position    = text.find("\nmillstand_" + name + " ");
  return position == std::string::npos ? -1 : std::atol(text.c_str() + text.find(' ', position + 1) + 1);
}

pid_t LiveProgram::process() const
{
  return pid_;
}
