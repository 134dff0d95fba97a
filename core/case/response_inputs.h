#pragma once
#include "core/case/kinds.h"
#include "core/records/key_list.h"
#include <cstddef>
#include <string>

// What the motion of a stand under a force reads of a case in addition to its masses and springs, as text; as
// core/case/contact_inputs.h.  Stands are those of kind four-high and lumped.
namespace mill {
class MovingKeys;

/// Who answers: the model of the case, the six masses on linear springs that represent it in closed form, or the
/// same six masses under white force, which has no samples.
enum class ResponseReading { model, six_masses, white };

/// The response to the force of a pass.
std::string text_of_response(const CaseSpec &spec, std::size_t pass, ResponseReading reading);

/// frf.*, and the settings of campbell.* with the orders of the drive.
std::string text_of_frequency_response(const CaseSpec &spec);
std::string text_of_campbell(const CaseSpec &spec);

/// Keys of a response in addition to those of its masses, springs and damper.
KeyList response_keys(MovingKeys &keys, std::size_t p, ResponseReading reading = ResponseReading::model);
/// The same of frf.*.
KeyList frequency_response_keys(MovingKeys &keys);
/// Settings of campbell.* with the orders of the drive.
KeyList campbell_keys(MovingKeys &keys);
}  // namespace mill
