#pragma once
#include "core/records/cluster_names.h"
#include "core/records/cluster_record.h"
#include "report/page/run.h"
#include <optional>
#include <string>

// What the section of a stack of rolls consists of; HTML and SVG, empty when nothing is there to show.
namespace mill::report {
struct ClusterData {
  std::optional<ClusterRecord> record;
  std::string problem;  ///< why it cannot be shown; empty: nothing is wrong, or nothing is stored
};
/// Reads curves/cluster.json of a run directory, or another file with the same record.  Never throws.
ClusterData read_cluster_record(const std::string &run_directory, const std::string &file = cluster_file);

/// All rolls to scale with the force in every contact and support under one pass.
std::string stack_drawing(const ClusterRecord &record, const ClusterPassRecord &pass);
/// Mode shapes of one pass, moving in the plane; both extremes stand still on paper.
std::string moving_modes(const ClusterRecord &record, const ClusterPassRecord &pass);

std::string contact_table(const ClusterRecord &record);
/// Frequencies of all passes and the published ones.
std::string frequency_table(const ClusterRecord &record);
/// What every mode of the first pass consists of.
std::string share_table(const ClusterPassRecord &pass);
/// Modes by what they do to the gap, with the strip rolling between the work rolls and without; empty: no names.
std::string gap_table(const Run &run);
std::string stability_table(const ClusterRecord &record);
std::string cluster_history_table(const ClusterRecord &record);
std::string cluster_fit_table(const ClusterRecord &record);

/// The section; nothing for a run without a stack.
class Page;
void cluster_section(Page &page, const Run &run);
}  // namespace mill::report
