#pragma once
#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>

/// Value of one entry of tests/reference/<file>.json: numbers computed outside this program from published
/// equations (the files say which), SI.  Throws when the entry is missing.
nlohmann::json reference(const std::string &entry, const std::string &file = "stand");

/// An entry that is a list of numbers.
Eigen::VectorXd reference_vector(const std::string &entry, const std::string &file = "stand");
