#pragma once
#include "twin/live/account_book.h"
#include "twin/live/engine/twin_model.h"
#include "twin/live/engine/twin_stepper.h"
#include "twin/live/live_block.h"
#include "twin/live/page/page_command.h"
#include "twin/live/queue/messages.h"
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace mill::live {
/// A source as the observers of blocks need to know it.
struct LiveSource {
  std::string name;
  double rate       = 0;              ///< Hz
  double start_time = 0;              ///< s since 1970 UTC, of sample 0
  std::vector<LiveChannel> channels;  ///< columns of LiveBlock::measured
  std::vector<std::string> places;    ///< columns of LiveBlock::simulated
  std::vector<double> factor;         ///< -, (channels) SI value over the number sent
};

/// What the numbers of a source are above those that a head gives its samples (48.8).  Nothing: the head does not
/// go on with the source.
/// @param start_known  the source has said when its sample 0 was
std::optional<std::int64_t> offset_of(const SourceHead &head, const LiveSource &source, bool start_known);

/// Who listens to the engine.  All are called from its thread.
struct EngineHooks {
  std::vector<std::function<void(const LiveSource &)>> sources;  ///< a source started, or started again
  std::vector<std::function<void(const LiveBlock &)>> observers;
  std::vector<std::function<void(const TwinModel &, const Tuning &)>> models;  ///< after a change on the run
  std::function<void(std::int64_t first, const Eigen::MatrixXd &rows)> rows;   ///< as they came: for the recording
  /// Once a second of record: the displacements (places, instants, at most 256) m of a short piece, `step` s
  /// apart.
  std::function<void(std::int64_t first, double step, const Eigen::MatrixXd &)> motion;
  std::function<void(const std::string &kind, const std::string &text)> reported;  ///< notes, losses, refusals
  /// The model of a proposal; nothing: there is none with this number.
  std::function<std::optional<TwinModel>(std::int64_t proposal)> adopt;
  std::function<void(const PageCommand &)> others;  ///< commands that are not about the model
  std::function<double()> now;  ///< s since 1970 UTC, for sources that do not say when they began
};

/// Steps the twin with what sources send and keeps their account.  One thread.  theory.md 48
class Engine {
public:
  /// @throws InputError, SolverError  a model that cannot be stepped
  Engine(TwinModel model, EngineHooks hooks);

  void take(Message message);
  /// Steps through the rows that wait; blocks are joined to 20 ms while more of them follow at once.
  void flush();
  /// Between two blocks.  Keys of sliders only: slider_keys().
  void apply(const PageCommand &command);

  const AccountBook *book() const  ///< nullptr before the first head
  {
    return book_ ? &*book_ : nullptr;
  }
  const std::optional<LiveSource> &source() const
  {
    return source_;
  }
  bool start_known() const  ///< the source has said when its sample 0 was
  {
    return start_known_;
  }
  const TwinModel &model() const
  {
    return model_;
  }
  const Tuning &tuning() const
  {
    return tuning_;
  }
  std::int64_t refused_lines() const
  {
    return refused_lines_;
  }
  bool ended() const
  {
    return ended_;
  }
  bool settling() const;

  /// Modal motion, numbers, parameters, account, adopted springs, to go on from.  Rows that wait are stepped
  /// first.
  nlohmann::json state();
  /// Before the first message.  Of a state that is not whole nothing is taken.
  /// @return what was taken over, or why nothing was, sentences
  std::string resume(const nlohmann::json &state);
  std::int64_t resumed_at() const  ///< s of the next sample after resume(); 0: none
  {
    return resumed_at_;
  }
  const std::optional<SourceFile> &file() const  ///< of the last samples, in our numbers; nothing: not known
  {
    return file_;
  }

private:
  static constexpr Eigen::Index most_bridged = 2;  // samples of force, as where records are cleaned
  static constexpr double mean_over          = 1;  // s, of the force
  struct Stored;
  Stored read_state(const nlohmann::json &state) const;
  void take_stored(Stored stored);
  void take_head(const SourceHead &head);
  void take_block(const SourceBlock &block);
  Eigen::Index samples_before(std::int64_t first, const AccountBook::Part &part) const;
  void begin_source(const SourceHead &head);
  bool continues(const SourceHead &head, std::int64_t &offset) const;
  bool is_numbered() const;
  void number_from(std::int64_t first);
  void tell_repetition(const SourceBlock &block);
  void drop_impossible(std::int64_t first, Eigen::MatrixXd &rows);
  void lose();
  void emit(std::int64_t first, const Eigen::MatrixXd &rows, const Eigen::VectorXd &force);
  void emit_without_force(std::int64_t first, const Eigen::MatrixXd &rows);
  void emit_part(std::int64_t first, const Eigen::Ref<const Eigen::MatrixXd> &rows,
                 const Eigen::Ref<const Eigen::VectorXd> &force, bool after_gap);
  void watch_motion(std::int64_t number);
  void change_model();
  void say(const std::string &kind, const std::string &text) const;

  TwinModel model_;
  Tuning tuning_;
  EngineHooks hooks_;
  SteppedStand stand_;
  std::vector<std::string> places_;
  std::unique_ptr<TwinStepper> stepper_;
  bool stepping_ = false;  // the last sample of force is known

  std::optional<LiveSource> source_;
  bool start_known_ = false;
  std::optional<SourceFile> file_;
  std::optional<AccountBook> book_;
  Eigen::Index force_column_ = -1;  // -1: the source has no force
  std::int64_t offset_       = 0;   // of the source's numbers to ours
  bool may_restart_          = false;
  std::vector<Eigen::MatrixXd> waiting_;  // rows not yet stepped
  Eigen::Index n_waiting_     = 0;
  std::int64_t first_waiting_ = 0;
  double mean_ = 0, forget_ = 0;  // N, running mean of the force; its share per sample
  std::int64_t settled_at_ = 0, refused_lines_ = 0, resumed_at_ = 0, stepped_ = 0;
  std::int64_t repeated_ = 0;          // samples in a row that had come before
  std::set<Eigen::Index> impossible_;  // channels of the source whose impossible values were reported
  bool ended_ = false;
  Eigen::MatrixXd motion_;  // (places, instants) that are being collected
  Eigen::Index instants_    = 0;
  std::int64_t motion_from_ = 0, motion_due_ = 0;
};
}  // namespace mill::live
