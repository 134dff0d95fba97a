// The state of a restart as a stranger's text: whatever stands there, it is taken whole or refused in a sentence.
#include "tests/support/live_samples.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include "twin/live/compare/comparison.h"
#include <cstdlib>
#include <gtest/gtest.h>
#include <random>

using namespace mill;

namespace {
using Json = nlohmann::json;

constexpr double rate = 500;  // Hz

live::TwinModel stored_twin()
{
  const ParameterSet set = parameter_set("R3");
  live::TwinModel model;
  model.name     = "test";
  model.source   = "as published";
  model.chain    = set.stand;
  model.dynamics = set.dynamics;
  model.hash     = "hash";
  return model;
}

live::ComparisonSetup stored_setup()
{
  live::ComparisonSetup setup;
  setup.rate            = rate;
  setup.channels        = {{"force", "N"}, {"upper_work_roll", "m/s2"}};
  setup.places          = live::places_of(live::stepped(stored_twin(), {}));
  setup.modes.load      = Eigen::VectorXd::Constant(1, 1e6);
  setup.modes.frequency = Eigen::RowVectorXd::LinSpaced(3, 40, 120);
  setup.modes.damping   = Eigen::VectorXd::Constant(3, 0.01);
  setup.modes.sd        = Eigen::VectorXd::Zero(3);
  setup.chain           = stored_twin().chain;
  setup.limit           = 5;
  return setup;
}

live::LiveBlock stored_block(const std::int64_t first)
{
  live::LiveBlock block;
  block.first      = first;
  block.rate       = rate;
  block.start_time = 1.7e9;
  block.after_gap  = first == 0;
  block.force      = Eigen::VectorXd::Constant(50, 1e6);
  block.measured   = Eigen::MatrixXd::Constant(50, 2, 0.1);
  block.simulated  = Eigen::MatrixXd::Zero(50, 6);
  for (Eigen::Index i = 0; i < 50; ++i)
    block.measured(i, 1) = 20 * std::sin(2 * M_PI * 80 * double(first + i) / rate);
  return block;
}

// A state with everything in it: motion, account, adopted springs, sums, an alarm, a proposal, a drift that waits.
Json whole_state()
{
  auto adopted    = stored_twin();
  adopted.adopted = "calibrated-20260105T100000Z.toml";
  adopted.chain.K[2].value *= 0.95;
  live::EngineHooks hooks;
  hooks.adopt = [&](std::int64_t) { return adopted; };
  live::Engine engine(stored_twin(), hooks);
  engine.take(live::SourceHead{rate, 1.7e9, "test", {{"force", "N"}, {"upper_work_roll", "m/s2"}}, {1, 1}});
  for (int i = 0; i < 4; ++i)
    engine.take(live::SourceBlock{50 * i, stored_block(50 * i).measured});
  engine.apply({live::PageCommandKind::adopt, "", 1, 1, ""});
  engine.apply({live::PageCommandKind::set, "K3", 1.1, 0, ""});
  Json state = engine.state();
  live::Comparison comparison(stored_setup());
  for (int i = 0; i < 100; ++i)
    comparison.take(stored_block(50 * i));
  state["comparison"]              = comparison.state();
  state["comparison"]["proposals"] = Json::array(
      {{{"id", 3},
        {"utc", 1.7e9},
        {"from", 1.7e9},
        {"to", 1.7e9},
        {"reason", "Mode 1 has fallen by 2.00 %."},
        {"state", "open"},
        {"file", ""},
        {"seconds", 60},
        {"misfit_before", 2},
        {"misfit_after", 1},
        {"load", 1e6},
        {"damping", 0.03},
        {"values", {{{"name", "K3"}, {"prior_sd", 0.06}, {"change", -0.05}, {"sd", 0.001}, {"told", true}}}},
        {"springs", Json::array()}}});
  for (const Parameter &K : stored_setup().chain.K)
    state["comparison"]["proposals"][0]["springs"].push_back({{"value", K.value}});
  state["comparison"]["waiting"] = {{"mode", 1},  {"sign", -1},      {"since", 3},     {"taken", 9},  {"sum", 13},
                                    {"mean", -2}, {"change", -0.02}, {"began", 1.7e9}, {"at", 1.7e9}, {"from", 4}};
  return Json::parse(state.dump());
}

void all_members(Json &json, std::vector<Json *> &found)
{
  found.push_back(&json);
  for (auto &member : json)
    if (json.is_structured())
      all_members(member, found);
}

// One member anywhere becomes something else, is left out, or is there twice.
void spoil(Json &state, std::mt19937_64 &random)
{
  static const std::vector<Json> odd{nullptr,
                                     true,
                                     -1,
                                     0,
                                     3,
                                     1e300,
                                     -1e300,
                                     9007199254740993,
                                     18446744073709551615ull,
                                     1e-300,
                                     "",
                                     "force",
                                     std::string(5000, 'x'),
                                     Json::array(),
                                     Json::object(),
                                     Json::array({nullptr}),
                                     Json::array({Json::object()})};
  std::vector<Json *> members;
  all_members(state, members);
  Json &changed = *members[random() % members.size()];
  if (changed.is_array() && !changed.empty() && random() % 3 == 0)
    changed.push_back(changed[random() % changed.size()]);
  else if (changed.is_structured() && !changed.empty() && random() % 2)
    changed.erase(std::next(changed.begin(), std::ptrdiff_t(random() % changed.size())));
  else
    changed = odd[random() % odd.size()];
}
}  // namespace

TEST(StoredState, GoesOnWithAdoptedSpringsAndSlidersOverThem)
{
  const Json state = whole_state();
  live::Engine engine(stored_twin(), {});
  EXPECT_EQ(
      engine.resume(state),
      "springs and damping as adopted in calibrated-20260105T100000Z.toml; --fresh goes back to those of the "
      "case\ngoes on at s = 200 of source \"test\"");
  EXPECT_DOUBLE_EQ(engine.model().chain.K[2].value, 0.95 * stored_twin().chain.K[2].value);
  EXPECT_EQ(engine.model().chain.K[0].source, stored_twin().chain.K[0].source) << "not moved: the case's own";
  EXPECT_EQ(engine.tuning().spring[2], 1.1);
  EXPECT_EQ(engine.state().dump(), [&] {
    Json same = state;
    same.erase("comparison");
    return same.dump();
  }()) << "stored again it is the same";
}

TEST(StoredState, ReportsOlderAndDamagedStates)
{
  const auto refusal_of = [](const char *pointer, const Json &value) {
    Json state                         = whole_state();
    state[Json::json_pointer(pointer)] = value;
    live::Engine engine(stored_twin(), {});
    const std::string text = engine.resume(state);
    EXPECT_FALSE(engine.source()) << pointer;
    EXPECT_TRUE(engine.model().adopted.empty()) << "nothing of it is taken: " << pointer;
    return text;
  };
  EXPECT_EQ(refusal_of("/format", 1),
            "the stored state is of another version of this program; the twin starts without it");
  EXPECT_EQ(
      refusal_of("/case_hash", "other"),
      "the stored state belongs to another case, or to other values of this one; the twin starts without it");
  EXPECT_EQ(
      refusal_of("/motion/displacement", {1, 2}),
      "the stored state cannot be used: motion has a \"displacement\" that is not a list of 6 numbers; the twin "
      "starts without it");
  EXPECT_EQ(refusal_of("/channels/0/offered", 7),
            "the stored state cannot be used: channels has an account that does "
            "not balance; the twin starts without it");
  EXPECT_EQ(refusal_of("/source/rate", 0),
            "the stored state cannot be used: source has a \"rate\" of 0, outside 0.001 .. 1e+09; the twin starts "
            "without it");
  EXPECT_EQ(
      refusal_of("/next", 1e30),
      "the stored state cannot be used: it has a \"next\" that is not a whole number; the twin starts without it");
  EXPECT_EQ(
      refusal_of("/adopted/springs/2/value", nullptr),
      "the stored state cannot be used: adopted has other springs than the case; the twin starts without it");
}

TEST(StoredState, RestoresWhatWasLearned)
{
  const Json learned = whole_state()["comparison"];
  live::Comparison comparison(stored_setup());
  ASSERT_EQ(comparison.resume(learned), "");
  ASSERT_EQ(comparison.proposals().size(), 1u);
  const live::Proposal &proposal = comparison.proposals()[0];
  EXPECT_EQ(proposal.id, 3);
  EXPECT_DOUBLE_EQ(proposal.chain.K[2].value, std::exp(-0.05) * stored_setup().chain.K[2].value);
  ASSERT_EQ(comparison.open_alarms().size(), 1u);
  EXPECT_EQ(comparison.open_alarms()[0].text, "chatter at 80 Hz, upper_work_roll: 20 m/s2 is above the limit of 5 "
                                              "m/s2 that is set for this mill; the nearest "
                                              "mode of the twin is mode 2 at 80.0 Hz");
  EXPECT_EQ(Json::parse(comparison.state().dump()), learned) << "stored again it is the same";
  auto setup            = stored_setup();
  setup.modes.frequency = Eigen::RowVectorXd::LinSpaced(3, 45, 185);
  live::Comparison other(setup);
  ASSERT_EQ(other.resume(learned), "");
  EXPECT_TRUE(other.open_alarms().empty()) << "nothing watches that band any more";
  Json damaged                         = learned;
  damaged["drift"]["modes"][0]["mean"] = "much";
  live::Comparison fresh(stored_setup());
  EXPECT_EQ(fresh.resume(damaged),
            "what was learned of the mill cannot be used: modes has a \"mean\" that is not a "
            "number; drift, baselines, alarms and proposals start without it");
  EXPECT_TRUE(fresh.proposals().empty());
}

// A restart inside a minute holds levels against what was calm before it.
TEST(StoredState, ABaselineIsCarriedOverARestart)
{
  live::Comparison before(stored_setup());
  for (int i = 0; i < 100; ++i)
    before.take(stored_block(50 * i));
  const auto state = before.state();
  live::Comparison after(stored_setup());
  ASSERT_EQ(after.resume(state), "");
  auto block      = stored_block(5000);
  block.after_gap = true;
  after.take(block);
  for (int i = 1; i < 10; ++i)
    after.take(stored_block(5000 + 50 * i));
  const auto band = after.bands().at(1), own = before.bands().at(1);
  EXPECT_TRUE(near(band.baseline, own.baseline, within(1e-9, "the baseline is stored with all its digits")))
      << "one second after the restart";
  live::Comparison late(stored_setup());
  ASSERT_EQ(late.resume(state), "");
  block = stored_block(5000 + 500 * 3600);
  late.take(block);
  EXPECT_TRUE(std::isnan(late.bands().at(1).baseline)) << "an hour later another strip may be in the mill";
}

// Long form: MILLSTAND_PASSES = 50 is 1e5 of them.
TEST(StoredState, SurvivesAnyText)
{
  const char *const passes = std::getenv("MILLSTAND_PASSES");
  const int n              = 2000 * (passes ? std::max(1, std::atoi(passes)) : 1);
  const Json whole         = whole_state();
  const std::string text   = whole.dump();
  std::mt19937_64 random(21);
  int taken = 0, refused = 0;
  live::Comparison comparison(stored_setup());
  for (int i = 0; i < n; ++i) {
    Json state = whole;
    if (i % 2) {
      for (auto more = 1 + random() % 3; more-- > 0;)
        spoil(state, random);
    } else {
      std::string bytes = text;
      for (auto more = 1 + random() % 4; more-- > 0;)
        bytes[random() % bytes.size()] = "0123456789-+eE.,:[]{}\"ntfx"[random() % 26];
      state = Json::parse(bytes, nullptr, false);
    }
    live::Engine engine(stored_twin(), {});
    const std::string message = engine.resume(state);
    ASSERT_FALSE(state.is_object() && message.empty() && engine.source()) << "whatever is taken is said";
    ++(engine.source() ? taken : refused);
    if (engine.source()) {
      engine.take(live::SourceBlock{
          engine.resumed_at(), Eigen::MatrixXd::Constant(10, Eigen::Index(engine.source()->channels.size()), 1)});
      engine.flush();
      ASSERT_TRUE(engine.book()->balanced());
      ASSERT_FALSE(engine.state().dump(-1, ' ', false, Json::error_handler_t::replace).empty());
    }
    if (!state.is_object() || !state.contains("comparison"))
      continue;
    if (comparison.resume(state["comparison"]).empty()) {
      comparison.take(stored_block(50 * i));
      ASSERT_FALSE(comparison.state().dump(-1, ' ', false, Json::error_handler_t::replace).empty());
    }
  }
  EXPECT_GT(taken, n / 20);
  EXPECT_GT(refused, n / 20);
}
