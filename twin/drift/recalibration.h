#pragma once
#include "twin/calibration/fit.h"
#include "twin/drift/mode_watch.h"
#include <string>
#include <vector>

// A new calibration on the blocks after a change: what is proposed.  theory.md 50.7
namespace mill::twin {
/// Blocks since the change, and what the twin was.
struct DriftRecord {
  double rate = 0;                   ///< Hz, of the samples behind the blocks' transforms
  std::vector<BlockSpectra> blocks;  ///< all with the same sensors
  std::vector<Eigen::Index> places;  ///< (sensors) mass of each
  std::vector<ModeFit> modes;        ///< of the last block, in the order of the stand's modes
};

struct RecalibrationSettings {
  double wider = 3;    ///< -, prior: the last posterior's standard deviation times this,
  double least = 0.1;  ///< -, and at least this: how well a value was known says little of how far it moved
  double low   = 5;    ///< Hz, below it the lines are not used
  double identified_below = 0.5;  ///< -, shrink up to which a parameter is identified
  int renewals            = 2;
};

struct RecalibratedValue {
  std::string name;         ///< "K3", "zeta"
  double prior_sd = 0;      ///< -, of ln of the factor, already widened
  double change   = 0;      ///< -, ln of the factor on what the twin had
  double sd       = 0;      ///< -, of it
  bool identified = false;  ///< otherwise the twin's value is kept
};

struct Recalibration {
  std::vector<RecalibratedValue> values;
  double seconds       = 0;                    ///< s of record behind it
  double misfit_before = 0, misfit_after = 0;  ///< -, mean of |r|^2 over the noise left in the end
  double load = 0;                             ///< N
  std::string refused;                         ///< why nothing is proposed; empty: it is
};

/// Start from the frequencies of the modes through the strain shares, then the likelihood of theory.md 44 with
/// springs and common damping free, then once more with those alone that are identified.
/// @param stand    the twin at the present load
/// @param unknowns springs and "zeta" with the standard deviations of the last posterior
/// Refused: nothing identified; an estimate beyond 3 prior standard deviations; the misfit does not fall by a
/// tenth. Cost: some seconds for a minute of 4 channels up to 1 kHz.
Recalibration recalibrate(const FittedStand &stand, std::vector<Unknown> unknowns, const DriftRecord &record,
                          const RecalibrationSettings &settings = {});
}  // namespace mill::twin
