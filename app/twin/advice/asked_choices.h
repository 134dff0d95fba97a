#pragma once
#include "core/base/errors.h"
#include "core/model/advice.h"
#include "core/model/process_advice.h"
#include "core/records/stand_place.h"
#include "twin/advice/advice.h"
#include <string>
#include <vector>

// Places and dampers that [advice] names, in the stand that they are asked of.
namespace mill {
struct Case;

/// The foundation, as the end of a damper.
inline bool is_ground(const std::string &place)
{
  return place == ground_place;
}

/// Where the case has a key; else the case.
Place place_of_key(const Case &the_case, const std::string &key);

/// Index of a place by its name in the case.
/// @param key  that names it
/// @throws InputError  the stand has no such place
int place_in(const twin::VibratingStand &stand, const Case &the_case, const std::string &key,
             const std::string &name);

/// Dampers of [[advice.damper]], those of one name together; without any the usual ones.
/// @throws InputError  a place that the stand does not have, both ends at one place
std::vector<twin::DamperChoice> damper_choices(const twin::VibratingStand &stand, const StandAdvice &asked,
                                               const Case &the_case);

/// The chock that carries a damper of a roll, by its name in a detailed stand; another place is itself.
int on_its_chock(const twin::VibratingStand &stand, const std::string &roll);

/// What may be changed of a pass of kind chatter or cluster; its friction law only through the viscosity.
ProcessAdvice process_of(const ChatterAdvice &asked);
}  // namespace mill
