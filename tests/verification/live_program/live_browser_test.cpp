#include "tests/support/live_chain.h"
#include "tests/support/live_page_look.h"
#include "tests/support/live_program.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/raw_client.h"
#include "tests/support/slowness.h"
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <sstream>
#include <thread>

// The built program beside a record, seen from a browser and from other programs.  TW-32.
namespace {
constexpr double rate         = 4000;      // Hz
constexpr double mean         = 976217.5;  // N
constexpr Eigen::Index period = 4096;

// A mill with a gap of 0.1 s early on, 40 s, and longer where a slower program has to answer within it.
void write_record(const std::string &path)
{
  const Eigen::VectorXd force = comb_force(period, 1500, mean, 200);
  std::string text            = "time [s],force [N],upper_work_roll [m/s2]\n";
  const int seconds           = 30 + 10 * slowness();
  for (int k = 0; k < seconds * int(rate); ++k)
    if (k < 2 * int(rate) || k >= 2 * int(rate) + 400)
      text +=
          fmt::format("{:.5f},{:.3f},{:.5f}\n", k / rate, force[k % period], 1e-4 * (force[k % period] - mean));
  std::ofstream(path) << text;
}

// One browser for all, a program of its own for each test: none depends on what another did or how long it took.
class LiveBrowser : public testing::Test {
protected:
  static void SetUpTestSuite()
  {
    folder = scratch("live-browser");
    write_record(folder + "/mill.csv");
    std::ofstream(folder + "/chain.toml") << chain_case();
    if (!Browser::missing().empty())
      return;
    browser = std::make_unique<Browser>();
    browser->dark(true);
    browser->size(1400, 900);
  }
  static void TearDownTestSuite()
  {
    browser.reset();
  }
  void SetUp() override
  {
    if (!Browser::missing().empty())
      GTEST_SKIP() << Browser::missing() << "; scripts/install-deps tests installs it";
    recordings = folder + "/" + testing::UnitTest::GetInstance()->current_test_info()->name();
    begin("127.0.0.1:0");
    browser->open("about:blank");
    browser->console(), browser->requests();  // what the pages before left
    browser->open(program->url());
    ASSERT_TRUE(browser->wait_for(running, 10)) << browser->run("return document.body.innerText").dump();
  }
  void begin(const std::string &listen)
  {
    program.reset();
    program = std::make_unique<LiveProgram>(live_words({folder + "/chain.toml", "--input", folder + "/mill.csv",
                                                        "--record", recordings, "--listen", listen}),
                                            folder);
  }
  static std::string text(const std::string &id)
  {
    return browser->run("return document.getElementById('" + id + "').textContent").get<std::string>();
  }
  static constexpr const char *running =
      "return document.body.dataset.link === 'open' && "
      "['running', 'settling'].includes(document.getElementById('run-state').textContent)";
  static std::string folder;
  static std::unique_ptr<Browser> browser;
  std::string recordings;
  std::unique_ptr<LiveProgram> program;
};
std::string LiveBrowser::folder;
std::unique_ptr<Browser> LiveBrowser::browser;

// Hz, of the highest mode, as the verb `modes` writes it.
double highest_mode(const std::string &folder, const double factor_of_K3)
{
  const std::string out  = folder + fmt::format("/modes-{:g}", factor_of_K3);
  const std::string more = fmt::format(" --set given.K3=\"{} N/m\"", factor_of_K3 * chain_stiffness()[2]);
  const Outcome outcome  = millstand("modes " + folder + "/chain.toml -q -o " + out + more);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::ifstream table(out + "/curves/modes.csv");
  std::string line, last, cell;
  while (std::getline(table, line))
    last = line;
  std::istringstream row(last);
  std::getline(row, cell, ',');
  std::getline(row, cell, ',');
  return std::atof(cell.c_str());
}
}  // namespace

TEST_F(LiveBrowser, ASliderMovesThePeakToWhereTheVerbModesPutsIt)
{
  const double before = highest_mode(folder, 1), after = highest_mode(folder, 1.1);
  EXPECT_TRUE(near(before, 745.8, within(1e-4, "the description of the twin rounds to 0.1 Hz")));
  ASSERT_GT(after, before + 30);
  browser->type("2");
  ASSERT_TRUE(browser->wait_for(peak_of_twin_is_at(before), 10))
      << number_of_canvas(*browser, "spectrum", "peakSimulated");
  browser->run("document.getElementById('slider-K3').focus()");
  for (int k = 0; k < 10; ++k)
    browser->type("\uE014");  // arrow to the right, 0.01 each
  EXPECT_TRUE(
      browser->wait_for("return document.querySelector('.slider[data-moved=yes] em')?.textContent === '× 1.10'"));
  EXPECT_TRUE(browser->wait_for(peak_of_twin_is_at(after), 10))
      << number_of_canvas(*browser, "spectrum", "peakSimulated") << " and not " << after;
  EXPECT_NE(program->printed().find("K3 is 1.1 times the model's own"), std::string::npos) << program->printed();
}

TEST_F(LiveBrowser, AReloadShowsTheStateAtOnce)
{
  const std::string head = "Content-Type: application/json\r\nX-Millstand-Token: " + program->token() + "\r\n";
  ASSERT_EQ(ask(program->port(), post_request(program->port(), "/command",
                                              "{\"command\":\"set\",\"key\":\"K3\",\"factor\":1.1}", head))
                .status,
            202);
  ASSERT_TRUE(browser->wait_for("return +document.getElementById('slider-K3').value === 1.1"));
  const double begin = steady_seconds();
  browser->reload();
  EXPECT_TRUE(
      browser->wait_for(std::string(running) + " && +document.getElementById('slider-K3').value === 1.1", 3));
  EXPECT_LT(steady_seconds() - begin, 3);
}

TEST_F(LiveBrowser, CommandsOfThePageReachTheProgram)
{
  ASSERT_TRUE(browser->wait_for("return !document.getElementById('alarm-banner').hidden", 6))
      << program->printed();
  EXPECT_NE(text("alarm-text").find("400 samples before s = 8400 are missing"), std::string::npos)
      << text("alarm-text");
  browser->type("a");
  EXPECT_TRUE(browser->wait_for("return document.getElementById('alarm-banner').hidden"));
  // Another reader receives that it was seen.
  RawClient other(program->port());
  other.send(get_request(program->port(), "/events?token=" + program->token()));
  const std::string received = other.until("\"acknowledged\":true");
  EXPECT_NE(received.find("400 samples before"), std::string::npos);
  EXPECT_NE(received.find("\"acknowledged\":true"), std::string::npos);

  browser->run(
      "document.querySelector('[data-tab=advice]').click(); document.getElementById('ask-advice').click()");
  EXPECT_TRUE(browser->wait_for("return document.querySelectorAll('#advice tbody tr').length > 2", 20))
      << text("advice-say");
  EXPECT_NE(text("advice").find("damper"), std::string::npos) << text("advice");
}

TEST_F(LiveBrowser, AReaderThatTakesNothingDelaysNobody)
{
  RawClient deaf(program->port(), 4096);
  deaf.send(get_request(program->port(), "/events?token=" + program->token()));
  browser->run("window.came = []; const e = new EventSource('/events?token=" + program->token() +
               "'); window.other = e; e.addEventListener('numbers', m => window.came.push(performance.now()))");
  const long before = program->counter("page_frames_dropped_total");
  EXPECT_GE(before, 0);
  for (const double end = steady_seconds() + 10;
       program->counter("page_frames_dropped_total") < before + 20 && steady_seconds() < end;)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_GE(program->counter("page_frames_dropped_total"), before + 20) << "nothing was held back";
  // Twenty a second, of the second and more that have passed; a machine at work may keep some of them waiting.
  EXPECT_TRUE(browser->wait_for(
      "const c = window.came; return c.length > 20 && c[c.length - 1] - c[c.length - 21] < 1500"))
      << browser->run("return window.came.length").dump();
  browser->run("window.other.close()");
}

TEST_F(LiveBrowser, LoadsWithoutErrorsAndWithoutTheNetwork)
{
  for (const auto &entry : browser->console())
    EXPECT_NE(entry.at("level"), "SEVERE") << entry.dump();
  const std::string address = program->url().substr(0, program->url().find('#'));
  const auto all            = browser->requests();
  EXPECT_GT(all.size(), 10u);
  for (const std::string &url : all)
    EXPECT_EQ(url.compare(0, address.size(), address), 0) << url;
}

TEST_F(LiveBrowser, WithoutItsTokenThePageShowsNothing)
{
  const int port = program->port();
  EXPECT_EQ(ask(port, get_request(port, "/stand")).status, 401);
  EXPECT_EQ(ask(port, get_request(port, "/events?token=" + std::string(43, 'x'))).status, 401);
  EXPECT_EQ(
      ask(port, post_request(port, "/command", "{\"command\":\"reset\"}", "Content-Type: application/json\r\n"))
          .status,
      401);
  const std::string address = program->url().substr(0, program->url().find('#'));
  for (const std::string token : {"", "#wrong-token-of-more-than-22-letters"}) {
    browser->open("about:blank");
    browser->open(address + token);
    ASSERT_TRUE(browser->wait_for("return !document.getElementById('banner').hidden"));
    EXPECT_NE(text("banner").find("token"), std::string::npos) << text("banner");
    EXPECT_EQ(text("fact-force"), "–");
    // The next frame draws it: on a busy machine later than the banner.
    EXPECT_TRUE(browser->wait_for("return document.getElementById('quiet-word').textContent === 'No link'"))
        << text("quiet-word");
  }
  browser->open("about:blank");
  browser->open(program->url());
  EXPECT_TRUE(browser->wait_for(running));
  EXPECT_EQ(program->printed().find("again as the model has it"), std::string::npos) << "the reset was taken";
}

TEST_F(LiveBrowser, ARestartOfTheProgramIsSurvived)
{
  const std::string listen = fmt::format("127.0.0.1:{}", program->port()), url = program->url();
  EXPECT_EQ(program->end(SIGTERM), 128 + SIGTERM);
  ASSERT_TRUE(browser->wait_for("return document.body.dataset.link === 'lost'"));
  const double begun = steady_seconds();
  begin(listen);
  EXPECT_EQ(program->url(), url) << "the token is kept";
  EXPECT_TRUE(browser->wait_for(running, 3));
  EXPECT_LT(steady_seconds() - begun, 3);
  EXPECT_NE(program->printed().find("goes on at s = "), std::string::npos) << program->printed();
}

// A step of the force on standard input moves the drawn rolls of the chain, whose rolls do not bend, by what
// statics says, in pixels of the stated scale: the picture is relative to the mean force of the last second, of
// which two seconds later exp(-2) is left.
TEST(LiveBrowserMasses, MoveByTheSpringsAtTheStatedScale)
{
  if (!Browser::missing().empty())
    GTEST_SKIP() << Browser::missing() << "; scripts/install-deps tests installs it";
  const std::string home = scratch("live-masses"), stand = MILLSTAND_SOURCE_DIR "/cases/four-high-1400.toml";
  LiveProgram program(
      live_words({stand, "--model", "six-mass", "--input", "-", "--set", "dynamics.modal_damping=5 %"}), home);
  Browser browser;
  browser.dark(true);
  browser.size(1400, 900);
  browser.open(program.url());
  const auto seconds_of = [&](const int from, const double force) {
    std::string lines;
    for (int s = from; s < from + 2 * int(rate); s += 400)
      lines += fmt::format("{{\"s\":{},\"force\":[{}{}]}}\n", s, force, [&] {
        std::string more;
        for (int i = 1; i < 400; ++i)
          more += fmt::format(",{}", force);
        return more;
      }());
    return lines;
  };
  const double rise = 1e6;  // N
  program.send(fmt::format("{{\"millstand\":1,\"rate\":{:g},\"units\":{{\"force\":\"N\"}}}}\n", rate));
  program.send(seconds_of(0, mean));
  const std::string at_rest = "return document.getElementById('fact-time').textContent !== '–' && "
                              "document.getElementById('run-state').textContent === 'waiting'";
  ASSERT_TRUE(browser.wait_for(at_rest, 10));
  const auto row = [&](const double side) {
    return line_of_mass(browser, 0.45, side * 0.42 + (side > 0 ? 0.3 : -1.15),
                        side * 0.42 + (side > 0 ? 1.15 : -0.3));
  };
  const double upper = row(1), lower = row(-1);
  const std::string before =
      browser.run("return document.getElementById('fact-time').textContent").get<std::string>();
  program.send(seconds_of(2 * int(rate), mean + rise));
  ASSERT_TRUE(
      browser.wait_for(at_rest + " && document.getElementById('fact-time').textContent !== '" + before + "'", 10));
  // Two springs in series on either side hold the backup rolls.
  const auto stand_data = nlohmann::json::parse(
      ask(program.port(), get_request(program.port(), "/stand", "X-Millstand-Token: " + program.token() + "\r\n"))
          .body);
  const auto K = [&](const std::size_t number) {
    return stand_data.at("springs").at(number - 1).at("value").get<double>();
  };
  const double left = rise * std::exp(-2.0), up = left * (1 / K(1) + 1 / K(2)),
               down        = left * (1 / K(6) + 1 / K(7));
  const auto per_metre_now = [&] {
    return number_of_canvas(browser, "stand", "amplification") * number_of_canvas(browser, "stand", "scale");
  };
  for (double before = per_metre_now(); up * before < 7; before = per_metre_now()) {
    browser.type("+");
    ASSERT_TRUE(browser.wait_for(
        "const d = document.getElementById('stand').dataset; return d.amplification * d.scale > " +
        std::to_string(1.5 * before)));
  }
  const double per_metre = per_metre_now();
  EXPECT_TRUE(
      near(upper - row(1), up * per_metre, within(0.5 / (up * per_metre), "half a pixel, of the drawn line")));
  EXPECT_TRUE(near(row(-1) - lower, down * per_metre,
                   within(0.5 / (down * per_metre), "half a pixel, of the drawn line")));
  EXPECT_EQ(program.end(0), 0);
}
