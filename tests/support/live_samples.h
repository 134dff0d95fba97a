#pragma once
#include "twin/live/engine/engine.h"
#include <Eigen/Core>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

/// An engine of the live twin that is sent a force, and what it gave away.
class LiveSamples {
public:
  /// @param state  of an earlier one, to go on from
  LiveSamples(const mill::live::TwinModel &model, double rate, const nlohmann::json *state = nullptr)
  {
    mill::live::EngineHooks hooks;
    hooks.observers.push_back([this](const mill::live::LiveBlock &block) { blocks.push_back(block); });
    hooks.reported = [this](const std::string &kind, const std::string &text) {
      messages.push_back(kind + ": " + text);
    };
    engine_ = std::make_unique<mill::live::Engine>(model, hooks);
    if (state)
      messages.push_back(engine_->resume(*state));
    engine_->take(mill::live::SourceHead{rate, {}, "test", {{"force", "N"}}, {1}});
  }
  /// Force in N, in blocks; NaN: null.
  void send(const Eigen::VectorXd &force, const Eigen::Index length, std::int64_t first = 0)
  {
    for (Eigen::Index begin = 0; begin < force.size(); begin += length) {
      const Eigen::Index n = std::min(length, force.size() - begin);
      engine_->take(mill::live::SourceBlock{first + begin, force.segment(begin, n)});
    }
    engine_->flush();
  }
  Eigen::MatrixXd simulated() const
  {
    Eigen::Index n = 0;
    for (const auto &block : blocks)
      n += block.simulated.rows();
    Eigen::MatrixXd all(n, blocks.empty() ? 6 : blocks.front().simulated.cols());
    n = 0;
    for (const auto &block : blocks) {
      all.middleRows(n, block.simulated.rows()) = block.simulated;
      n += block.simulated.rows();
    }
    return all;
  }
  bool any_gap() const
  {
    for (const auto &block : blocks)
      if (block.after_gap)
        return true;
    return false;
  }
  mill::live::Engine &engine()
  {
    return *engine_;
  }

  std::vector<mill::live::LiveBlock> blocks;
  std::vector<std::string> messages;

private:
  std::unique_ptr<mill::live::Engine> engine_;
};
