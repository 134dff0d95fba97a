#pragma once
#include "core/model/chatter.h"
#include "core/records/key_list.h"
#include "core/records/result_row.h"
#include <cstddef>

// What stands behind the results of a condition of kind chatter; as core/case/contact_inputs.h.
namespace mill {
class MovingKeys;

/// What is asked of a condition: its bite at the working speed and the derivatives of that bite, the growth of a
/// vibration at that speed, or the search over the speed; all: of growth and search together.
enum class ChatterReading { bite, slopes, growth, search, all };

/// Keys that move a result of a condition on the stand of the case.
/// @param keys  of a case of chatter
KeyList chatter_keys(MovingKeys &keys, std::size_t condition, ChatterReading reading);

/// Of the search on another reading of the stand.
/// @param variant  its place in the case
KeyList variant_keys(MovingKeys &keys, std::size_t condition, std::size_t variant);

/// The bite of a pass of a four-high stand by the slab theory of the search, or its derivatives.
/// @param reading  bite or slopes;  @param row  of the result
KeyList pass_bite_keys(MovingKeys &keys, std::size_t pass, ChatterReading reading, const ResultRow &row);

/// The stability of a pass of a four-high stand, but for the chain and its bearings: the bite by its slab theory,
/// the strip between the stands and the settings of the search.
/// @param reading  growth, search or all
KeyList stand_search_keys(MovingKeys &keys, std::size_t pass, ChatterReading reading);

/// The stand that a variant describes: what it leaves open is that of [stand].
ChatterStand completed(const ChatterVariant &variant, const ChatterStand &stand);
}  // namespace mill
