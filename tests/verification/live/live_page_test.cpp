#include "tests/support/live_mill.h"
#include "tests/support/live_page_look.h"
#include "tests/support/near.h"
#include "tests/support/raw_client.h"
#include "tests/support/web_driver.h"
#include "twin/live/page/event_text.h"
#include "twin/live/page/page_command.h"
#include "twin/live/page/page_server.h"
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <mutex>
#include <thread>
#include <unistd.h>

// The page in a headless Chromium, beside a made mill in real time: what the browser draws and asks for is read
// back from it.  TW-32.
namespace live = mill::live;

namespace {
// The mill and its server; the server can be stopped and started again, as a program would be.
class Plant {
public:
  Plant()
      : keeper_(
            (std::filesystem::temp_directory_path() / ("millstand-token-" + std::to_string(getpid()))).string())
  {
    start();
    clock_ = std::thread([this] { run(); });
  }
  ~Plant()
  {
    done_ = true;
    clock_.join();
    std::filesystem::remove(keeper_);
  }
  void start()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    live::PageSettings settings;
    settings.port         = port_;
    settings.token_keeper = keeper_;
    server_               = std::make_unique<live::PageServer>(
        settings, live::stand_text(mill_.stand()),
        [this](const std::string &json) {
          const std::lock_guard<std::mutex> mine(asked_mutex_);
          asked_.push_back(live::page_command(json));
          return live::CommandReply{202, "{}"};
        },
        [] { return std::string(); });
    port_ = server_->port();
    mill_.tell_all(tell());
  }
  void stop()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    server_.reset();
  }
  std::string url()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return server_->url();
  }
  void publish(const std::string &event, const std::string &json)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    server_->publish(event, json);
  }
  void hold(const std::vector<double> &displacement)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    mill_.held = displacement;
  }
  // Also in the events that follow each second: an event published beside them is gone when the next one comes.
  void hold_bands(const std::vector<live::ChatterBand> &bands)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    mill_.held_bands = bands;
  }
  double highest_frequency()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return mill_.frequencies()[5];
  }
  bool was_asked(const live::PageCommandKind kind, const std::int64_t id)
  {
    const std::lock_guard<std::mutex> lock(asked_mutex_);
    for (const auto &command : asked_all_)
      if (command.kind == kind && command.id == id)
        return true;
    return false;
  }
  void silence(const bool wanted)
  {
    silent_ = wanted;
  }

private:
  LiveMill::Tell tell()
  {
    return [this](const std::string &event, const std::string &json) {
      if (server_)
        server_->publish(event, json);
    };
  }
  void run()
  {
    for (auto next = std::chrono::steady_clock::now(); !done_; std::this_thread::sleep_until(next)) {
      next += std::chrono::milliseconds(50);
      const std::lock_guard<std::mutex> lock(mutex_);
      {
        const std::lock_guard<std::mutex> asked(asked_mutex_);
        for (const auto &command : asked_)
          mill_.take(command);
        asked_all_.insert(asked_all_.end(), asked_.begin(), asked_.end());
        asked_.clear();
      }
      mill_.advance(0.05);
      if (!silent_)
        mill_.tell(tell());
    }
  }

  LiveMill mill_;
  std::string keeper_;
  int port_ = 0;
  std::unique_ptr<live::PageServer> server_;
  std::mutex mutex_, asked_mutex_;
  std::vector<live::PageCommand> asked_, asked_all_;
  std::atomic<bool> done_{false}, silent_{false};
  std::thread clock_;
};

class LivePage : public testing::Test {
protected:
  static void SetUpTestSuite()
  {
    if (Browser::missing().empty()) {
      plant   = std::make_unique<Plant>();
      browser = std::make_unique<Browser>();
      browser->dark(true);
      browser->size(1400, 900);
      browser->open(plant->url());
    }
  }
  static void TearDownTestSuite()
  {
    browser.reset();
    plant.reset();
  }
  void SetUp() override
  {
    if (!Browser::missing().empty())
      GTEST_SKIP() << Browser::missing() << "; scripts/install-deps tests installs it";
    ASSERT_TRUE(browser->wait_for(present)) << browser->run("return document.body.innerText").dump();
  }
  static constexpr const char *present = "return document.body.dataset.link === 'open' && "
                                         "document.getElementById('quiet-word').textContent === 'Quiet'";
  static std::unique_ptr<Plant> plant;
  static std::unique_ptr<Browser> browser;

  static std::string text(const std::string &id)
  {
    return browser->run("return document.getElementById('" + id + "').textContent").get<std::string>();
  }
  static double number(const std::string &canvas, const std::string &name)
  {
    return number_of_canvas(*browser, canvas, name);
  }
};
std::unique_ptr<Plant> LivePage::plant;
std::unique_ptr<Browser> LivePage::browser;
}  // namespace

TEST_F(LivePage, MassesMoveByTheStatedAmplification)
{
  // Backup rolls up and down by some micrometres, everything else at rest.
  struct Held {
    std::vector<double> displacement;  // m
    double upper, lower;               // px, where the lines through the backup rolls are found
  } rows[2]            = {{{0, 0, 0, 0, 0, 0}, 0, 0}, {{0, 1.2e-5, 0, 0, -9e-6, 0}, 0, 0}};
  double amplification = 0, scale = 0;
  for (Held &row : rows) {
    plant->hold(row.displacement);
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    amplification = number("stand", "amplification");
    scale         = number("stand", "scale");
    row.upper     = line_of_mass(*browser, 0.45, 0.42 + 0.3, 0.42 + 1.15);
    row.lower     = line_of_mass(*browser, 0.45, -0.42 - 1.15, -0.42 - 0.3);
  }
  plant->hold({});
  EXPECT_GT(rows[0].upper, 0);
  std::string stated = text("stand-amplification"), digits;
  for (const char c : stated)
    if (c >= '0' && c <= '9')
      digits += c;
  EXPECT_EQ(std::atof(digits.c_str()), amplification) << stated;
  const Tolerance pixel = within(0.5 / (1.2e-5 * amplification * scale), "half a pixel, of the drawn line");
  EXPECT_GT(1.2e-5 * amplification * scale, 3) << "too small to be seen";
  EXPECT_TRUE(near(rows[0].upper - rows[1].upper, 1.2e-5 * amplification * scale, pixel));
  EXPECT_TRUE(near(rows[1].lower - rows[0].lower, 9e-6 * amplification * scale,
                   within(0.5 / (9e-6 * amplification * scale), pixel.why)));
  // To scale: the lines are the axes of rolls of 1450 mm on rolls of 420 mm.
  EXPECT_TRUE(near(rows[0].lower - rows[0].upper, 2 * (0.42 + 0.725) * scale,
                   within(1 / (2.29 * scale), "half a pixel for each of two lines")));
}

TEST_F(LivePage, ASliderMovesThePeakToWhereTheModesSayItIs)
{
  browser->type("2");
  const double before = plant->highest_frequency();
  EXPECT_TRUE(near(before, 745.8, within(1e-4, "the description of the twin rounds to 0.1 Hz")));
  ASSERT_TRUE(browser->wait_for(peak_of_twin_is_at(before))) << number("spectrum", "peakSimulated");
  browser->run("document.getElementById('slider-K3').focus()");
  for (int k = 0; k < 10; ++k)
    browser->type("\uE014");  // arrow to the right, 0.01 each
  EXPECT_TRUE(browser->wait_for("return document.body.dataset.link === 'open' && "
                                "document.querySelector('.slider[data-moved=yes] em')?.textContent === '× 1.10'"));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const double after = plant->highest_frequency();
  EXPECT_GT(after, before + 10);
  EXPECT_TRUE(browser->wait_for(peak_of_twin_is_at(after))) << number("spectrum", "peakSimulated") << " " << after;
  EXPECT_NE(text("changed-list").find("K3 × 1.10"), std::string::npos) << text("changed-list");
}

TEST_F(LivePage, AReloadShowsTheStateAtOnce)
{
  const double begin = steady_seconds();
  browser->reload();
  EXPECT_TRUE(
      browser->wait_for(std::string(present) + " && +document.getElementById('slider-K3').value === 1.1", 3));
  EXPECT_LT(steady_seconds() - begin, 3);
  EXPECT_TRUE(browser->run("return document.getElementById('engineer').hidden === false").get<bool>());
}

TEST_F(LivePage, KeysDoWhatButtonsDo)
{
  const auto theme = [&] { return browser->run("return getComputedStyle(document.body).color"); };
  const auto dark  = theme();
  browser->type("t");
  EXPECT_NE(theme(), dark);
  browser->type("t");
  EXPECT_EQ(theme(), dark);
  browser->type("1");
  EXPECT_TRUE(browser->run("return document.getElementById('engineer').hidden").get<bool>());
  const double amplification = number("stand", "amplification");
  browser->type("+");
  EXPECT_TRUE(browser->wait_for("return +document.getElementById('stand').dataset.amplification > " +
                                std::to_string(amplification)));
  browser->type("0");
  live::PageAlarm alarm{7, 1.7676e9, "chatter", "third octave grows", "alarm"};
  plant->publish("alarm", live::alarm_text(alarm));
  EXPECT_TRUE(browser->wait_for("return document.getElementById('quiet-word').textContent === 'Alarm'"));
  EXPECT_TRUE(browser->run("return !document.getElementById('alarm-banner').hidden").get<bool>());
  browser->type("a");
  for (int k = 0; k < 100 && !plant->was_asked(live::PageCommandKind::acknowledge, 7); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_TRUE(plant->was_asked(live::PageCommandKind::acknowledge, 7));
  alarm.acknowledged = alarm.over = true;
  plant->publish("alarm", live::alarm_text(alarm));
  EXPECT_TRUE(browser->wait_for("return document.getElementById('alarm-banner').hidden"));
}

TEST_F(LivePage, NothingIsCutAtAnySizeOrTheme)
{
  // Texts that stick out of their box or of the window; boxes that scroll by themselves may be larger inside.
  const char *const cut =
      "const out = [], wide = document.documentElement.clientWidth;"
      "if (document.documentElement.scrollWidth > wide) out.push('page scrolls sideways');"
      "for (const node of document.querySelectorAll('body *')) {"
      " if (!node.offsetParent || !node.textContent.trim() || node.closest('.scrolls') || node.tagName === "
      "'OPTION') continue;"
      " const box = node.getBoundingClientRect();"
      " if (box.right > wide + 1 || box.left < -1) out.push('outside: ' + node.outerHTML.slice(0, 120));"
      " if (node.scrollWidth > node.clientWidth + 1 && node.clientWidth > 0 && getComputedStyle(node).display !== "
      "'inline')"
      "  out.push('cut: ' + node.outerHTML.slice(0, 120)); }"
      "return out;";
  // With the longest alarm and proposal that a drift brings.
  live::PageAlarm alarm{
      9, 1.7676e9, "drift",
      "mode 6 is at 733.78 Hz, 1.95 % below the twin at 976.2 kN, since about 2026-11-23 18:28:18 UTC: its "
      "sum passed 12 standard deviations, on average -6340.4; the twin is not changed; it was 0.01 % below "
      "it at the start",
      "alarm"};
  live::PageProposal proposal{
      3, 1.7676e9,
      "Mode 6 moved down by 6340.4 standard deviations on average, to 733.78 Hz against 748.39 Hz of "
      "the twin. On 60 s from 2026-11-23T18:28:18Z to 2026-11-23T18:29:18Z the misfit falls from "
      "6.537 to 0.980. Nothing is changed until it is adopted."};
  plant->publish("alarm", live::alarm_text(alarm));
  plant->publish("proposal", live::proposal_text(proposal));
  EXPECT_TRUE(browser->wait_for("return document.querySelector('#changed-list button') && "
                                "!document.getElementById('alarm-banner').hidden"));
  // The picture keeps its shape when an alarm or a lost link takes a line from it.
  const auto shape = [&] {
    return browser->run("const c = document.getElementById('stand'); return c.width * c.clientHeight / (c.height "
                        "* c.clientWidth)");
  };
  browser->type("1");
  browser->run("const b = document.getElementById('banner'); b.hidden = false; b.textContent = 'a line'");
  EXPECT_TRUE(browser->wait_for(
      "const c = document.getElementById('stand'); return Math.abs(c.width - c.clientWidth) < 1 && "
      "Math.abs(c.height - c.clientHeight) < 1",
      1))
      << shape();
  browser->run("document.getElementById('banner').hidden = true");
  for (const auto &[width, height] : {std::pair{1400, 900}, {400, 800}, {1024, 768}, {1920, 1080}})
    for (const char *screen : {"1", "2"}) {
      browser->size(width, height);
      browser->type(screen);
      const auto words = browser->run(cut);
      EXPECT_TRUE(words.empty()) << width << " x " << height << ", screen " << screen << ": " << words.dump(1);
      if (width >= 1400)
        EXPECT_LE(browser->run("return document.documentElement.scrollHeight").get<int>(), height) << screen;
      if (const char *folder = std::getenv("MILLSTAND_SCREENSHOTS"))
        browser->screenshot(std::string(folder) + "/" + std::to_string(width) + "-" + screen + ".png");
    }
  browser->size(1400, 900);
  alarm.acknowledged = alarm.over = true;
  proposal.state                  = "refused";
  plant->publish("alarm", live::alarm_text(alarm));
  plant->publish("proposal", live::proposal_text(proposal));
  EXPECT_TRUE(browser->wait_for("return document.getElementById('alarm-banner').hidden"));
}

// A narrow band swings above twice its calm level by itself: one event of it is not a louder mill; at the limit of
// an alarm one is enough.
TEST_F(LivePage, OneFluctuationOfABandIsNotLouder)
{
  live::ChatterBand swing{"third octave", 218.3, 2.4 * 0.26, 0.26, -1.85, -1.42, "calm"};
  plant->hold_bands({swing});
  EXPECT_TRUE(browser->wait_for("return document.getElementById('quiet-say').textContent.startsWith('1.5 ×')"))
      << text("quiet-say");
  EXPECT_EQ(text("quiet-word"), "Quiet");
  swing.amplitude = 5.2 * 0.26;
  plant->hold_bands({swing});
  EXPECT_TRUE(browser->wait_for("return document.getElementById('quiet-word').textContent === 'Loud'"));
  plant->hold_bands({});
  EXPECT_TRUE(browser->wait_for(present, 15));
}

TEST_F(LivePage, NoAnswerIsGivenFromOldOrAbsentData)
{
  browser->type("1");
  plant->silence(true);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  live::PageNumbers gap;
  gap.state        = "gap";
  gap.displacement = std::vector<double>(6, 0);
  gap.acceleration = std::vector<double>(6, 0);
  plant->publish("numbers", live::numbers_text(gap));
  EXPECT_TRUE(browser->wait_for("return document.getElementById('quiet-word').textContent === 'No data'"));
  EXPECT_EQ(text("chatter-word"), "No data");
  EXPECT_TRUE(browser->wait_for("return document.getElementById('run-state').textContent === 'gap'", 1));
  plant->silence(false);
  EXPECT_TRUE(browser->wait_for(present));
}

// A hundred are listed: the one that is open first of all, for any age, and the latest of those that are over.
TEST_F(LivePage, WhatIsOpenIsListedWhateverItsAge)
{
  live::PageAlarm alarm;
  alarm.id    = 5000;
  alarm.utc   = 1.6e9;
  alarm.kind  = "gap";
  alarm.level = "warning";
  alarm.text  = "of long ago, open";
  plant->publish("alarm", live::alarm_text(alarm));
  live::PageAlarm later = alarm;
  later.over            = true;
  later.text            = "over";
  for (later.id = 5001; later.id <= 5300; ++later.id) {
    later.utc += 60;
    plant->publish("alarm", live::alarm_text(later));
  }
  browser->type("2");
  browser->run("document.querySelector('[data-tab=alarms]').click()");
  EXPECT_TRUE(
      browser->wait_for("const all = [...document.querySelectorAll('#alarms li')].map(li => li.textContent); "
                        "return all.length === 101 && all.some(t => t.includes('of long ago, open')) && "
                        "/^[0-9]+ earlier, over, not listed$/.test(all[100])"))
      << text("alarms");
  alarm.over = true;
  plant->publish("alarm", live::alarm_text(alarm));
  browser->type("1");
  EXPECT_TRUE(browser->wait_for(present));
}

// Last but one, since a server that is away shows in the console.
TEST_F(LivePage, LoadsWithoutErrorsAndWithoutTheNetwork)
{
  for (const auto &entry : browser->console())
    EXPECT_NE(entry.at("level"), "SEVERE") << entry.dump();
  const std::string address = plant->url().substr(0, plant->url().find('#'));
  const auto all            = browser->requests();
  EXPECT_GT(all.size(), 10u);
  for (const std::string &url : all)
    EXPECT_EQ(url.compare(0, address.size(), address), 0) << url;
}

TEST_F(LivePage, SurvivesARestartOfTheServer)
{
  plant->stop();
  ASSERT_TRUE(browser->wait_for("return document.body.dataset.link === 'lost'"));
  EXPECT_TRUE(browser->wait_for("return document.getElementById('quiet-word').textContent === 'No link'"));
  EXPECT_NE(text("banner").find("no connection to millstand live since"), std::string::npos) << text("banner");
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  const double begin = steady_seconds();
  plant->start();
  EXPECT_TRUE(browser->wait_for(present, 3));
  EXPECT_LT(steady_seconds() - begin, 3);
}
