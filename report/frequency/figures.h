#pragma once
#include "report/frequency/data.h"
#include "report/page/run.h"
#include <string>
#include <vector>

// Drawings of the frequency response and of the Campbell diagram; empty when nothing is there to show.
namespace mill::report {
/// The model whose responses are the results: the first stored of finite elements, beams, six masses.
std::string responding_model(const Run &run);

/// Magnitude over frequency at one place for the force in the bite, with its band and the other models.
std::string magnitude_drawing(const Run &run, const std::string &model, const std::string &place);
/// Phase over frequency of the same.
std::string phase_drawing(const Run &run, const std::string &model, const std::string &place);
/// Magnitudes at several places, for the force in the bite or, with `at_itself`, at the place.
std::string places_drawing(const Run &run, const std::string &model, const std::string &title,
                           const std::vector<std::string> &places, bool at_itself);
/// Places that the model has, "upper work roll".
std::vector<std::string> responding_places(const Run &run, const std::string &model);

std::string campbell_drawing(const CampbellData &data);
/// Crossings nearest to the working range, or the slowest ones without a range.
std::string crossing_table(const CampbellData &data, std::size_t most);
}  // namespace mill::report
