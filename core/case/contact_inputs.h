#pragma once
#include "core/base/each_member.h"
#include "core/case/pass_inputs.h"
#include "core/model/contact_settings.h"
#include "core/model/four_high.h"
#include "core/model/roll.h"
#include "core/model/two_cylinders.h"
#include "core/records/key_list.h"
#include <string>
#include <vector>

// What the contact stages read of a case.  Members that a result does not read, and those that another one
// replaces, have the value of a record that was not given.  As text (record_text) they are keys of kept results,
// and the inputs of a result are the rows that move that text.
namespace mill {
class MovingKeys;

/// One pair of rolls.
struct ContactInputs {
  ElasticConstants steel;
  Roll work_roll, backup_roll;
  double strip_width = 0;  ///< m
  ContactSettings settings;
  std::vector<LoadInputs> loads;  ///< that the answer belongs to, or that the swept range is made for
};

template <class Io> void each_member(Io &&io, const ContactInputs &record)
{
  const auto &[steel, work_roll, backup_roll, strip_width, settings, loads] = record;
  io("steel", steel);
  io("work_roll", work_roll);
  io("backup_roll", backup_roll);
  io("strip_width", strip_width);
  io("settings", settings);
  io("loads", loads);
}

/// Everything of a pair but its loads.
/// @param settings  of the contact, with its friction and the trim of its path
ContactInputs inputs_of_pair(const FourHigh &stand, const ContactSettings &settings);

/// What is read off a pair: stiffness and pressure, the effect of friction, the plateau along the path.
enum class ContactReading { curve, friction, path };
/// One result of one pass.
/// @param name  "upper" or "lower"
ContactInputs inputs_of_contact(const FourHigh &stand, const std::string &name, std::size_t pass,
                                ContactReading reading);
/// Keys behind such results: K3.*, K5.* and contact.NAME.*.  Both ways of holding the rolls are solved on one
/// mesh, whose patch must hold the wider contact, so all results of a reading have one list.
/// @param keys  of a stand
KeyList contact_keys(MovingKeys &keys, const std::string &name, std::size_t pass,
                     ContactReading reading = ContactReading::curve);

/// Two bodies at their working load.
struct BodyPairInputs {
  RoundBody upper, lower;
  ElasticConstants steel;      ///< where a body has none of its own
  LineContactSettings line;    ///< in plane strain
  SpaceContactSettings space;  ///< in space
};

template <class Io> void each_member(Io &&io, const BodyPairInputs &record)
{
  const auto &[upper, lower, steel, line, space] = record;
  io("upper", upper);
  io("lower", lower);
  io("steel", steel);
  io("line", static_cast<const ContactSettings &>(line));
  io("tangential_load", line.tangential_load);
  io("plane_depth", line.plane_depth);
  io("space", space);
}

/// What is read off two bodies: what the load does, the slope of its curve, which knows how that was sampled, and
/// stick and slip under a tangential load.
enum class BodyReading { pressed, slope, slip };
BodyPairInputs inputs_of_bodies(const TwoCylinders &pair, BodyReading reading);
/// Keys behind such results, of kind "two-cylinders".
KeyList cylinder_keys(MovingKeys &keys, BodyReading reading);
}  // namespace mill
