#pragma once
#include "report/modes/model_data.h"
#include "report/page/run.h"
#include <string>
#include <vector>

// What the comparison of the models consists of.  Every function takes what is stored and leaves out the rest;
// empty when nothing is there to show.
namespace mill::report {
/// Shapes that are more alike than this count as one mode.
constexpr double alike = 0.5;

/// Highest frequency that the force of a pass holds.
struct ForceReach {
  std::string pass;
  double frequency;  ///< Hz, 99 % of the force's mean square lie below
};
std::vector<ForceReach> force_reach(const Run &run);

/// Worst error of the modes below the limit over the number of masses, one row for each number.
std::string masses_chart(const ModelData &data);

/// Frequencies of every model in a column of their own, partners joined.
std::string frequency_ladder(const ModelData &data, const std::vector<ForceReach> &reach);

/// How alike the shapes of two detailed models are, frequencies on both axes.
std::string mac_map(const ModelData &data);

/// Error of the frequencies over the number of modes kept.
std::string kept_chart(const KeptModes &kept, double limit);

// Tables, HTML.
std::string model_table(const ModelData &data);
/// Every mode of the detailed model below the limit, and what the six masses make of it.
std::string verdict_table(const ModelData &data);
/// Modes of the six masses without a counterpart in the detailed model.
std::string stray_sentence(const ModelData &data);

/// Mode (from 1) of the table's columns that looks most like mode `row` (from 1) of its rows; 0: none is alike.
int mac_partner(const MacTable &mac, int row);
}  // namespace mill::report
