#pragma once
#include "core/model/lumped_model.h"
#include "dynamics/response/mill_model.h"
#include "twin/calibration/fit.h"
#include <cstdint>
#include <map>
#include <string>
#include <vector>

// Records of the calibration entries of reference/twin.json: set R times exp(truth), force in a band, noise of the
// sensors; the check record has seed + 500 and 1.4 times the force.
namespace calibration {
/// Set R: what the case says.
mill::LumpedModel set_r();
mill::dynamics::MillModel chain_of(const mill::LumpedModel &model, mill::FrameForm frame = mill::FrameForm::open);
mill::twin::FittedStand stand_r();
/// K1, K2, K3, K5, K6, K7, zeta with the priors of the entries.
std::vector<mill::twin::Unknown> unknowns_r();

struct Recipe {
  std::map<std::string, double> truth;  ///< ln of factors on set R: "K3", "M2", "zeta", "zeta2"
  std::uint64_t seed;
  Eigen::Index n;
  double rate, force_rms, highest;   ///< Hz, N, Hz
  double density;                    ///< m/s2 / sqrt(Hz), of each sensor
  std::vector<Eigen::Index> places;  ///< masses, from 0
  mill::FrameForm frame = mill::FrameForm::open;
  double mean_force;
  Recipe check() const;
};
/// Entry calibrate.`name`.inputs; of "closed" the truth has the closed frame.
Recipe recipe(const std::string &name);

struct Record {
  Eigen::VectorXd force;         ///< N, its mean included
  Eigen::MatrixXd acceleration;  ///< (n, m) m/s2
};
Record record(const Recipe &recipe);

mill::twin::MeasuredResponse measured(const Recipe &recipe, double low = 20, double high = 900);
}  // namespace calibration
