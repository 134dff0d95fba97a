#pragma once
#include "report/chatter/data.h"
#include "report/page/run.h"
#include <string>
#include <vector>

// What the section on chatter consists of.  Every function takes what is stored and leaves out the rest; empty
// when there is nothing to show.
namespace mill::report {
// Over the roll speed, from curves/chatter-<slug>-speed.csv; working and critical speed are marked.
std::string chatter_growth(const Run &run, const ChatterCondition &condition, double width);
std::string chatter_frequency(const Run &run, const ChatterCondition &condition);
/// Friction, oil film and rolling force, a drawing each.
std::vector<std::string> chatter_bite(const Run &run, const ChatterCondition &condition);
/// What strip and bite add to the damping; cut where it is far below zero.
std::string chatter_process_damping(const Run &run, const ChatterCondition &condition);

/// The tracked modes in the plane of growth rate and frequency, darker the faster the rolls turn.
std::string chatter_locus(const Run &run, const ChatterCondition &condition);

/// Growth rate over speed and another quantity in steps on both sides of zero, with the line between stable and
/// unstable and the working point.
/// @param quantity  "reduction", "tension", "viscosity"
std::string chatter_map(const Run &run, const ChatterCondition &condition, const std::string &quantity);

/// Gap over time below, at and above the critical speed, static drawings and zoomable charts.  HTML
std::string chatter_histories(const Run &run, const ChatterCondition &condition);
/// A few periods at the critical speed, every quantity over its own amplitude.
std::string chatter_periods(const Run &run, const ChatterCondition &condition);
/// Gap, force and tensions on the way to the limit cycle and in it.  HTML
std::string chatter_limit_cycle(const Run &run, const ChatterCondition &condition);
/// The last periods of the limit cycle, a drawing each for gap, force and tensions.
std::vector<std::string> chatter_cycle_periods(const Run &run, const ChatterCondition &condition);

/// Gap, force, tensions and friction as arrows in the unit circle.
std::string chatter_phasors(const ChatterPhases &phases);
/// Every body of a stand with its amplitude and direction while the gap opens.
std::string chatter_shape(const std::vector<ChatterPoint> &shape, const std::string &title);

/// Relative changes when each input is 10 % lower or higher, the strongest first; at most 16 inputs.
std::string tornado_of_speed(const ChatterCondition &condition);
std::string tornado_of_friction(const ChatterCondition &condition);

std::string chatter_tandem_growth(const Run &run, const ChatterTandem &tandem);
/// The same on a fine grid of speeds, from curves/chatter-tandem-lobes.csv.
std::string chatter_tandem_lobes(const Run &run, const ChatterTandem &tandem);

// Tables, HTML.
std::string chatter_summary_table(const std::vector<ChatterCondition> &conditions);
std::string chatter_published_table(const std::vector<ChatterCondition> &conditions);
std::string chatter_scheme_table(const ChatterCondition &condition);
std::string chatter_variant_table(const ChatterCondition &condition);
std::string chatter_conclusion_table(const ChatterCondition &condition);
std::string chatter_structure_table(const ChatterCondition &condition);
std::string chatter_event_table(const LimitCycleInfo &cycle);
std::string chatter_tandem_table(const ChatterTandem &tandem);

/// What a mill engineer asks first: at which speed, at which frequency, how far away, what moves it, how sure.
std::vector<std::string> chatter_answer(const ChatterCondition &condition);

/// "stable throughout", "chatters from 18.21 m/s".  Plain text
std::string verdict_in_words(const std::string &verdict, double speed);
}  // namespace mill::report
