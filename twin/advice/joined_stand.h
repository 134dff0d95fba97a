#pragma once
#include "dynamics/chatter/stand_structure.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modal_model.h"
#include "dynamics/response/modes.h"
#include "twin/advice/force_band.h"
#include <Eigen/Core>
#include <string>
#include <vector>

// A stand in its modes with dampers and tuned dampers joined to its places.  theory.md 46.2
namespace mill::twin {
/// A stand in n modes, seen at m places; every mode has a damping ratio of its own.
struct VibratingStand {
  std::vector<std::string> places;  ///< (m) "upper work roll"
  Eigen::MatrixXd point;            ///< (m, n) kg^-1/2, displacement of each place in each mass-normalised mode
  Eigen::VectorXd frequency;        ///< (n) rad/s, undamped
  Eigen::VectorXd damping;          ///< (n) -, ratio of critical
  Eigen::VectorXd force;            ///< (n) kg^-1/2, bite force on each mode
  double gap_damper = 0;            ///< N s/m, between the work rolls over the width of the strip
  /// Index of a place, blanks and underscores alike; -1: no place has this name.
  int place(const std::string &name) const;
};

/// All modes of a chain.
/// @param damping     (n) -, ratios of critical; the damping matrix of the model is not read
/// @param gap_damper  N s/m
VibratingStand vibrating_stand(const dynamics::MillModel &model, const Eigen::VectorXd &damping,
                               double gap_damper = 0);
VibratingStand vibrating_stand(const dynamics::ModalModel &model);

/// What is joined to a stand: a damper between two places, or a mass on spring and damper at one (a tuned damper).
struct Attachment {
  int from         = -1;  ///< place; -1: the ground
  int to           = -1;  ///< place
  double damper    = 0;   ///< N s/m, between `from` and `to`; unused where there is a mass
  double mass      = 0;   ///< kg, of a tuned damper at `to`; 0: a damper
  double frequency = 0;   ///< Hz, of the mass on its spring alone
  double ratio     = 0;   ///< -, damping of the mass on its spring, ratio of critical
};

/// N/m: force per displacement of what is joined, at w in rad/s.  theory.md (46.4)
std::complex<double> dynamic_stiffness(const Attachment &attachment, double w);

/// Rms acceleration of every place in a band of the force.  (m) m/s2  theory.md (46.2), (46.3)
/// Exact for any number of attachments.  Cost: k (m + r)(r + 1) n for k frequencies and r attachments: 20 ms for
/// 50 000 frequencies, six masses and two attachments.
Eigen::VectorXd levels(const VibratingStand &stand, const std::vector<Attachment> &joined, const ForceBand &force);

/// (k) m/s2 per N: amplitude of the acceleration of a place at the frequencies of a force.
Eigen::VectorXd amplitude(const VibratingStand &stand, const std::vector<Attachment> &joined, int place,
                          const Eigen::VectorXd &frequency);

/// (k, m + 1) m/N: displacement of every place, and last of the gap, per newton of bite force.
Eigen::MatrixXcd bite_receptances(const VibratingStand &stand, const std::vector<Attachment> &joined,
                                  const Eigen::VectorXd &frequency);

/// The stand with what is joined as the bite feels it: modes, and one more unknown for each tuned damper, (46.5).
dynamics::StandStructure joined_structure(const VibratingStand &stand, const std::vector<Attachment> &joined);

/// d ln level of every place when `added` is joined to the stand with `joined`, to first order in its damper or
/// its mass: (m) -, negative where it helps.  theory.md (46.6)
Eigen::VectorXd first_order(const VibratingStand &stand, const std::vector<Attachment> &joined,
                            const std::vector<Attachment> &added, const ForceBand &force);

/// Poles of the stand with what is joined, by rising frequency; a tuned damper adds one.  theory.md (46.5)
std::vector<dynamics::Pole> poles(const VibratingStand &stand, const std::vector<Attachment> &joined);

/// Level of one place over the numbers of one tuned damper, all else held: what a search for its tuning calls.
class TunedLevel {
public:
  /// @param at  place of the tuned damper
  TunedLevel(const VibratingStand &stand, const std::vector<Attachment> &joined, int seen, int place,
             const ForceBand &force);
  /// m/s2.  @param tuned  only mass, frequency and ratio are read
  double operator()(const Attachment &tuned) const;

private:
  Eigen::VectorXd w_, square_;             // rad/s, N2
  Eigen::VectorXcd to_place_, to_damper_;  // m/N, of the bite force
  Eigen::VectorXcd crossed_, own_;         // m/N, of a force at the damper on the place and on itself
};
}  // namespace mill::twin
