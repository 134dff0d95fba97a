// The stand that the page of a run reads: after an adoption it is that of the adopted springs.
#include "app/command/command_line.h"
#include "app/twin/live/live_page.h"
#include "app/twin/live/live_stand.h"
#include "core/model/case.h"
#include "tests/support/near.h"
#include "tests/support/raw_client.h"
#include <nlohmann/json.hpp>

using namespace mill;

namespace {
// A run's engine and page, on any port, with one proposal that may be adopted: K3 a fifth stiffer.
class PageOfARun {
public:
  PageOfARun()
  {
    command_.live.listen = "127.0.0.1:0";
    testing::internal::CaptureStdout();
    page_.open(command_, std::string(32, 't'), console_);
    const std::string printed = testing::internal::GetCapturedStdout();
    const std::string host    = "http://127.0.0.1:";
    port_                     = std::stoi(printed.substr(printed.find(host) + host.size()));
  }
  nlohmann::json stand() const
  {
    const HttpAnswer answer =
        ask(port_, get_request(port_, "/stand", "X-Millstand-Token: " + std::string(32, 't') + "\r\n"));
    EXPECT_EQ(answer.status, 200) << answer.body;
    return nlohmann::json::parse(answer.body, nullptr, false);
  }
  live::Engine &engine()
  {
    return engine_;
  }

private:
  live::EngineHooks hooks()
  {
    live::EngineHooks hooks;
    hooks.sources = {[this](const live::LiveSource &source) { page_.begin(source); }};
    hooks.models  = {[this](const live::TwinModel &, const live::Tuning &) { page_.twin_changed(); }};
    hooks.adopt   = [this](std::int64_t) {
      live::TwinModel adopted = engine_.model();
      adopted.chain.K[2].value *= 1.2;
      adopted.adopted = "calibrated.toml";
      adopted.source  = "six masses of calibrated.toml";
      return std::optional(adopted);
    };
    return hooks;
  }

  CommandLine command_;
  Case the_case_ = read_case("cases/published-1400.toml");
  LiveAlarms alarms_{[](const std::string &, const std::string &) {}};
  LiveConsole console_{false, alarms_};
  live::Engine engine_{live_model(the_case_, true), hooks()};
  LivePage page_{the_case_, {}, engine_, alarms_};
  int port_ = 0;
};

double value_of(const nlohmann::json &rows, const std::string &key)
{
  for (const auto &row : rows)
    if (row["key"] == key)
      return row["value"];
  return 0;
}
}  // namespace

TEST(LiveStandOfThePage, HasTheSpringsThatWereAdopted)
{
  PageOfARun run;
  run.engine().take(live::SourceHead{1000, {}, "test", {{"force", "N"}, {"upper_work_roll", "m/s2"}}, {1, 1}});
  const auto before = run.stand();
  EXPECT_EQ(before["source"], "six masses as given");
  live::PageCommand adopt;
  adopt.kind = live::PageCommandKind::adopt;
  adopt.id   = 1;
  run.engine().apply(adopt);
  const auto after         = run.stand();
  const Tolerance printing = within(2e-8, "nine digits of both");
  for (const char *rows : {"springs", "sliders"}) {
    EXPECT_TRUE(near(value_of(after[rows], "K3"), 1.2 * value_of(before[rows], "K3"), printing)) << rows;
    EXPECT_EQ(value_of(after[rows], "K1"), value_of(before[rows], "K1")) << rows;
  }
  EXPECT_EQ(after["source"], "six masses of calibrated.toml");
  EXPECT_GT(after["modes"].back()["frequency"].get<double>(), before["modes"].back()["frequency"].get<double>());
  EXPECT_EQ(after["rate"], 1000);
  EXPECT_EQ(after["places"][2]["measured"], true);
}
