#pragma once
#include "core/process/progress.h"
#include "core/records/csv.h"
#include "twin/calibration/adequacy.h"
#include "twin/calibration/basins.h"
#include "twin/calibration/clock_delay.h"
#include "twin/calibration/output_only_adequacy.h"
#include "twin/calibration/plan.h"
#include "twin/calibration/predicted_modes.h"
#include <optional>
#include <string>
#include <vector>

// A calibration from pieces of records to a verdict.  theory.md 44, 45
namespace mill::twin {
struct CalibrationInput {
  FittedStand stand;
  std::vector<Unknown> unknowns;     ///< the delay among them where two clocks are to be aligned
  std::vector<std::string> sensors;  ///< (m) "upper_work_roll"
  std::vector<Eigen::Index> places;  ///< (m) masses, from 0
  double rate = 0;                   ///< Hz
  double low = 20, high = 900;       ///< Hz, band that is fitted
  std::vector<ForcedSamples> fit, check;
  BetweenSamples between = BetweenSamples::smooth;
  std::vector<std::string> clipped;  ///< channels of the records that are clipped; they are not among the sensors
  int threads = 1;
  /// false: pieces have no force; it is eliminated (44.5), and no delay is among the unknowns
  bool force_recorded = true;
  double model_error  = usual_model_error;  ///< -, of the level of a third octave, that the stand may be wrong by
};

/// One unknown after the record.
struct Calibrated {
  std::string name;
  double prior_sd;      ///< of ln of the factor; of the delay s
  double estimate;      ///< joint fit of all
  double sd;            ///< of the joint fit
  double low, high;     ///< 95 % of the joint fit; of a scanned spring by its profile
  double shrink;        ///< sd over prior sd
  bool identified;      ///< shrink <= 0.5 and no second basin below deviance 9
  double kept;          ///< value of the calibrated case, see keep_priors()
  std::string why_not;  ///< empty where it is identified
  double kept_sd = 0;   ///< of `kept` where the rest is at its prior; 0: the same as `sd`
  /// The calibrated case has `kept` in place of the value of the case: it is identified, or the value of the case
  /// contradicts the records.
  bool taken = false;
};

/// Misfit and worst band of a record with the calibrated case.
struct RecordFit {
  double before = 0, after = 0;  ///< mean of |r|^2 over the noise that the fit left
  std::vector<BandResidual> bands;
  double worst = 0;               ///< ratio over its limit, of decisive bands
  std::vector<LevelBand> levels;  ///< of a force that was not recorded; empty where it was
};

/// Density of a force that was not recorded, as the fitted accelerations show it.
struct EstimatedForce {
  Eigen::VectorXd frequency;  ///< (q) Hz, knots between which ln of the density is linear in ln of the frequency
  Eigen::VectorXd density;    ///< (q) N^2/Hz, one-sided
  Eigen::VectorXd sd;         ///< (q) -, of its logarithm
};

struct Calibration {
  std::vector<Calibrated> unknowns;
  ScannedFit scan;
  Identification identification;     ///< of the joint fit
  Eigen::MatrixXd correlation;       ///< (p, p) -, posterior
  std::vector<std::string> unseen;   ///< directions that the records do not show, in words
  double kept_deviance = 0;          ///< what keeping the priors of what is not identified costs
  std::vector<PredictedMode> modes;  ///< of the calibrated case, up to the end of the band
  RecordFit fit, check;
  std::optional<ClockDelay> delay;  ///< of two clocks; nothing: it is among the unknowns
  double case_deviance = 0;         ///< of the case over the joint fit
  bool agrees          = false;     ///< the case explains the records already: nothing is proposed
  /// Unknowns with which every band is within its limit, where one damping ratio for all modes is the only thing
  /// that fails; empty otherwise.
  std::vector<std::string> with_ratios;
  std::vector<std::string> refusals;          ///< why no case is written; empty: none
  Table response;                             ///< check record: |H1| measured, before, after by sensor
  double fit_seconds = 0, check_seconds = 0;  ///< s, of the pieces
  EstimatedForce force;                       ///< where none was recorded; empty where one was
  bool force_recorded() const
  {
    return force.frequency.size() == 0;
  }
};

/// Start, fit, basins, what is identified, and whether the model is right.
/// Cost: 5 s for 20 s of two sensors and seven unknowns on two threads.
Calibration calibrate(const CalibrationInput &input, const Progress &progress);
}  // namespace mill::twin
