#pragma once
#include "core/base/each_member.h"
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

// What one stage hands to the next: plain structs, SI.  Files of these are written by app/ (curves/*.csv) and read
// by report/.
namespace mill {
/// Load-approach curve of one contact, n samples in increasing load.
struct ContactCurve {
  std::string name;               ///< "upper", "lower", "line"
  std::string reference;          ///< datum of the approach, one sentence
  Eigen::VectorXd load;           ///< (n) N, total over the contact length
  Eigen::VectorXd approach;       ///< (n) m, distance the two roll axes come together, mean over the barrel
  Eigen::VectorXd half_width;     ///< (n) m, at mid-length
  Eigen::VectorXd peak_pressure;  ///< (n) Pa, at mid-length
  Eigen::VectorXd tangent;        ///< (n) N/m, dF/d(approach), exact for the active set
  Eigen::VectorXd secant;         ///< (n) N/m, F/approach
  Eigen::VectorXi iterations;     ///< (n) active-set iterations
  double residual = 0;            ///< -, largest relative complementarity residual of the sweep
};

template <class Io, class R, if_record<R, ContactCurve> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, reference, load, approach, half_width, peak_pressure, tangent, secant, iterations, residual] =
      record;
  io("name", name);
  io("reference", reference);
  io("load", load);
  io("approach", approach);
  io("half_width", half_width);
  io("peak_pressure", peak_pressure);
  io("tangent", tangent);
  io("secant", secant);
  io("iterations", iterations);
  io("residual", residual);
}

/// Distribution along the barrel at one load, m stations from mid-length to the barrel end.
struct BarrelProfile {
  double load = 0;                ///< N
  Eigen::VectorXd z;              ///< (m) m, from mid-length
  Eigen::VectorXd line_load;      ///< (m) N/m
  Eigen::VectorXd approach;       ///< (m) m, axis to axis at this section
  Eigen::VectorXd tangent;        ///< (m) N/m2, d(line load)/d(local approach)
  Eigen::VectorXd half_width;     ///< (m) m
  Eigen::VectorXd peak_pressure;  ///< (m) Pa
};

template <class Io, class R, if_record<R, BarrelProfile> = 0> void each_member(Io &&io, R &record)
{
  auto &[load, z, line_load, approach, tangent, half_width, peak_pressure] = record;
  io("load", load);
  io("z", z);
  io("line_load", line_load);
  io("approach", approach);
  io("tangent", tangent);
  io("half_width", half_width);
  io("peak_pressure", peak_pressure);
}

/// Force record of a pass.
struct ForceRecord {
  Eigen::VectorXd time;              ///< (n) s, increasing
  Eigen::VectorXd force;             ///< (n) N
  std::vector<std::string> notes;    ///< what was repaired on reading, one sentence each, for the report
  std::optional<double> start = {};  ///< s since 1970-01-01 UTC of time 0; none: the record has no date
};

/// Measured accelerations for comparison with a response.
struct MeasuredRecord {
  Eigen::VectorXd time;             ///< (n) s, increasing
  Eigen::VectorXd upper_work_roll;  ///< (n) m/s2
  Eigen::VectorXd lower_work_roll;  ///< (n) m/s2
  std::optional<double> start;      ///< s since 1970-01-01 UTC of time 0; none: the record has no date
  std::vector<std::string> notes;
};
}  // namespace mill
