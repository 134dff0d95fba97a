#pragma once
#include "core/case/stand_rows.h"
#include "core/model/cluster.h"

// Rows of kind = "cluster".
namespace mill {
/// [strip]: friction is a number, or a section of its own.
const std::vector<Field<StripInput>> &cluster_strip_rows();  ///< friction last
const std::vector<Field<ClusterSettings>> &cluster_stack_rows();
const std::vector<Field<ClusterRoll>> &cluster_roll_rows();
const std::vector<Field<ClusterContact>> &cluster_contact_rows();
const std::vector<Field<ClusterSupport>> &cluster_support_rows();
const std::vector<Field<ClusterPass>> &cluster_pass_rows();
const std::vector<Field<ClusterResponse>> &cluster_response_rows();
const std::vector<Field<ClusterMode>> &cluster_mode_rows();
const std::vector<Field<ClusterVariant>> &cluster_variant_rows();
}  // namespace mill
