// state.json of a recording: taken whole or refused in a sentence, and the twin goes on from it.
#include "core/base/errors.h"
#include "tests/fuzz/fuzz_file.h"
#include "twin/live/compare/comparison.h"
#include "twin/live/engine/engine.h"
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

namespace live = mill::live;

namespace {
live::TwinModel some_twin()
{
  live::TwinModel model;
  model.name = "test";
  for (auto &mass : model.chain.M)
    mass.value = 2e4;
  for (auto &spring : model.chain.K)
    spring.value = 5e9;
  model.dynamics.force_meaning = mill::ForceMeaning::measured;
  model.dynamics.modal_damping = 0.03;
  model.hash                   = "hash";
  return model;
}

live::ComparisonSetup some_setup()
{
  live::ComparisonSetup setup;
  setup.rate            = 500;
  setup.channels        = {{"force", "N"}, {"upper_work_roll", "m/s2"}};
  setup.places          = live::places_of(live::stepped(some_twin(), {}));
  setup.modes.load      = Eigen::VectorXd::Constant(1, 1e6);
  setup.modes.frequency = Eigen::RowVectorXd::LinSpaced(3, 40, 120);
  setup.modes.damping   = Eigen::VectorXd::Constant(3, 0.01);
  setup.modes.sd        = Eigen::VectorXd::Zero(3);
  setup.chain           = some_twin().chain;
  return setup;
}

live::LiveBlock block(const std::int64_t first)
{
  live::LiveBlock block;
  block.first      = first;
  block.rate       = 500;
  block.start_time = 1.7e9;
  block.force      = Eigen::VectorXd::Constant(50, 1e6);
  block.measured   = Eigen::MatrixXd::Constant(50, 2, 0.1);
  block.simulated  = Eigen::MatrixXd::Zero(50, 6);
  return block;
}

std::string seed()
{
  live::Engine engine(some_twin(), {});
  engine.take(live::SourceHead{500, 1.7e9, "test", {{"force", "N"}, {"upper_work_roll", "m/s2"}}, {1, 1}});
  engine.take(live::SourceBlock{0, block(0).measured});
  auto state = engine.state();
  live::Comparison comparison(some_setup());
  for (int i = 0; i < 20; ++i)
    comparison.take(block(50 * i));
  state["comparison"] = comparison.state();
  return state.dump();
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  if (std::getenv("MILL_FUZZ_SEED"))
    std::cout << seed();
  const auto state = nlohmann::json::parse(data, data + size, nullptr, false);
  if (state.is_discarded() || size > 100000)
    return 0;
  live::Engine engine(some_twin(), {});
  const std::string text = engine.resume(state);
  if (text.empty())
    std::abort();  // what was taken over, or why nothing was
  if (engine.source() && engine.source()->channels.size() < 100)
    engine.take(live::SourceBlock{
        engine.resumed_at(), Eigen::MatrixXd::Constant(10, Eigen::Index(engine.source()->channels.size()), 1)});
  engine.flush();
  const auto stored = engine.state().dump();
  if (state.is_object() && state.contains("comparison")) {
    live::Comparison comparison(some_setup());
    if (comparison.resume(state["comparison"]).empty()) {
      comparison.take(block(1000));
      const auto learned = comparison.state().dump();
    }
  }
  return 0;
}
