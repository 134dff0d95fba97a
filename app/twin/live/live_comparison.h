#pragma once
#include "app/command/command_line.h"
#include "app/twin/live/live_console.h"
#include "twin/live/compare/comparison.h"
#include "twin/live/engine/engine.h"
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace mill {
struct Case;

/// The comparison of twin and measured with what it learned from one source to the next, and the model that a
/// proposal makes.  In the thread of the engine.
class LiveComparison {
public:
  /// @param limit  m/s2, 0-peak: the mill's own
  LiveComparison(const CommandLine &command, const Case &the_case, std::optional<double> limit,
                 LiveConsole &console);
  ~LiveComparison();

  /// State that the comparison of the next source goes on from.  nullptr: none.
  void set_learned(std::unique_ptr<nlohmann::json> state);
  void begin(const live::LiveSource &source, const live::TwinModel &model, const live::Tuning &tuning);
  bool lost() const  ///< what was learned before could not be taken over by the last begin()
  {
    return lost_;
  }
  live::ComparisonNews take(const live::LiveBlock &block);
  void changed_model(const live::TwinModel &model, const live::Tuning &tuning);
  /// The model of a proposal, whose case is written.  Nothing: not open, or it cannot be written.
  std::optional<live::TwinModel> adopt(std::int64_t id);
  const live::Comparison *comparison() const  ///< nullptr before the first source
  {
    return comparison_ ? &*comparison_ : nullptr;
  }

private:
  live::ComparisonSetup setup(const live::LiveSource &source) const;
  LumpedModel tuned_chain_at(double load) const;  // N

  const CommandLine &command_;
  const Case &the_case_;
  std::optional<double> limit_;
  LiveConsole &console_;
  live::TwinModel model_;                    // as the comparison has it
  live::Tuning tuning_;                      // of it
  std::string critical_of_;                  // adopted springs that the critical speed is computed with
  std::unique_ptr<nlohmann::json> learned_;  // state of the last comparison, for the next one
  std::optional<live::Comparison> comparison_;
  bool lost_ = false;
};
}  // namespace mill
