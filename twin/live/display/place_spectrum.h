#pragma once
#include "twin/live/engine/engine.h"
#include "twin/live/live_block.h"
#include "twin/live/page/event_text.h"
#include "twin/spectra/fourier.h"
#include <complex>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace mill::live {
/// Spectrum and wave of the place that the page shows, measured (where it is) and simulated, four times a second.
/// Amplitude density of the last six seconds in pieces of some 0.8 s under a Hann window, the mean of each taken
/// off; a piece begins a quarter of a second after the one before.  After a change of the twin the average begins
/// again, and a piece that still holds earlier samples is shown but not averaged.
/// Cost: one transform of 2^14 points (at 20 kHz) a piece for both signals together.  theory.md (41.4)
class PlaceSpectrum {
public:
  void begin(const LiveSource &source);
  /// Another place; an unknown name changes nothing.
  void choose(const std::string &place);
  const std::string &place() const;  ///< empty before a source has begun
  void twin_changed();
  /// @param now  s, steady: of a record that is played fast not every quarter second is shown
  std::optional<PageSpectrum> take(const LiveBlock &block, double now);

private:
  struct Place {
    std::string name;
    Eigen::Index channel = -1;                // column of the measured, -1: none
    std::vector<double> measured, simulated;  // (L) rings
  };
  void start_again();
  void put(const LiveBlock &block);
  void add_piece(const Place &place);
  PageSpectrum text_of(const Place &place) const;

  double rate_ = 0, start_time_ = 0;
  std::size_t length_ = 0, points_ = 0;  // samples of a piece; points that are sent
  std::vector<Place> places_;
  std::size_t chosen_ = 0;
  std::string wanted_;
  std::int64_t end_ = 0, filled_ = 0, since_ = 0;  // sample after the last; samples in the rings; since a piece
  std::int64_t changed_at_ = 0;                    // sample from which on the twin is as it now is
  double sent_             = -1;                   // s, steady
  std::vector<double> window_;
  twin::Fourier fourier_;
  struct Piece {
    bool whole = true;                        // of one twin
    std::vector<double> measured, simulated;  // (points) unit^2/Hz; measured empty where samples are missing
  };
  std::deque<Piece> pieces_;
};
}  // namespace mill::live
