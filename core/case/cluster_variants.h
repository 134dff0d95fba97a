#pragma once
#include "core/model/cluster.h"
#include <string>

// Keys of a cluster by the names of its parts: "contact.W-R.stiffness", "support.E.load", "stack.spin".
namespace mill {
struct Reading;

/// One number of a cluster by its key, for a fit.
/// @return nullptr where the part does not exist, or its key is not a given number
double *number_of(ClusterStand &stand, const std::string &key);

/// Sets "contact.W-R.law = spring" by the row of the key.
/// @throws InputError  no such part or key, or a value that the row refuses
void set_value(ClusterStand &stand, const std::string &set);

/// The stack of a variant: that of the case with what the variant sets.  @throws InputError  as set_value
ClusterStand with_variant(const ClusterStand &stand, const ClusterVariant &variant);

/// Names, sets, unknowns and modes of all variants; fits with more unknowns than frequencies.
void check_variants(const ClusterStand &stand, Reading &reading);
}  // namespace mill
