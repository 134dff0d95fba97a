#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// A headless Chromium, steered through its driver by HTTP (W3C WebDriver).
class Browser {
public:
  /// Why there is none ("chromedriver is not installed"); empty where there is one.
  static std::string missing();

  Browser();   ///< starts the driver and a browser; throws std::runtime_error with the driver's own words
  ~Browser();  ///< ends both
  Browser(const Browser &)            = delete;
  Browser &operator=(const Browser &) = delete;

  void open(const std::string &url);
  void reload();
  void size(int width, int height);
  /// true: the system of the user prefers dark.
  void dark(bool wanted);
  /// What the body of a function returns.
  nlohmann::json run(const std::string &script);
  /// Runs the script every 30 ms until it returns something true; false when the time is over.
  bool wait_for(const std::string &script, double seconds = 5);
  /// A key as a user types it into what has the focus: "2", "\uE007".
  void type(const std::string &keys);
  /// A key while another is held: "\uE009" (Control) and "s".
  void type_with(const std::string &held, const std::string &key);
  /// What the body of a function returns inside the first frame of a selector.
  nlohmann::json run_in_frame(const std::string &selector, const std::string &script);
  /// Lines of the console since the last call: [{"level", "message"}].
  nlohmann::json console();
  /// Addresses of all requests since the last call.
  std::vector<std::string> requests();
  void screenshot(const std::string &file);

private:
  void press(const nlohmann::json &steps);
  nlohmann::json call(const std::string &method, const std::string &path, const nlohmann::json &body = {});
  nlohmann::json session(const std::string &method, const std::string &path, const nlohmann::json &body = {});
  int process_ = -1, port_ = 0;
  std::string session_, folder_;
};
