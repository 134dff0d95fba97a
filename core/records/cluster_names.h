#pragma once
#include "core/records/result_names.h"

// Names of what a run of kind "cluster" writes.
namespace mill {
namespace family {
/// cluster.PASS.f1, cluster.PASS.W-I.force, cluster.fit.VARIANT.KEY
constexpr const char *cluster = "cluster";
}  // namespace family
/// Second part of the names of what a fit of the stack finds.
constexpr const char *cluster_fit  = "fit";
constexpr const char *cluster_file = "curves/cluster.json";
/// SI unit of a number that a fit of the stack finds, by its key "contact.W-I.stiffness".
const char *unit_of_cluster_key(const std::string &key);

namespace curve {
/// Of a pass: velocity amplitude of every roll and direction.
inline constexpr CurveKind cluster_response{
    "cluster", true, "response", "velocity under the dynamic force", Figure::section, {{{"frequency", "Hz"}}},
    true,      '.'};
inline constexpr CurveKind cluster_history{
    "cluster", true, "history", "contact forces in time", Figure::section, {{{"time", "s"}}}, true, '.'};
/// Of a mode of the first pass.
inline constexpr CurveKind cluster_backbone{"cluster",
                                            true,
                                            "backbone",
                                            "frequency over amplitude",
                                            Figure::section,
                                            {{{"amplitude", "m"}, {"frequency", "Hz"}}},
                                            true,
                                            '.'};
inline constexpr CurveKind cluster_load{
    "cluster", false, "load", "frequencies over the rolling force", Figure::section, {{{"force", "N"}}}, true};
}  // namespace curve
}  // namespace mill
