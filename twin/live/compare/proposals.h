#pragma once
#include "core/model/lumped_model.h"
#include "twin/drift/recalibration.h"
#include "twin/live/page/event_text.h"
#include "twin/live/page/proposal_state.h"
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mill {
struct Case;
}

namespace mill::live {
/// An alarm is known by this cause: the modes have moved and nothing can be proposed.
constexpr const char *recalibration_cause = "re-calibration";

/// A re-calibration that a user may adopt.  The twin changes only then.
struct Proposal {
  std::int64_t id = 0;
  double utc      = 0;      ///< s since 1970, when it was made
  double from = 0, to = 0;  ///< s since 1970, of the data behind it
  std::string reason;       ///< which mode moved, since when
  twin::Recalibration recalibration;
  LumpedModel before, chain;               ///< the twin's, and the same with the identified values replaced
  double damping_before = 0, damping = 0;  ///< -, modal damping ratio
  ProposalState state = ProposalState::open;
  std::string file;  ///< where it was written
};

/// Chain with the identified springs of a re-calibration.
LumpedModel recalibrated(LumpedModel chain, const twin::Recalibration &recalibration, double load);
/// Damping ratio with the identified factor.
double recalibrated(double damping, const twin::Recalibration &recalibration);

/// Lines of comment for the case of a proposal: of what, from which data, which springs.
std::string recalibration_comment(const Proposal &proposal);

/// The case with another damping ratio, since a model is written with the dynamics of the case.  A chatter case
/// has dampers between single masses, of which a record identifies the modes alone: its chain is a case of its
/// own.
Case with_damping(Case origin, double damping);

/// A case of kind lumped: the chain of a proposal with passes and dynamics of the case it came from, and comments
/// that say of what.  A case of kind chatter takes it as its stand.from.
/// @param directory  of the file, for the paths of passes
std::string calibrated_case(const Proposal &proposal, const Case &origin, const std::string &directory);

/// The proposals of a run.
class Proposals {
public:
  /// Older ones that are open become out of date.
  const Proposal &add(Proposal proposal);
  /// Open ones become out of date: they are of another twin.
  void twin_changed();
  const Proposal *find(std::int64_t id) const;
  const std::vector<Proposal> &all() const;
  /// Of an earlier program: shown again without changes; their numbers are not used twice.
  void resume(std::vector<Proposal> stored);

  /// Writes FOLDER/calibrated-<time>.toml, aside and renamed, and a line of FOLDER/adopted.log.
  /// @param text  of the file
  /// @returns the proposal, adopted; nothing where no proposal of this number is open
  /// @throws InputError, SystemError  it cannot be written; the proposal stays open
  std::optional<Proposal>
  adopt(std::int64_t id, double utc, const std::string &folder,
        const std::function<std::string(const Proposal &, const std::string &folder)> &text);

  /// Changes since the last call, for the page.
  std::vector<PageProposal> news();

private:
  Proposal *known(std::int64_t id);

  std::vector<Proposal> list;  // by rising number
  std::vector<std::size_t> changed;
};
PageProposal page_proposal(const Proposal &proposal);
}  // namespace mill::live
