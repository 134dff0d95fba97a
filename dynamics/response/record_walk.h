#pragma once
#include "dynamics/response/time_walk.h"
#include <utility>

namespace mill::dynamics {
/// Properties of a whole record that are needed before it is walked sample by sample; found in one pass over it.
class RecordSurvey {
public:
  void add(double time, double force);
  /// Are all samples evenly spaced, as common_grid() asks?
  bool is_even() const;
  double spacing() const;  ///< s, mean
  double mean() const;     ///< N

  long long n  = 0;
  double first = 0, last = 0;                         ///< s
  double first_force = 0, smallest = 0, largest = 0;  ///< N

private:
  double sum_ = 0, carry_ = 0;          // of the force less the first one, which has up to 1e9 terms
  double least_ = 0, most_ = INFINITY;  // s, between which a spacing fits all samples so far
};

/// walk() of time_walk.h, fed sample by sample.
class RecordWalk {
public:
  RecordWalk(const RecordSurvey &survey, double output_rate);
  const OutputGrid &grid() const
  {
    return grid_;
  }

  /// The next sample; calls visit(const Step &) for every stretch that ends with it.
  template <class Visit> void add(const double time, const double force, Visit visit)
  {
    if (sample_++ == 0) {
      now_ = time_ = time;
      F0_ = force_ = force;
      return;
    }
    if (common_.fine > 0)
      add_even(force, visit);
    else
      add_any(time, force, visit);
    time_  = time;
    force_ = force;
  }

private:
  template <class Visit> void add_even(const double force, Visit &visit)
  {
    for (Eigen::Index part = 1; part <= common_.per_sample && step_ < (grid_.n - 1) * common_.per_output; ++part) {
      const double F1 = part == common_.per_sample
                            ? force
                            : force_ + (force - force_) * (double(part) / double(common_.per_sample));
      ++step_;
      visit(Step{common_.fine, F0_, F1, step_ % common_.per_output == 0 ? step_ / common_.per_output : 0});
      F0_ = F1;
    }
  }

  template <class Visit> void add_any(const double time, const double force, Visit &visit)
  {
    const double same  = 1e-9 * grid_.step;
    const bool is_last = sample_ == n_;
    for (; output_ < grid_.n; ++output_) {
      const double end = grid_.begin + double(output_) * grid_.step;
      if (!is_last && time < end - same)
        break;
      const double F1 = force_ + (force - force_) * ((end - time_) / (time - time_));
      visit(Step{end - now_, F0_, F1, output_});
      now_ = end;
      F0_  = F1;
    }
    if (output_ == grid_.n)
      return;
    if (time - now_ > 0)
      visit(Step{time - now_, F0_, force, 0});
    now_ = time;
    F0_  = force;
  }

  OutputGrid grid_;
  CommonGrid common_;
  long long n_, sample_ = 0;
  Eigen::Index step_ = 0, output_ = 1;
  double now_ = 0, F0_ = 0, time_ = 0, force_ = 0;
};
}  // namespace mill::dynamics
