#pragma once
#include "app/trace/closed_form_keys.h"
#include "core/base/parameter.h"
#include "core/model/material.h"
#include "reduce/bite/bite.h"
#include <array>
#include <optional>
#include <string>
#include <vector>

// What stands in for finite elements where an answer is wanted at once: closed forms.  theory.md 24
namespace mill {
struct ContactSettings;
struct FourHigh;

struct BearingCase;
struct BiteCase;
struct ChatterCase;
struct ClosedFormMemory;
class MovingKeys;
struct TwoCylinders;

/// A result by a closed form, and how it hangs on the case.
struct ClosedFormResult {
  std::string name;               ///< as in results.json: "K3", "pass 1.rms_g.upper_work_roll"
  Parameter parameter;            ///< inputs: keys behind the same result of a run, of a spring by spring_keys()
  KeyList closed;                 ///< those of the inputs that the closed form follows; the others only a run does
  std::vector<std::string> from;  ///< results it is made of
  KeyList own_keys;               ///< keys that enter in addition to those of its parts
  double load        = not_given;  ///< N, that a contact or a bearing is computed for
  double film_damper = 0;          ///< N s/m, of K_Zy and K_Zy_lower: oil films of both bearings
  std::string relation;            ///< "springs in series": what joins inputs and result
  std::string file;                ///< that computes it in a run, "reduce/chain/spring_chain"
  std::string equation;            ///< of docs/theory.md, "(4.1b)"
  std::string stands_for;          ///< what a run does instead of parameter.method; empty: the same
  std::string symbol;              ///< of a spring or mass, where it is not its name: "K3" of "pass 2.K3"
};

/// K3 ("upper") or K5 ("lower"): Hertz line contact over the length on which the barrels face each other.  (3.5b)
/// @param load  N, of the pass
ClosedFormResult closed_form_contact(const FourHigh &stand, const std::string &name, double load,
                                     std::size_t pass);

/// Kzc1..Kzc4, along and across the load, K_Zy and K_Zy_lower: laminae between rigid rings at the load of each
/// bearing. (5.2), (5.23)
/// @param keys  of the stand; nullptr: without lists of keys
std::vector<ClosedFormResult> closed_form_bearings(const FourHigh &stand, double rolling_force, std::size_t pass,
                                                   ClosedFormMemory &memory, MovingKeys *keys);

/// K4 of one pass by the slab theory of [bite] on Hitchcock's or a rigid arc.  (8.13)
/// The value is NaN where the theory has no answer; the method then says why.
/// @param keys  of the stand; nullptr: without lists of keys
ClosedFormResult closed_form_bite(const FourHigh &stand, int pass, MovingKeys *keys);

/// K4.plastic_slope, K4.flattening and their series by the same theory; nothing where it has no answer.
std::optional<bite::BiteStiffness> closed_form_bite_stiffness(const FourHigh &stand, int pass);

/// The stand with what [housing] and [screwdown] give in its frame: the housing as a frame of beams, the springs
/// of the screw-down by formula as in a run.  theory.md 23.4, 23.6
FourHigh with_drawn_frame(FourHigh stand);

/// Results of each kind of case.
/// @param keys  of the case; nullptr: without lists of keys
std::vector<ClosedFormResult> closed_form_cylinders(const TwoCylinders &pair, MovingKeys *keys);
std::vector<ClosedFormResult> closed_form_bearing_case(const BearingCase &spec, MovingKeys *keys);
std::vector<ClosedFormResult> closed_form_bite_case(const BiteCase &spec, MovingKeys *keys);
std::vector<ClosedFormResult> closed_form_chatter(const ChatterCase &spec, MovingKeys *keys);
}  // namespace mill
