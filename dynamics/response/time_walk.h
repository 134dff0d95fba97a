#pragma once
#include "core/records/records.h"
#include <cmath>
#include <cstdint>

namespace mill::dynamics {
/// Uniform output times begin + k step, k = 0..n-1.
struct OutputGrid {
  double begin;    ///< s
  double step;     ///< s
  Eigen::Index n;  ///< -
};

/// Times written with few digits are even to about a millionth of their spacing; the force read there is that much
/// of one sample's change from the straight line.
constexpr double evenness = 1e-6;

/// Times of the outputs: from the first sample of the force to its last, both included when they fall on the grid.
OutputGrid output_grid(const ForceRecord &force, double output_rate);
OutputGrid output_grid(double first, double last, double output_rate);

/// One stretch of time over which the force is one straight line.
struct Step {
  double length;        ///< s
  double F0, F1;        ///< N, at its two ends
  Eigen::Index output;  ///< number of the output time at its end, 0: none
};

/// Samples and outputs on one fine grid: fine = spacing / per_sample = grid.step / per_output.
struct CommonGrid {
  double fine             = 0;  ///< s, 0: none
  Eigen::Index per_sample = 0;  ///< -, fine steps between two samples
  Eigen::Index per_output = 0;  ///< -, fine steps between two outputs
};

/// Finds the common grid when the samples are evenly spaced and spacing / step is a ratio of small numbers: one
/// that needs at most 16 times as many steps as there are samples and outputs.
CommonGrid common_grid(const ForceRecord &force, const OutputGrid &grid);
/// The same of n_lines + 1 evenly spaced samples.
CommonGrid common_grid(Eigen::Index n_lines, double spacing, const OutputGrid &grid);

/// Calls visit(const Step &) for every stretch in order; all steps of a common grid have exactly one length.
/// theory.md (7.6)
template <class Visit> void walk(const ForceRecord &force, const OutputGrid &grid, Visit visit)
{
  const CommonGrid common = common_grid(force, grid);
  const auto &t           = force.time;
  const auto &F           = force.force;
  if (common.fine > 0) {
    const auto along = [&](const Eigen::Index k) {
      const Eigen::Index i = k / common.per_sample, part = k % common.per_sample;
      return part == 0 ? F[i] : F[i] + (F[i + 1] - F[i]) * (double(part) / double(common.per_sample));
    };
    double F0 = F[0];
    for (Eigen::Index k = 1; k <= (grid.n - 1) * common.per_output; ++k) {
      const double F1 = along(k);
      visit(Step{common.fine, F0, F1, k % common.per_output == 0 ? k / common.per_output : 0});
      F0 = F1;
    }
    return;
  }
  const double same =
      1e-9 * grid.step;  // two times closer than this are one: the force between them moves as little
  Eigen::Index i = 0;    // samples i and i + 1 span the line the walk is on
  double now = grid.begin, F0 = F[0];
  for (Eigen::Index k = 1; k < grid.n; ++k) {
    const double end = grid.begin + double(k) * grid.step;
    for (; i + 1 < t.size() - 1 && t[i + 1] < end - same; ++i) {
      if (t[i + 1] - now > 0)
        visit(Step{t[i + 1] - now, F0, F[i + 1], 0});
      now = t[i + 1];
      F0  = F[i + 1];
    }
    const double F1 = F[i] + (F[i + 1] - F[i]) * ((end - t[i]) / (t[i + 1] - t[i]));
    visit(Step{end - now, F0, F1, k});
    now = end;
    F0  = F1;
  }
}
}  // namespace mill::dynamics
