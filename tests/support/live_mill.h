#pragma once
#include "twin/live/page/event_text.h"
#include "twin/live/page/page_command.h"
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// A mill for the tests of the live page: six masses under a made force, once as the twin and once, a little
/// softer and with noise, as what sensors at the work rolls would show.  The force repeats itself every second and
/// has the same amplitude at every whole frequency from 5 to 1000 Hz, so that a spectrum over one second is the
/// frequency response itself, without scatter.
class LiveMill {
public:
  static constexpr double rate = 20000;  // Hz
  using Tell                   = std::function<void(const std::string &event, const std::string &json)>;

  explicit LiveMill(double damping = 0.01);

  mill::live::PageStand stand() const;
  /// Steps both models.
  void advance(double seconds);
  /// Tells what falls due: numbers at each call, the other events at their rates.
  void tell(const Tell &to);
  /// Everything at once, whatever is due.
  void tell_all(const Tell &to);
  /// Does what a browser asks.
  void take(const mill::live::PageCommand &command);

  /// Hz, modes of the twin as it now stands.
  Eigen::VectorXd frequencies() const;
  /// Displacements (m) that the next numbers carry instead of the twin's own; empty: its own.
  std::vector<double> held;
  /// Bands that the next events of chatter carry instead of its own; empty: its own.
  std::vector<mill::live::ChatterBand> held_bands;

private:
  struct Model {
    Eigen::MatrixXd step;          // (14, 14) of [w0 y; y'; F; F1 - F0] over one sample
    Eigen::MatrixXd acceleration;  // (6, 13) of [w0 y; y'; F]
    Eigen::VectorXd state;         // (12)
  };
  void build(Model &model, const Eigen::VectorXd &K) const;
  Eigen::VectorXd stiffness() const;
  std::vector<float> spectrum_of(const std::vector<std::vector<double>> &history, std::size_t place) const;
  void tell_numbers(const Tell &to);
  void tell_motion(const Tell &to);
  void tell_levels(const Tell &to);
  void tell_spectrum(const Tell &to);
  void tell_account(const Tell &to);
  void tell_modes(const Tell &to);
  void tell_chatter(const Tell &to);
  void tell_parameters(const Tell &to);

  double damping_;
  Eigen::VectorXd M_, K_;
  std::array<double, 8> factor_;  // K1..K7, damping
  Model twin_, mill_;
  std::vector<double> force_;  // one second
  std::int64_t s_ = 0, sent_ = 0;
  double begin_;                                           // s since 1970
  std::vector<std::vector<double>> simulated_, measured_;  // last second, by place
  std::vector<std::vector<float>> slow_;
  std::uint64_t noise_ = 1;
  std::size_t place_   = 2;
  int turn_            = 0;
  bool changed_        = true;
};
