#pragma once
#include "tests/support/sample_run.h"
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

/// Curve, shares and roller loads of a bearing as a stand of an earlier version stored them: a power law.
/// @param stiffness  N/m, secant at 100 kN
/// @param tilt       -, by how much the share grows from row to row
void write_plain_bearing(const std::filesystem::path &run, const std::string &name, double stiffness, int rollers,
                         double tilt);

/// Every file of a run of kind "bearing": other models beside the curve, M-shaped roller loads, laws of one
/// roller, tilt, pressure maps, cage, published values, motion with its spectrum.  Names it "trb".
void write_whole_bearing(const std::filesystem::path &run, const SampleRun &sample);

/// The values of results.json and the bearings of run.json that go with it.
nlohmann::ordered_json sample_bearing_results();
nlohmann::ordered_json sample_bearing_dimensions();
