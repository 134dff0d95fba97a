#pragma once
#include "tests/support/sample_run.h"
#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>

/// Six-mass chain of the sample run.
struct SampleChain {
  Eigen::VectorXd M = Eigen::VectorXd(6);  ///< kg
  Eigen::VectorXd K = Eigen::VectorXd(7);  ///< N/m
  Eigen::VectorXd frequency;               ///< (6) Hz
  Eigen::MatrixXd shapes;                  ///< (6, 6) kg^-1/2, one column per mode
};

/// Name of the case of a sample run.
std::string sample_name(const SampleRun &sample);

/// results.json and run.json of a sample run.
nlohmann::ordered_json sample_results(const SampleRun &sample, const SampleChain &chain);
nlohmann::ordered_json sample_manifest(const SampleRun &sample, const std::string &name);
