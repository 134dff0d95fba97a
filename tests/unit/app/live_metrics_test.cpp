// Lines of /metrics: every number that an alarm of one's own may want, in the form that Prometheus reads.
#include "app/twin/live/live_metrics.h"
#include "app/twin/live/live_stand.h"
#include "core/model/case.h"
#include "tests/support/near.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <set>
#include <sstream>

using namespace mill;

namespace {
bool has_line(const std::string &text, const std::string &line)
{
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

// A comparison that has seen ten seconds of a loud tone at the upper work roll.
std::unique_ptr<live::Comparison> loud_comparison()
{
  const Case the_case = read_case("cases/published-1400.toml");
  const auto model    = live_model(the_case, true);
  live::ComparisonSetup setup;
  setup.rate      = 1000;
  setup.channels  = {{"force", "N"}, {"upper_work_roll", "m/s2"}};
  setup.places    = live::places_of(live::stepped(model, {}));
  setup.modes     = modes_at_load(the_case, model, {});
  setup.chain     = model.chain;
  setup.bands     = {{"third octave", 150}};
  setup.limit     = 10;
  auto comparison = std::make_unique<live::Comparison>(setup);
  for (int b = 0; b < 100; ++b) {
    live::LiveBlock block;
    block.first      = 100 * b;
    block.rate       = 1000;
    block.start_time = 1.7e9;
    block.after_gap  = b == 0;
    block.force      = Eigen::VectorXd::Constant(100, 1e6);
    block.measured   = Eigen::MatrixXd::Constant(100, 2, 1e6);
    block.simulated  = Eigen::MatrixXd::Zero(100, 6);
    for (int i = 0; i < 100; ++i)
      block.measured(i, 1) = 20 * std::sin(2 * M_PI * 150 * (100 * b + i) / 1000.0);
    comparison->take(block);
  }
  return comparison;
}
}  // namespace

TEST(LiveMetrics, TellsWhatIsOpen)
{
  const auto comparison = loud_comparison();
  MetricsInput input;
  input.comparison = comparison.get();
  live::PageAlarm gap;
  gap.kind               = "gap";
  gap.level              = "warning";
  input.own_alarms       = {gap};
  input.adopted          = "calibrated-\"1\".toml";
  input.limit            = 10;
  input.arrival_rate     = 1000.25;
  input.states           = 7;
  const std::string text = metrics_text(input);
  EXPECT_TRUE(has_line(text, "# TYPE millstand_alarms_open gauge")) << text;
  EXPECT_TRUE(has_line(text, "millstand_alarms_open{level=\"warning\",kind=\"gap\"} 1")) << text;
  EXPECT_TRUE(has_line(text, "millstand_alarms_open{level=\"alarm\",kind=\"chatter\"} 1")) << text;
  EXPECT_TRUE(has_line(text, "millstand_alarms_open{level=\"alarm\",kind=\"drift\"} 0")) << text;
  EXPECT_TRUE(has_line(text, "millstand_mode_drift_share{mode=\"1\"} 0")) << text;
  const std::string amplitude =
      "millstand_band_amplitude_metres_per_second_squared{band=\"third octave 150.0 Hz\"} ";
  const auto position = text.find(amplitude);
  ASSERT_NE(position, std::string::npos) << text;
  EXPECT_TRUE(near(std::stod(text.substr(position + amplitude.size())), 20,
                   within_absolute(0.01, "0.05 %: the filter of the band is flat at its centre")))
      << "the tone, 0-peak";
  EXPECT_TRUE(has_line(text, "millstand_proposals{state=\"open\"} 0")) << text;
  EXPECT_TRUE(has_line(text, "millstand_limit_metres_per_second_squared 10")) << text;
  EXPECT_TRUE(has_line(text, "millstand_springs_adopted{file=\"calibrated-\\\"1\\\".toml\"} 1")) << text;
  EXPECT_TRUE(has_line(text, "millstand_arrival_rate_hertz 1000.25")) << text;
  EXPECT_TRUE(has_line(text, "millstand_states_written_total 7")) << text;
}

// Every row belongs to the family whose type stands before it, and no family comes twice.
TEST(LiveMetrics, IsOpenMetrics)
{
  const auto comparison = loud_comparison();
  MetricsInput input;
  input.comparison = comparison.get();
  for (const bool with : {false, true}) {
    if (!with)
      input.comparison = nullptr;
    else
      input.comparison = comparison.get();
    std::istringstream lines(metrics_text(input));
    std::set<std::string> families;
    std::string line, family, type;
    while (std::getline(lines, line)) {
      if (line.rfind("# TYPE ", 0) == 0) {
        std::istringstream(line.substr(7)) >> family >> type;
        EXPECT_TRUE(families.insert(family).second) << family << " twice";
        continue;
      }
      const std::string name = line.substr(0, line.find_first_of("{ "));
      EXPECT_EQ(name, family + (type == "counter" ? "_total" : "")) << line;
      EXPECT_TRUE(std::isfinite(std::stod(line.substr(line.rfind(' '))))) << line;
    }
    EXPECT_GE(families.size(), with ? 12u : 6u);
  }
}
