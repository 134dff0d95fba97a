#pragma once
#include "report/page/page.h"
#include "report/page/run.h"
#include <string>

// The sections of the page, each in a file of its name.  A section whose data the kind of run cannot have is left
// out; one that could be there but is not stored says so.
namespace mill::report {
struct ChatterData;
struct ModelData;

/// What is seen before scrolling: verdict, numbers, stand to scale, at most five warnings.
std::string first_screen(const Run &run);
/// Which model the frequencies come from, short table.
void summary_section(Page &page, const Run &run, const ModelData &models);
void stand_section(Page &page, const Run &run);  ///< sketch with the numbers on it
/// Mill modulus over the force and what moves the thickness, inside the stand's section; nothing without its
/// curve.
void modulus_part(Page &page, const Run &run);
void contact_section(Page &page, const Run &run);  ///< load-approach, K(F), along the barrel
void bite_section(Page &page, const Run &run);     ///< pressure, friction and strain in the bite, K4
/// Critical speed, modes, maps, motion and what moves them; nothing when the run stored nothing about chatter.
void chatter_section(Page &page, const Run &run, const ChatterData &data);
void bearing_section(Page &page, const Run &run);  ///< Kzc(F), row shares, roller loads
void shape_section(Page &page, const Run &run);    ///< f1, f2 with the supports
/// Mass breakdown and equivalent masses by every route; nothing when the run compared no models.
void mass_section(Page &page, const ModelData &data);
void mode_section(Page &page, const Run &run);  ///< shapes, energy shares, horizontal modes
/// How few masses are enough: six masses compared with detailed models; nothing when the run compared no models.
void model_section(Page &page, const Run &run, const ModelData &data);
/// Accelerance of rolls and chocks, Campbell diagram; nothing when the run stored neither.
void frequency_section(Page &page, const Run &run);
/// Forces of a pass schedule with their fits; nothing when the run stored none.
void schedule_section(Page &page, const Run &run);
/// Spacing of marks against rolls, bearings and modes; nothing when the run stored none.
void marks_section(Page &page, const Run &run);
void response_section(Page &page, const Run &run);  ///< peaks, histories, spectra
/// Passes driven on the curves of contacts and bearings; nothing when the run stored none.
void nonlinear_section(Page &page, const Run &run);
void limits_section(Page &page, const Run &run);  ///< what is assumed, what was not stored
void full_results_section(Page &page, const Run &run);
void record_section(Page &page, const Run &run);  ///< program, versions, timings

/// Rolls, chocks, housing and screw-down to scale, as far as the case draws them; empty without the rolls' sizes.
std::string stand_to_scale(const Run &run);

/// The stand to scale with the spring-mass chain and its numbers next to it; without geometry the chain alone.
std::string stand_sketch(const Run &run);

/// A zoomable chart of a history for the screen: data of a script element that page.js turns into a chart.
/// Empty when the build found no plotting library: then only the static drawing is shown.
/// @param group   charts of one group zoom together
/// @param title   above the chart; empty: the labels
/// @param y_axis  "acceleration [g]"
/// @param limit   half the height of the chart around zero; 0: from the data
/// @param time    (n) s, equally spaced
/// @param series  label and values (n); drawn by the extremes of `zoom_intervals` intervals
std::string zoom_chart(const std::string &group, const std::string &y_axis, double limit,
                       const Eigen::VectorXd &time,
                       const std::vector<std::pair<std::string, Eigen::VectorXd>> &series,
                       const std::string &title = "");
constexpr Eigen::Index zoom_intervals = 4000;

/// A lumped or a four-high run has a chain; two cylinders have none.
bool has_chain(const Run &run);
}  // namespace mill::report
