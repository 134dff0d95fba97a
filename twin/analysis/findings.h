#pragma once
#include "twin/analysis/analysis.h"

// Findings of each kind; they add to the analysis and say in its notes what could not be looked at.
namespace mill::twin {
/// Modes confirmed by both halves, with their owners: from the recorded force where there is one, and from the
/// response alone.
/// @param line_free  channels of the record from which lines were taken off
void add_mode_findings(Analysis &analysis, const CleanRecord &record, const std::vector<CleanChannel> &line_free,
                       const CaseModel *stand, const AnalysisSettings &settings);
/// Lines: combs of lost samples, families, side bands, then single lines with their source.
void add_line_findings(Analysis &analysis, const CleanRecord &record, const CaseModel *stand, double speed,
                       const AnalysisSettings &settings);
/// Resonances that no confirmed mode explains, with their owner.
void add_resonance_findings(Analysis &analysis, const CaseModel *stand, double speed);
/// What is locked to the speed: waves per turn of each roll.
void add_locked_findings(Analysis &analysis, const CaseModel *stand);
/// Modes near instability, and alarms.
void add_onset_findings(Analysis &analysis, const CleanRecord &record, const std::vector<CleanChannel> &line_free,
                        const AnalysisSettings &settings);
/// The channel without lines where it had some, else that of the record.
const CleanChannel *line_free_channel(const CleanRecord &record, const std::vector<CleanChannel> &line_free,
                                      const std::string &name);
/// Bearings of the case.
void add_bearing_findings(Analysis &analysis, const CleanRecord &record, const CaseModel *stand,
                          const AnalysisSettings &settings);
/// Zones, where the user gave them, and the change against the baseline.
void add_severity_findings(Analysis &analysis, const AnalysisSettings &settings);
/// States for every frequency in a band of the settings that it lies in this band.
void name_bands(Analysis &analysis, const AnalysisSettings &settings);

/// Whether it is a force that drives the stand; a load cell shows a response.
bool is_force(const ChannelAnalysis &channel);
/// Hz, where the density of a recorded force falls or rises by 10 dB within 5 % and stays there.
std::vector<double> force_edges(const Analysis &analysis);
/// Within 2 % of one, or half the width of a pole.
bool is_edge(const std::vector<double> &edges, double frequency, double damping = 0);

/// A line where the bins are too wide to separate it from a confirmed mode, unless it is steady where the mode
/// fades.
bool is_unresolved_mode(const Analysis &analysis, const Peak &peak);
/// What a frequency at this speed leaves on strip and rolls.
std::string spacing_sentence(double frequency, double speed, const CaseModel *stand);
/// Shares of the variance of every channel, its largest peak, and the list of all candidates.  theory.md (41.29)
void add_accounts(Analysis &analysis);

/// The channel of a name; it is one of the record.
const ChannelAnalysis &channel_of_name(const Analysis &analysis, const std::string &name);
/// The channel of this name where it holds a speed; nullptr: absent, of another unit, or without samples.
const CleanChannel *recorded_speed(const CleanRecord &record, const std::string &name);
/// -, highest over lowest speed less one; 0 where no speed was recorded.
double speed_span(const Analysis &analysis);
}  // namespace mill::twin
