#pragma once
#include "twin/analysis/analysis.h"

// Findings of each kind; they add to the analysis and say in its notes what could not be looked at.
namespace mill::twin {
/// Modes confirmed by both halves, with their owners: from the recorded force where one is there, else and beside
/// it from the response alone.
void add_mode_findings(Analysis &analysis, const CleanRecord &record, const CaseModel *stand,
                       const AnalysisSettings &settings);
/// Lines and resonances that are no confirmed mode: fixed or locked to the speed, and whose they are.
void add_peak_findings(Analysis &analysis, const CleanRecord &record, const CaseModel *stand, double speed);
/// What is locked to the speed: waves per turn of each roll.
void add_locked_findings(Analysis &analysis, const CaseModel *stand);
/// Modes near instability, and alarms.
void add_onset_findings(Analysis &analysis, const CleanRecord &record, const AnalysisSettings &settings);
/// Bearings of the case.
void add_bearing_findings(Analysis &analysis, const CleanRecord &record, const CaseModel *stand,
                          const AnalysisSettings &settings);
/// Zones, where the user gave them, and the change against the baseline.
void add_severity_findings(Analysis &analysis, const AnalysisSettings &settings);
/// Says of every frequency in a band of the settings that it lies there.
void name_bands(Analysis &analysis, const AnalysisSettings &settings);

/// Is it a force that drives the stand?  A load cell shows a response.
bool is_force(const ChannelAnalysis &channel);
/// Hz, where the density of a recorded force falls or rises by 10 dB within 5 % and stays there.
std::vector<double> force_edges(const Analysis &analysis);
/// Within 2 % of one, or half the width of a pole.
bool is_edge(const std::vector<double> &edges, double frequency, double damping = 0);

/// The channel of a name; it is one of the record.
const ChannelAnalysis &channel_of_name(const Analysis &analysis, const std::string &name);
/// -, highest over lowest speed less one; 0 where no speed was recorded.
double speed_span(const Analysis &analysis);
}  // namespace mill::twin
