#pragma once
#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <memory>
#include <vector>

// Measured and simulated vibration of a place side by side, second by second.  theory.md 50.1 to 50.3
namespace mill::twin {
/// Level of one second, its mean taken off.
struct Level {
  double rms = 0, peak = 0;  ///< in the unit of the channel; peak from the mean
  double crest  = 0;         ///< -, peak/rms
  double offset = 0;         ///< the mean
};

/// How far the measured runs behind the simulated, by their cross-correlation within +-50 ms.  (50.2), (50.3)
struct Delay {
  double value;        ///< s, positive: the measured is late; NaN: nothing to correlate
  double sd;           ///< s, standard deviation by the coherence of the last 10 s; NaN: not known yet
  double correlation;  ///< -, of the two signals at this delay; negative: one of them is upside down
  double rival;        ///< -, next highest maximum over the highest: near 1 the delay may be off by one period
};

/// Share of the measured energy of a third octave that no linear relation to the simulated explains.  (50.4)
struct IncoherentShare {
  double centre;     ///< Hz
  double low, high;  ///< Hz
  double share;      ///< -, unbiased; of a pure model 0, of unrelated signals 1; NaN: less than 4 s of data
  double energy;     ///< -, of the measured energy, which part lies in this band
};

/// One place over one second.
struct PlaceSecond {
  Eigen::Index place;
  Level measured, simulated;
  double ratio;  ///< dB, measured over simulated rms
  Delay delay;
  std::vector<IncoherentShare> bands;  ///< over the last 10 s
  double missing;                      ///< -, of the measured samples of this second
};

/// Densities for the eye: mean over about a second, at most 1024 bins from 0 on.
struct SpectrumPair {
  Eigen::Index place;
  double resolution;                    ///< Hz, from bin to bin
  Eigen::VectorXf measured, simulated;  ///< unit^2/Hz
};

/// Levels, delay and incoherent shares while the samples come.
class RunningComparison {
public:
  /// @param rate  Hz, @param places  pairs of signals
  RunningComparison(double rate, Eigen::Index places);
  ~RunningComparison();
  RunningComparison(RunningComparison &&) noexcept;

  /// What a block completed.
  struct News {
    std::vector<double> time;                       ///< (s) s from sample 0, end of each second
    std::vector<std::vector<PlaceSecond>> seconds;  ///< (s) one row per place of which half the second is there
    std::vector<SpectrumPair> spectra;              ///< 4 times a second, of every place; the latest only
    double spectra_time = 0;                        ///< s
  };
  /// @param first      number of the first sample; if it does not follow the last one, all sums start again
  /// @param measured   (n, places) NaN: missing
  /// @param simulated  (n, places)
  /// Cost at 20 kHz: 1 ms per second and place.
  News take(std::int64_t first, const Eigen::MatrixXd &measured, const Eigen::MatrixXd &simulated);
  void restart();

  Eigen::Index segment() const;  ///< samples of a Hann segment, 0.4 to 0.8 s

private:
  struct State;
  std::unique_ptr<State> state;
};
}  // namespace mill::twin
