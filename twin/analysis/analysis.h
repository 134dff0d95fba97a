#pragma once
#include "core/base/note.h"
#include "core/process/progress.h"
#include "twin/analysis/baseline.h"
#include "twin/bearings/fault_lines.h"
#include "twin/cleaning/clean_record.h"
#include "twin/detection/spectral_peaks.h"
#include "twin/modes/force_delay.h"
#include "twin/modes/subspace.h"
#include "twin/onset/growth.h"
#include "twin/spectra/marks.h"
#include "twin/spectra/peaks.h"
#include "twin/spectra/speed.h"
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mill::twin {
/// What a case says about the stand whose record is analysed.
struct CaseModel {
  std::string name;                      ///< of the case
  std::string source;                    ///< "six masses as given", "six masses by closed forms at 976.2 kN"
  std::vector<std::string> places;       ///< (m) "upper_work_roll"
  std::vector<std::string> springs;      ///< (s) "K3"
  Eigen::VectorXd spring_error;          ///< (s) -, relative standard deviation of each; NaN: not stated
  Eigen::VectorXd frequency_error;       ///< (k) -, relative, as a run states it; empty, NaN: from the springs
  Eigen::VectorXd frequency;             ///< (k) Hz
  Eigen::MatrixXd shape;                 ///< (m, k) displacement of each place
  Eigen::MatrixXd strain_share;          ///< (k, s) -
  Eigen::MatrixXd kinetic_share;         ///< (k, b) -
  std::vector<std::string> bodies = {};  ///< (b) of kinetic_share; empty: the places
  std::vector<TurningRoll> rolls;
  std::vector<TurningBearing> bearings;
  std::vector<Note> notes;  ///< what the case does not say and is therefore not computed
};

/// A band that has a name in the mill.
struct ChatterBand {
  std::string name;  ///< "third_octave"
  double low, high;  ///< Hz
};

struct AnalysisSettings {
  std::optional<double> speed;   ///< m/s, of a record without a channel of it
  std::optional<double> limit;   ///< m/s2, 0-peak: the mill's own limit of chatter
  std::vector<double> severity;  ///< m/s, rms: upper ends of zones A, B, C; empty: none given
  std::vector<ChatterBand> bands{{"third_octave", 125, 240}, {"fifth_octave", 550, 650}};
  std::optional<Baseline> baseline;  ///< an earlier analysis of the same mill
  std::optional<double> mains;       ///< Hz, of the plant; neither: 50 and 60 Hz are tried
  bool align  = false;               ///< takes the delay out of the response to the force
  int threads = 1;
};

/// One line of a family.
struct FamilyMember {
  int order;         ///< multiple of the fundamental; 0: a side band or a line of a comb
  double frequency;  ///< Hz
  double amplitude;  ///< 0-peak, in the unit of the finding
};

/// Something the record shows.
struct Finding {
  FindingKind kind;
  std::string channel;  ///< where it is largest
  double frequency;     ///< Hz; NaN: none
  double low, high;     ///< Hz, 95 % interval of the frequency
  double amplitude;     ///< 0-peak, in `unit`; NaN: none
  std::string unit;
  std::string owner;                       ///< one sentence: the source, or why it is not identified
  std::vector<std::string> evidence;       ///< one sentence each
  std::vector<FamilyMember> members = {};  ///< lines of a family or of a comb, ascending; empty: one frequency
};

/// What became of one candidate; each has exactly one.
struct CandidateFate {
  std::string channel;
  double frequency;  ///< Hz
  double amplitude;  ///< 0-peak, in `unit`; NaN: none
  std::string unit;
  double over_floor;  ///< dB; NaN: none
  FindingKind fate;
  std::string reason;  ///< one sentence
};

/// Shares of the variance of a cleaned channel; their sum is 1.  theory.md (41.29)
struct Account {
  double lines = 0, families = 0, modes = 0, floor = 0;           ///< -
  double unexplained = 1;                                         ///< -
  double largest     = std::numeric_limits<double>::quiet_NaN();  ///< Hz, of the largest peak; NaN: none
  double amplitude   = 0;                                         ///< 0-peak, in the unit of the channel
  double over_floor  = 0;                                         ///< dB
  std::string source;                                             ///< of the largest peak
  bool only_noise() const;  ///< the floor holds 95 % and no candidate is above the threshold
};

/// What one family of faults of one bearing reaches in one channel.
struct BearingScore {
  std::string channel, bearing, roll, family;
  double frequency, slip, score, speed;    ///< Hz by the geometry, -, - (third best harmonic), m/s
  double low = 0, high = 0, kurtosis = 0;  ///< Hz, Hz, -, band whose envelope was taken
};

/// One channel.
struct ChannelAnalysis {
  std::string name, unit;
  Quantity quantity;
  double rms, peak, crest;       ///< in `unit`, `unit`, -; offset and drift taken off
  double variance;               ///< in `unit` squared, about the mean
  double lowest;                 ///< Hz, below it no lines are looked for
  double velocity_rms;           ///< m/s, in velocity_band(); NaN: no vibration
  double bandwidth;              ///< Hz, nothing above it is used
  std::vector<double> band_rms;  ///< in `unit`, in each band of the settings; NaN: the record does not hold it
  WelchSpectrum spectrum;        ///< fine, for lines
  WelchSpectrum length;          ///< over the rolled length, 1/m; n = 0: no speed
  Waterfall map;                 ///< over time
  SpectralPeaks detected;        ///< lines and resonances with the floor under them
  Account account;               ///< of the variance
};

struct Analysis {
  std::vector<ChannelAnalysis> channels;
  ModeSearch modes;                        ///< from the response alone
  ForcedModes forced;                      ///< from the response to the recorded force
  ForceDelay delay;                        ///< of the vibrations behind that force
  std::vector<double> force_edges;         ///< Hz, where the density of a recorded force changes by 10 dB
  std::vector<std::string> mode_channels;  ///< rows of the shapes
  std::vector<BearingScore> bearings;      ///< of all families, indicated or not
  std::vector<Finding> findings;
  std::vector<CandidateFate> candidates;                            ///< of all channels
  std::vector<Note> notes;                                          ///< what could not be said, and why
  double lowest_speed  = std::numeric_limits<double>::quiet_NaN();  ///< m/s; NaN: not recorded
  double highest_speed = std::numeric_limits<double>::quiet_NaN();  ///< m/s; NaN: not recorded
};

/// Everything of chapter 41 and 42 for one cleaned record.
/// @param stand  nullptr: no case was named, owners are then mains and orders at most
/// Cost: about 4 s per channel of 10 minutes at 20 kHz.
Analysis analyse(const CleanRecord &record, const CaseModel *stand, const AnalysisSettings &settings,
                 const Progress &progress);
}  // namespace mill::twin
