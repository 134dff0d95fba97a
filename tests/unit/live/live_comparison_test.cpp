// The twin beside the measured, through all of it: levels, modes, a contact that softens, a proposal that waits.
#include "core/base/files.h"
#include "core/case/lumped_model_toml.h"
#include "core/model/case.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include "tests/support/slowness.h"
#include "tests/support/synthetic_record.h"
#include "twin/live/compare/comparison.h"
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

using namespace mill;
using namespace mill::live;

namespace {
constexpr double rate = 2500;  // Hz

struct SixMasses {
  Eigen::VectorXd M, K;
  SixMasses()
  {
    const auto in = reference("oma.inputs", "twin");
    auto m = in["M"].get<std::vector<double>>(), k = in["K"].get<std::vector<double>>();
    M = Eigen::Map<Eigen::VectorXd>(m.data(), 6);
    K = Eigen::Map<Eigen::VectorXd>(k.data(), 7);
  }
  synthetic::Chain chain(const double k3) const
  {
    Eigen::VectorXd changed = K;
    changed[2] *= k3;
    return synthetic::chain(M, changed, 0.01);
  }
};

twin::ModesAtLoad modes_of(const SixMasses &stand, const double k3)
{
  twin::ModesAtLoad modes;
  modes.load      = Eigen::VectorXd::Constant(1, 1e6);
  modes.frequency = stand.chain(k3).frequency.transpose();
  modes.damping   = Eigen::VectorXd::Constant(6, 0.01);
  modes.sd        = Eigen::VectorXd::Zero(6);  // calibrated on this stand
  return modes;
}

ComparisonSetup setup_of(const SixMasses &stand)
{
  ComparisonSetup setup;
  setup.rate     = rate;
  setup.channels = {{"force", "N"}, {"upper_work_roll", "m/s2"}, {"lower_work_roll", "m/s2"}, {"speed", "m/s"}};
  setup.places   = {"upper_frame",     "upper_backup_roll", "upper_work_roll",
                    "lower_work_roll", "lower_backup_roll", "lower_frame"};
  setup.modes    = modes_of(stand, 1);
  for (std::size_t i = 0; i < 6; ++i)
    setup.chain.M[i].value = stand.M[Eigen::Index(i)];
  for (std::size_t i = 0; i < 7; ++i) {
    setup.chain.K[i].value          = stand.K[Eigen::Index(i)];
    setup.chain.K[i].unit           = "N/m";
    setup.chain.K[i].source         = Source::measured;
    setup.chain.K[i].error_estimate = 0.02;
  }
  setup.dynamics.modal_damping = 0.01;
  setup.unknowns               = unknowns_of(setup.chain);
  setup.recalibrate_on         = 20;
  setup.wait                   = true;
  return setup;
}

// Blocks of 20 ms as the engine hands them on: the mill has another K3 than the twin.
struct Reported {
  std::vector<PageLevels> levels;
  std::vector<PageModes> modes;
  std::vector<PageAlarm> alarms;
  std::vector<PageProposal> proposals;
  int spectra = 0;
};

Reported run(Comparison &comparison, const SixMasses &stand, const double k3, const std::uint64_t seed,
             const double seconds, const double from, const std::function<bool()> &stop = {})
{
  const auto n               = Eigen::Index(seconds * rate);
  const auto force           = synthetic::band_force(seed, n, rate, 1000, 0, 1000);
  const Eigen::MatrixXd mill = synthetic::response(stand.chain(k3), force.drive, rate),
                        twin = synthetic::response(stand.chain(1), force.drive, rate);
  Eigen::MatrixXd measured(n, 4);
  measured << (force.force.array() + 976.2e3).matrix(),
      mill.col(2) + synthetic::white(seed + 1000, n, rate, 0.005),
      mill.col(3) + synthetic::white(seed + 1001, n, rate, 0.005), Eigen::VectorXd::Constant(n, 4.0);
  Reported reported;
  const auto first = std::int64_t(from * rate);
  for (Eigen::Index begin = 0; begin < n; begin += 50) {
    LiveBlock block;
    block.first      = first + begin;
    block.rate       = rate;
    block.start_time = 1.7e9;
    block.after_gap  = begin == 0;
    block.settling   = double(begin) < 2 * rate;
    block.force      = measured.col(0).segment(begin, 50);
    block.measured   = measured.middleRows(begin, 50);
    block.simulated  = twin.middleRows(begin, 50);
    const auto news  = comparison.take(block);
    if (news.levels)
      reported.levels.push_back(*news.levels);
    if (news.modes)
      reported.modes.push_back(*news.modes);
    reported.alarms.insert(reported.alarms.end(), news.alarms.begin(), news.alarms.end());
    reported.proposals.insert(reported.proposals.end(), news.proposals.begin(), news.proposals.end());
    reported.spectra += int(news.spectra.size());
    if (stop && stop())
      break;
  }
  return reported;
}

Case given_case(const std::string &folder)
{
  const SixMasses stand;
  std::string text = "schema = 1\nkind = \"lumped\"\ntitle = \"stand of the test\"\n[given]\n";
  for (int i = 0; i < 6; ++i)
    text += "M" + std::to_string(i + 1) + " = \"" + std::to_string(stand.M[i]) + " kg\"\n";
  for (int i = 0; i < 7; ++i)
    text += "K" + std::to_string(i + 1) + " = \"" + std::to_string(stand.K[i]) + " N/m\"\n";
  text += "[dynamics]\nmodal_damping = \"1 %\"\n";
  write_atomically(folder + "/stand.toml", text);
  return read_case(folder + "/stand.toml");
}
}  // namespace

TEST(LiveComparison, ProposesASofterContact)
{
  const SixMasses stand;
  Comparison comparison(setup_of(stand));
  ASSERT_TRUE(comparison.notes().empty()) << comparison.notes()[0];

  const Reported calm = run(comparison, stand, 1, 41, 33, 0);
  ASSERT_EQ(calm.modes.size(), 3u);
  EXPECT_GE(calm.levels.size(), 30u);
  EXPECT_LE(calm.levels.size(), 31u) << "each second but those of settling";
  EXPECT_TRUE(near(double(calm.spectra), 4 * 31 * 2,
                   within_absolute(8, "four a second of two places; the first and last second may miss one")))
      << "four times a second, of two places";
  const PlaceLevel &level = calm.levels.back().places.at(0);
  EXPECT_EQ(level.place, "upper_work_roll");
  EXPECT_TRUE(near(level.ratio_db, 0, within_absolute(0.2, "dB, noise of the sensors in one second")));
  EXPECT_TRUE(
      near(level.delay, 0,
           within_absolute(5 * level.delay_sd + 1e-7, "five deviations and the rounding of an exact fit")));
  for (const BandShare &band : level.incoherent)
    if (band.frequency > 550 && band.frequency < 800)
      EXPECT_LT(band.share, 0.02) << band.frequency << " Hz, where the work roll vibrates";
  EXPECT_TRUE(calm.alarms.empty());
  EXPECT_TRUE(calm.proposals.empty());
  const PageMode &highest = calm.modes.back().modes.at(5);
  EXPECT_EQ(highest.state, "calm");
  EXPECT_LT(std::abs(highest.deviation), 4);
  EXPECT_EQ(calm.modes.back().modes.at(2).state, "not identified") << "218 Hz does not move the work rolls";

  const Reported softer = run(comparison, stand, 0.95, 43, 55, 34);
  ASSERT_FALSE(softer.alarms.empty());
  EXPECT_EQ(softer.alarms[0].kind, "drift");
  const std::string &alarm = softer.alarms[0].text;
  EXPECT_EQ(alarm.find("mode 6 has fallen by "), 0u) << alarm;
  EXPECT_NE(alarm.find(" %, from "), std::string::npos) << alarm;
  EXPECT_NE(alarm.find(" Hz by the twin to 7"), std::string::npos) << alarm;
  EXPECT_NE(alarm.find(" Hz at 976.2 kN, since about 2023-11-14 22:13:"), std::string::npos) << alarm;
  EXPECT_NE(
      alarm.find(". Something in the stand has become softer or heavier: look for what was changed then at "
                 "rolls, chocks, bearings, wedges or liners, and for loose parts. The twin is as it was; new "
                 "springs are proposed when a minute since the change was measured, and hold when somebody "
                 "adopts them."),
      std::string::npos)
      << alarm;
  EXPECT_EQ(softer.modes.back().modes.at(5).state, "drifted");
  ASSERT_EQ(softer.proposals.size(), 1u);
  const PageProposal &page = softer.proposals[0];
  EXPECT_EQ(page.state, "open");
  for (const ProposedValue &value : page.values) {
    if (value.key == "K3") {
      EXPECT_TRUE(value.identified);
      EXPECT_TRUE(near(value.to / value.from, 0.95, within_absolute(0.002, "noise of a minute of record")));
      EXPECT_LT(value.low, 0.95 * value.from);
      EXPECT_GT(value.high, 0.95 * value.from);
    } else if (value.identified) {
      EXPECT_TRUE(near(value.to / value.from, 1,
                       within_absolute(0.05, "springs that were not changed: noise of a minute of record")))
          << value.key;
    } else {
      EXPECT_EQ(value.to, value.from) << value.key;
    }
  }

  EXPECT_EQ(page.text.find("Mode 6 has fallen by "), 0u) << page.text;

  // nothing is adopted by itself: the twin is compared as before, minutes later
  const Reported later = run(comparison, stand, 0.95, 45, 24, 90);
  EXPECT_TRUE(later.proposals.empty());
  EXPECT_TRUE(near(later.modes.back().modes.at(5).twin_frequency, stand.chain(1).frequency[5],
                   within_absolute(1e-9, "the twin is as it was, rounding")));
  EXPECT_EQ(comparison.proposals().at(0).state, ProposalState::open);
  EXPECT_TRUE(comparison.proposals().at(0).file.empty());
}

// The contact softens, the proposal is adopted, the contact softens once more.  The posterior of the adopted
// spring is some 1e-5; how far the contact moves next has nothing to do with it.  The same after a restart.
TEST(LiveComparison, ASecondChangeIsProposedAfterAnAdoption)
{
  const SixMasses stand;
  ComparisonSetup setup = setup_of(stand);
  Comparison comparison(setup);
  constexpr double once = 0.95, twice = 0.92;  // of K3
  run(comparison, stand, once, 43, 55, 0);
  ASSERT_EQ(comparison.proposals().size(), 1u);
  const Proposal first = comparison.proposals()[0];
  const auto value_of  = [](const Proposal &proposal, const std::string &name) {
    for (const twin::RecalibratedValue &value : proposal.recalibration.values)
      if (value.name == name)
        return value;
    ADD_FAILURE() << name;
    return twin::RecalibratedValue{};
  };
  const twin::RecalibratedValue before = value_of(first, "K3");
  EXPECT_EQ(before.prior_sd, 0.1) << "the case states 2 %: three times it is less than a change of a tenth";
  ASSERT_TRUE(before.identified);
  ASSERT_LT(before.sd, 0.001);
  const auto modes = modes_of(stand, first.chain.K[2].value / setup.chain.K[2].value);
  comparison.set_twin(first.chain, setup.dynamics, modes);

  setup.chain    = first.chain;
  setup.unknowns = unknowns_of(first.chain);
  setup.modes    = modes;
  Comparison restarted(setup);
  for (Comparison *now : {&comparison, &restarted}) {
    run(*now, stand, twice, 47, 55, 60);
    std::string open;
    for (const PageAlarm &alarm : now->open_alarms())
      open += alarm.text + "\n";
    ASSERT_EQ(now->proposals().size(), now == &comparison ? 2u : 1u) << open;
    const Proposal &second = now->proposals().back();
    EXPECT_TRUE(near(second.chain.K[2].value / setup_of(stand).chain.K[2].value, twice,
                     within_absolute(0.002, "noise of twenty seconds of record")));
    EXPECT_EQ(value_of(second, "K3").prior_sd, 0.1);
  }
}

// What a re-calibration may move has the errors of the twin as it then is: of an adopted spring its posterior,
// where that is wide enough to matter.
TEST(LiveComparison, AnAdoptionRenewsThePrior)
{
  const SixMasses stand;
  ComparisonSetup setup = setup_of(stand);
  Comparison comparison(setup);
  LumpedModel adopted         = setup.chain;
  adopted.K[2].error_estimate = 0.05;
  comparison.set_twin(adopted, setup.dynamics, modes_of(stand, 1));  // the same modes
  run(comparison, stand, 0.95, 43, 55, 0);
  ASSERT_EQ(comparison.proposals().size(), 1u);
  for (const twin::RecalibratedValue &value : comparison.proposals()[0].recalibration.values)
    EXPECT_TRUE(near(value.prior_sd,
                     value.name == "K3"                ? 3 * 0.05
                     : value.name == twin::ratios_name ? 3 * std::log(2.0)
                                                       : 0.1,
                     within(1e-12, "(50.11), rounding")))
        << value.name;
}

// A slider is moved while a re-calibration runs: what it finds belongs to the twin of before.
TEST(LiveComparison, ProposesNothingForATwinThatWasChangedMeanwhile)
{
  const SixMasses stand;
  ComparisonSetup setup = setup_of(stand);
  setup.wait            = false;
  LumpedModel now       = setup.chain;
  int begun             = 0;
  setup.chain_at        = [&](double) { return ++begun, now; };
  Comparison comparison(setup);
  constexpr double truth = 0.97, slider = 1.02;  // of K3
  double from = 0;
  for (; begun == 0 && from < 100; from += 23)
    run(comparison, stand, truth, 71, 23, from, [&] { return begun > 0; });
  ASSERT_EQ(begun, 1);
  now.K[2].value *= slider;
  comparison.set_twin(now, setup.dynamics, modes_of(stand, slider));
  // the background has the lowest priority: on a busy machine, and with a sanitizer, it takes its time
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(120 * slowness());
  for (; comparison.proposals().empty() && std::chrono::steady_clock::now() < limit; from += 23) {
    run(comparison, stand, truth, 71, 23, from);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  EXPECT_GE(begun, 2) << "the first result was left unused, the changed twin is re-calibrated";
  std::string open;
  for (const PageAlarm &alarm : comparison.open_alarms())
    open += alarm.text + "\n";
  ASSERT_EQ(comparison.proposals().size(), 1u) << open << begun;
  const Proposal &proposal = comparison.proposals()[0];
  EXPECT_EQ(proposal.before.K[2].value, now.K[2].value);
  EXPECT_TRUE(near(proposal.chain.K[2].value / setup.chain.K[2].value, truth,
                   within_absolute(0.005, "noise of twenty seconds of record")));
  EXPECT_EQ(proposal.state, ProposalState::open);
  comparison.set_twin(now, setup.dynamics, modes_of(stand, slider));
  EXPECT_EQ(proposal.state, ProposalState::open) << "the same twin once more";
  comparison.set_twin(setup.chain, setup.dynamics, modes_of(stand, 1));
  EXPECT_EQ(proposal.state, ProposalState::out_of_date);
  EXPECT_FALSE(comparison.adopt(proposal.id, 1.7e9, testing::TempDir(), {}));
}

// Killed between two blocks and started again, it goes on as one that ran through: sums, alarm, what is proposed.
TEST(LiveComparison, KeepsItsDriftOverARestart)
{
  const SixMasses stand;
  constexpr double slightly = 0.9999;  // of K3: some standard deviations of a block
  Comparison through(setup_of(stand)), first(setup_of(stand));
  run(through, stand, slightly, 51, 23, 0);
  run(first, stand, slightly, 51, 23, 0);
  const auto before = through.drift().modes[5].watch.sums;
  ASSERT_GT(std::max(before.up, before.down), 0) << "something has been summed";
  ASSERT_FALSE(before.alarm);
  Comparison again(setup_of(stand));
  ASSERT_EQ(again.resume(first.state()), "");
  Reported whole, parted;
  for (int i = 1; i < 6 && whole.alarms.empty(); ++i) {
    whole  = run(through, stand, slightly, std::uint64_t(51 + 2 * i), 23, 23.0 * i);
    parted = run(again, stand, slightly, std::uint64_t(51 + 2 * i), 23, 23.0 * i);
  }
  ASSERT_FALSE(whole.alarms.empty());
  ASSERT_EQ(parted.alarms.size(), whole.alarms.size());
  for (std::size_t i = 0; i < whole.alarms.size(); ++i) {
    EXPECT_EQ(parted.alarms[i].text, whole.alarms[i].text);
    EXPECT_EQ(parted.alarms[i].utc, whole.alarms[i].utc);
  }
  EXPECT_NE(
      parted.alarms[0].text.find("That is little, but more than chance: see whether it goes on. The twin is"),
      std::string::npos)
      << parted.alarms[0].text;
  EXPECT_EQ(again.drift().modes[5].watch.sums.down, through.drift().modes[5].watch.sums.down);

  // the alarm and its number survive too, and what is open is not identified a second time
  Comparison third(setup_of(stand));
  ASSERT_EQ(third.resume(again.state()), "");
  const auto open = third.open_alarms(), were = again.open_alarms();
  ASSERT_EQ(open.size(), were.size());
  for (std::size_t i = 0; i < open.size(); ++i)
    EXPECT_EQ(open[i].id, were[i].id);
  EXPECT_EQ(third.proposals().size(), again.proposals().size());
}

TEST(LiveComparison, AdoptedProposalIsACase)
{
  namespace fs             = std::filesystem;
  const std::string folder = testing::TempDir() + "adopted-proposal";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const Case origin = given_case(folder);
  Proposals proposals;
  Proposal proposal;
  proposal.utc                   = 1.7e9;
  proposal.from                  = 1.7e9 - 60;
  proposal.to                    = 1.7e9;
  proposal.reason                = "Mode 6 has fallen by 2.50 %.";
  proposal.recalibration.seconds = 60;
  proposal.recalibration.values  = {{"K3", 0.06, std::log(0.95), 0.001, true},
                                    {"K1", 0.06, 0, 0.02, false},
                                    {"zeta", 2, std::log(1.2), 0.01, true}};
  proposal.before                = lumped_model_of(origin);
  proposal.chain                 = recalibrated(proposal.before, proposal.recalibration, 976.2e3);
  proposal.damping_before        = 0.01;
  proposal.damping               = recalibrated(0.01, proposal.recalibration);
  proposals.add(proposal);
  const auto text = [&](const Proposal &p, const std::string &directory) {
    return calibrated_case(p, origin, directory);
  };
  EXPECT_TRUE(fs::is_empty(folder) || !fs::exists(folder + "/adopted.log")) << "nothing before somebody says so";
  const auto adopted = proposals.adopt(1, 1.7e9 + 5, folder, text);
  ASSERT_TRUE(adopted);
  EXPECT_EQ(fs::path(adopted->file).filename(), "calibrated-20231114T221325Z.toml");
  const Case read         = read_case(adopted->file);
  const LumpedModel chain = lumped_model_of(read);
  EXPECT_TRUE(near(chain.K[2].value, 0.95 * proposal.before.K[2].value, within(1e-9, "as written")));
  EXPECT_TRUE(near(chain.K[0].value, proposal.before.K[0].value, within(1e-9, "not identified: as before")));
  EXPECT_TRUE(near(std::get<Lumped>(read.spec).dynamics.modal_damping, 0.012,
                   within_absolute(1e-9, "0.01 exp(ln 1.2), digits of the file")));
  const std::string file = read_text(adopted->file);
  EXPECT_NE(file.find("# K3: -5.00 %, standard deviation 0.10 %"), std::string::npos) << file;
  EXPECT_NE(file.find("# not identified by these data, as before: K1"), std::string::npos);
  EXPECT_EQ(read_text(folder + "/adopted.log"),
            "2023-11-14T22:13:25Z proposal 1 adopted: calibrated-20231114T221325Z.toml; Mode 6 has fallen by "
            "2.50 %.\n");
  EXPECT_FALSE(proposals.adopt(1, 1.7e9 + 6, folder, text)) << "once";
  EXPECT_FALSE(proposals.adopt(7, 1.7e9 + 6, folder, text)) << "no such number";
  proposals.add(proposal);
  proposals.add(proposal);
  EXPECT_EQ(proposals.find(1)->state, ProposalState::adopted);
  EXPECT_EQ(proposals.find(2)->state, ProposalState::out_of_date);
  EXPECT_THROW(proposals.adopt(3, 1.7e9 + 5, folder + "/nowhere", text), std::exception);
  EXPECT_EQ(proposals.find(3)->state, ProposalState::open) << "what could not be written is not adopted";
  fs::rename(folder + "/adopted.log", folder + "/kept.log");
  fs::create_directories(folder + "/adopted.log");
  EXPECT_THROW(proposals.adopt(3, 1.7e9 + 5, folder, text), std::exception);
  EXPECT_FALSE(fs::exists(folder + "/calibrated-20231114T221325Z-2.toml")) << "nor is its case left there";
  fs::remove(folder + "/adopted.log");
  fs::rename(folder + "/kept.log", folder + "/adopted.log");
  ASSERT_TRUE(proposals.adopt(3, 1.7e9 + 5, folder, text));
  EXPECT_EQ(fs::path(proposals.find(3)->file).filename(), "calibrated-20231114T221325Z-2.toml")
      << "nothing is overwritten";
}

TEST(LiveComparison, SaysWhatCannotBeCompared)
{
  const SixMasses stand;
  ComparisonSetup setup = setup_of(stand);
  setup.channels        = {{"force", "N"}, {"upper_work_roll", "V"}};
  Comparison comparison(setup);
  ASSERT_EQ(comparison.notes().size(), 2u);
  EXPECT_EQ(comparison.notes()[0], "channel upper_work_roll is in \"V\" and not in m/s2: it is not compared");
  EXPECT_EQ(comparison.notes()[1],
            "no channel is an acceleration at a place of the model: the twin is not compared with the mill");
  LiveBlock block;
  block.rate      = rate;
  block.force     = Eigen::VectorXd::Zero(100);
  block.measured  = Eigen::MatrixXd::Zero(100, 2);
  block.simulated = Eigen::MatrixXd::Zero(100, 6);
  EXPECT_FALSE(comparison.take(block).levels);
}

TEST(LiveComparison, AlarmsHaveOneNumberUntilTheyAreOver)
{
  AlarmBook book(100);
  book.raise("a", 1, "chatter", "alarm", "one");
  book.raise("a", 2, "chatter", "alarm", "one");
  book.raise("b", 3, "drift", "warning", "two");
  auto news = book.news();
  ASSERT_EQ(news.size(), 2u);
  EXPECT_EQ(news[0].id, 100);
  EXPECT_EQ(news[0].utc, 1);
  for (int k = 0; k < 200; ++k)
    book.raise("b", 4, "drift", "warning", "two " + std::to_string(k));
  book.raise("a", 4, "chatter", "alarm", "three");
  news = book.news();
  ASSERT_EQ(news.size(), 2u) << "each once, as it is now";
  EXPECT_EQ(news[0].text, "two 199");
  EXPECT_EQ(news[1].text, "three");
  book.end("a");
  book.end("unknown");
  news = book.news();
  ASSERT_EQ(news.size(), 1u);
  EXPECT_TRUE(news[0].over);
  EXPECT_EQ(news[0].id, 100);
  book.raise("a", 5, "chatter", "alarm", "one");
  EXPECT_EQ(book.news()[0].id, 102);
}

TEST(LiveComparison, BackgroundWorkGivesItsResultOnce)
{
  LowPriorityTask<int> task;
  EXPECT_FALSE(task.wait());
  ASSERT_TRUE(task.start([] { return 7; }));
  EXPECT_EQ(task.wait().value(), 7);
  EXPECT_FALSE(task.finished());
  ASSERT_TRUE(task.start([] { return 8; }));
  EXPECT_FALSE(task.start([] { return 9; })) << "one at a time";
  EXPECT_EQ(task.wait().value(), 8);
}
