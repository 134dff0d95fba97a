#include "tests/support/web_driver.h"
#include "tests/support/raw_client.h"
#include "tests/support/slowness.h"
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using nlohmann::json;

namespace {
const char *const driver_program = "chromedriver";

std::string program_in_path(const std::vector<std::string> &names)
{
  const char *path = std::getenv("PATH");
  for (std::string rest = path ? path : ""; !rest.empty();) {
    const auto colon         = rest.find(':');
    const std::string folder = rest.substr(0, colon);
    rest                     = colon == std::string::npos ? "" : rest.substr(colon + 1);
    for (const std::string &name : names)
      if (access((folder + "/" + name).c_str(), X_OK) == 0)
        return folder + "/" + name;
  }
  return "";
}

std::string browser_program()
{
  return program_in_path({"chromium", "chromium-browser", "google-chrome"});
}

void wait_a_little()
{
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
}
}  // namespace

std::string Browser::missing()
{
  if (browser_program().empty())
    return "chromium is not installed";
  return program_in_path({driver_program}).empty() ? "chromedriver is not installed" : "";
}

Browser::Browser()
{
  std::string folder = (std::filesystem::temp_directory_path() / "millstand-browser-XXXXXX").string();
  if (!mkdtemp(folder.data()))
    throw std::runtime_error("no folder for the browser at " + folder);
  folder_               = folder;
  const std::string log = folder_ + "/driver.txt", program = program_in_path({driver_program});
  process_ = fork();
  if (process_ == 0) {  // a group of its own, that ends with this program
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int out = ::open(log.c_str(), O_WRONLY | O_CREAT, 0600);
    dup2(out, 1);
    dup2(out, 2);
    execl(program.c_str(), driver_program, "--port=0", static_cast<char *>(nullptr));
    _exit(127);
  }
  const std::string mark = "successfully on port ";
  for (const double end = steady_seconds() + 20; port_ == 0 && steady_seconds() < end; wait_a_little()) {
    std::ifstream in(log);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto position = text.find(mark);
    if (position != std::string::npos && text.find('.', position) != std::string::npos)
      port_ = std::atoi(text.c_str() + position + mark.size());
  }
  if (port_ == 0)
    throw std::runtime_error("chromedriver has not said its port");
  const json arguments = {"--headless=new",
                          "--no-sandbox",
                          "--disable-gpu",
                          "--disable-dev-shm-usage",
                          "--no-first-run",
                          "--disable-extensions",
                          "--disable-background-networking",
                          "--window-size=1400,900",
                          "--user-data-dir=" + folder_ + "/profile"};
  const json wanted    = {{"browserName", "chrome"},
                          {"goog:loggingPrefs", {{"browser", "ALL"}, {"performance", "ALL"}}},
                          {"goog:chromeOptions", {{"binary", browser_program()}, {"args", arguments}}}};
  session_             = call("POST", "/session", {{"capabilities", {{"alwaysMatch", wanted}}}}).at("sessionId");
}

Browser::~Browser()
{
  try {
    session("DELETE", "");
  } catch (const std::exception &) {  // the group is ended below
  }
  kill(-process_, SIGTERM);
  waitpid(process_, nullptr, 0);
  // What the browser still writes while it ends may come after a first try.
  std::error_code ignored;
  for (int tries = 0; tries < 20 && std::filesystem::exists(folder_, ignored); ++tries) {
    std::filesystem::remove_all(folder_, ignored);
    if (std::filesystem::exists(folder_, ignored))
      wait_a_little();
  }
}

json Browser::call(const std::string &method, const std::string &path, const json &body)
{
  const std::string text  = body.is_null() ? "{}" : body.dump();
  const std::string lines = "Content-Type: application/json\r\n";
  RawClient client(port_);
  auto answer = ask(
      client,
      method == "POST" ? post_request(port_, path, text, lines) : method + get_request(port_, path).substr(3), 60);
  const json reply = json::parse(answer.body, nullptr, false);
  if (answer.status != 200 || !reply.contains("value"))
    throw std::runtime_error(method + " " + path + ": " + answer.head + answer.body.substr(0, 2000));
  return reply.at("value");
}

json Browser::session(const std::string &method, const std::string &path, const json &body)
{
  return call(method, "/session/" + session_ + path, body);
}

void Browser::open(const std::string &url)
{
  session("POST", "/url", {{"url", url}});
}

void Browser::reload()
{
  session("POST", "/refresh");
}

void Browser::size(const int width, const int height)
{
  session("POST", "/goog/cdp/execute",
          {{"cmd", "Emulation.setDeviceMetricsOverride"},
           {"params", {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}}}});
}

void Browser::dark(const bool wanted)
{
  session(
      "POST", "/goog/cdp/execute",
      {{"cmd", "Emulation.setEmulatedMedia"},
       {"params",
        {{"features", json::array({{{"name", "prefers-color-scheme"}, {"value", wanted ? "dark" : "light"}}})}}}});
}

json Browser::run(const std::string &script)
{
  return session("POST", "/execute/sync", {{"script", script}, {"args", json::array()}});
}

bool Browser::wait_for(const std::string &script, const double seconds)
{
  for (const double end = steady_seconds() + slowness() * seconds; steady_seconds() < end; wait_a_little()) {
    const json value = run(script);
    if (value.is_boolean() ? value.get<bool>() : !value.is_null())
      return true;
  }
  return false;
}

void Browser::type(const std::string &keys)
{
  json steps = json::array();
  for (std::size_t position = 0; position < keys.size();) {  // one key for each code point of UTF-8
    std::size_t n = 1;
    while (position + n < keys.size() && (static_cast<unsigned char>(keys[position + n]) & 0xC0) == 0x80)
      ++n;
    for (const char *step : {"keyDown", "keyUp"})
      steps.push_back({{"type", step}, {"value", keys.substr(position, n)}});
    position += n;
  }
  press(steps);
}

void Browser::type_with(const std::string &held, const std::string &key)
{
  json steps = json::array();
  for (const auto &[step, value] :
       {std::pair("keyDown", held), std::pair("keyDown", key), std::pair("keyUp", key), std::pair("keyUp", held)})
    steps.push_back({{"type", step}, {"value", value}});
  press(steps);
}

void Browser::press(const json &steps)
{
  session("POST", "/actions",
          {{"actions", json::array({{{"type", "key"}, {"id", "keyboard"}, {"actions", steps}}})}});
}

json Browser::run_in_frame(const std::string &selector, const std::string &script)
{
  const json frame = session("POST", "/element", {{"using", "css selector"}, {"value", selector}});
  session("POST", "/frame", {{"id", frame}});
  const json value = run(script);
  session("POST", "/frame", {{"id", nullptr}});
  return value;
}

json Browser::console()
{
  return session("POST", "/se/log", {{"type", "browser"}});
}

std::vector<std::string> Browser::requests()
{
  std::vector<std::string> out;
  for (const json &entry : session("POST", "/se/log", {{"type", "performance"}})) {
    const json message = json::parse(entry.at("message").get<std::string>()).at("message");
    if (message.at("method") != "Network.requestWillBeSent")
      continue;
    const std::string url = message.at("params").at("request").at("url");
    if (url.compare(0, 9, "chrome://") != 0 && url.compare(0, 5, "data:") != 0)  // the browser's own first page
      out.push_back(url);
  }
  return out;
}

void Browser::screenshot(const std::string &file)
{
  const std::string text = session("GET", "/screenshot");
  std::ofstream out(file, std::ios::binary);
  std::uint32_t bits        = 0;
  int count                 = 0;
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (const char c : text) {
    const auto value = letters.find(c);
    if (value == std::string::npos)
      break;
    bits = bits << 6 | std::uint32_t(value);
    count += 6;
    if (count >= 8) {
      count -= 8;
      out.put(char(bits >> count & 255));
    }
  }
}
