// Sliders and re-calibrations: springs are proposed on the chain as the sliders have it.
#include "app/command/command_line.h"
#include "app/twin/live/live_alarms.h"
#include "app/twin/live/live_comparison.h"
#include "app/twin/live/live_console.h"
#include "app/twin/live/live_detail.h"
#include "app/twin/live/live_stand.h"
#include "core/base/files.h"
#include "core/case/lumped_model_toml.h"
#include "core/model/case.h"
#include "tests/support/near.h"
#include "tests/support/synthetic_record.h"
#include <cmath>

using namespace mill;

namespace {
constexpr double rate = 2500;  // Hz

// A stand of six masses whose springs are well known, so that the twin itself is what its modes are compared with.
struct KnownStand {
  Case the_case = read_case("cases/published-1400.toml");
  live::TwinModel model;
  KnownStand()
  {
    const double K[7] = {6.3e9, 1.02e10, 5.5e10, 5e9, 5.8e10, 2.9e10, 6.9e9};
    model             = live_model(the_case, true);
    for (std::size_t j = 0; j < 7; ++j) {
      model.chain.K[j].value          = K[j];
      model.chain.K[j].source         = Source::given;
      model.chain.K[j].error_estimate = 1e-9;
    }
    model.chain.C.value          = std::numeric_limits<double>::quiet_NaN();
    model.dynamics               = {};
    model.dynamics.modal_damping = 0.01;
  }
  synthetic::Chain mill(const double k3) const
  {
    live::Tuning tuning;
    live::set_factor(tuning, "K3", k3);
    const auto chain = live::tuned(model, tuning);
    Eigen::VectorXd K(7);
    for (Eigen::Index j = 0; j < 7; ++j)
      K[j] = chain.springs[std::size_t(j)].stiffness;
    return synthetic::chain(chain.M, K, 0.01);
  }
};
}  // namespace

TEST(LiveRecalibration, StartsFromTheSpringsOfTheSliders)
{
  const KnownStand stand;
  CommandLine command;
  command.target     = "cases/published-1400.toml";
  command.live.speed = "max";  // results are waited for
  LiveAlarms alarms([](const std::string &, const std::string &) {});
  LiveConsole console(true, alarms);
  LiveComparison comparison(command, stand.the_case, {}, console);
  live::LiveSource source;
  source.rate     = rate;
  source.channels = {{"force", "N"}, {"upper_work_roll", "m/s2"}, {"lower_work_roll", "m/s2"}};
  source.places   = live::places_of(live::stepped(stand.model, {}));
  comparison.begin(source, stand.model, {});
  live::Tuning tuning;
  live::set_factor(tuning, "K3", 1.1);
  comparison.changed_model(stand.model, tuning);

  const double truth         = 1.045;  // of K3; 5 % below the slider
  const auto n               = Eigen::Index(75 * rate);
  const auto force           = synthetic::band_force(61, n, rate, 1000, 0, 1000);
  const Eigen::MatrixXd mill = synthetic::response(stand.mill(truth), force.drive, rate),
                        twin = synthetic::response(stand.mill(1.1), force.drive, rate);
  std::vector<live::PageProposal> proposals;
  for (Eigen::Index begin = 0; begin < n && proposals.empty(); begin += 50) {
    live::LiveBlock block;
    block.first      = begin;
    block.rate       = rate;
    block.start_time = 1.7e9;
    block.after_gap  = begin == 0;
    block.settling   = double(begin) < 2 * rate;
    block.force      = force.force.segment(begin, 50).array() + 976.2e3;
    block.simulated  = twin.middleRows(begin, 50);
    block.measured.resize(50, 3);
    block.measured << block.force, mill.block(begin, 2, 50, 2);
    proposals = comparison.take(block).proposals;
  }
  ASSERT_EQ(proposals.size(), 1u);
  for (const live::ProposedValue &value : proposals[0].values)
    if (value.key == "K3") {
      const double K3 = stand.model.chain.K[2].value;
      EXPECT_TRUE(value.identified);
      EXPECT_TRUE(near(value.from / K3, 1.1, within(1e-12, "the slider, one product")));
      EXPECT_TRUE(near(value.to / K3, truth, within(0.002, "a minute of record")));
    }
}
