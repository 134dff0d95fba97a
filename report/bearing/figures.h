#pragma once
#include "report/page/page.h"
#include "report/page/run.h"
#include "report/plot/svg_plot.h"
#include <string>
#include <vector>

// What the section of one bearing consists of.  Every function takes what is stored and leaves out the rest.
namespace mill::report {
/// Names "Kzc", "Kzc1" .. "Kzc4" of the results that belong to this bearing, identified by the keys they were made
/// from.
std::vector<std::string> results_of_bearing(const Run &run, const std::string &bearing);

/// Its working loads, kN, with these names; equal loads are one mark.
std::vector<Mark> bearing_loads(const Run &run, const std::string &bearing);

// Drawings of the table curves/bearing-NAME.csv; an old one without the columns of other models has a line less.
std::string force_over_displacement(const Table &curve);
std::string stiffness_over_load(const Table &curve, const std::vector<Mark> &loads);
std::string shares_over_load(const Table &curve, const std::vector<Mark> &loads);

std::string share_bars(const Table &rows);      ///< of bearing-NAME-rows.csv
std::string cage_variation(const Table &cage);  ///< of bearing-NAME-cage.csv
std::string cage_sentence(const Table &cage);   ///< mean and range of both slopes, in words; HTML
std::string row_table(const Table &rows);       ///< HTML; empty when only shares are stored

/// Roller loads round the ring, one drawing for every group of rows that carry the same.  Angle zero, the
/// direction of the load, points downwards; all drawings have one scale.  Columns row1 .. row4 of
/// bearing-NAME-rollers.csv, standard_row1 .. as a thin line behind.
std::vector<std::string> roller_polars(const Table &rollers);

/// Where the heaviest roller is, in words: on the load line or how far off it.  HTML.
std::string heaviest_roller_sentence(const Table &rollers);

// One roller between its raceways: bearing-NAME-law.csv, bearing-NAME-tilt.csv.
std::vector<std::string> roller_law_drawings(const Table &law, const std::vector<Mark> &heaviest);
std::vector<std::string> roller_tilt_drawings(const Table &tilt);

/// Computed per-roller stiffnesses compared with the published ones and the two factors that lead from a roller to
/// the bearing.  Nothing without curves/bearing-NAME-published.csv.
void published_comparison(Page &page, const Run &run, const std::string &bearing);

/// An oil film over load and speed, and its pressure; false and nothing for another bearing.
bool oil_film_figures(Page &page, const Run &run, const std::string &bearing);

/// Motion of a mass on the bearing: response/bearing-NAME.csv and its spectrum.  Nothing without.
void bearing_motion(Page &page, const Run &run, const std::string &bearing);

/// Section through the bearing and its chock, to scale; empty when the run stored no dimensions.
std::vector<std::string> bearing_sketch(const BearingInfo &bearing);
}  // namespace mill::report
