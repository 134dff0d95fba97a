#pragma once
#include "core/base/choice.h"
#include "core/base/errors.h"
#include "core/model/bite_setup.h"
#include "core/model/chatter.h"
#include "core/model/given.h"
#include "core/model/material.h"
#include "core/model/pass.h"
#include "core/model/strip.h"
#include "core/model/support_type.h"
#include <array>
#include <string>
#include <vector>

// A planar stack of rolls that lean on each other, its supports and its passes, as the case file has them.  SI.
namespace mill {
/// Of the two rolls that define its position.
enum class PositionSide { below, above };
constexpr auto words_of(PositionSide)
{
  return choice_words<PositionSide>("below", "above");
}

/// [[roll]]
struct ClusterRoll {
  std::string name;
  double barrel_diameter         = 0;                       ///< m
  double barrel_length           = 0;                       ///< m
  double mass                    = not_given;               ///< kg; absent: of the solid barrel
  double density                 = not_given;               ///< kg/m3; absent: [steel]
  double youngs_modulus          = not_given;               ///< Pa; absent: [steel]
  double poisson_ratio           = not_given;               ///< -; absent: [steel]
  std::array<double, 2> position = {not_given, not_given};  ///< m, of the unloaded axis; absent: from contacts
  PositionSide side              = PositionSide::below;
  Place place;  ///< of the [[roll]] header
};

/// Load over approach of two rolls.
enum class ClusterLaw { power, foeppl, johnson, computed, spring };
constexpr auto words_of(ClusterLaw)
{
  return choice_words<ClusterLaw>("power", "foeppl", "johnson", "computed", "spring");
}

/// [[contact]] of two rolls.
struct ClusterContact {
  std::string pair;              ///< "W-I"
  double direction = not_given;  ///< rad, from the first axis to the second, counted from +x to +y
  std::string like;              ///< pair of which this one is the mirror image; empty: none
  ClusterLaw law       = ClusterLaw::johnson;
  double coefficient   = 3.84e-5;    ///< of the power law, mm and N
  double length        = not_given;  ///< m; absent: the shorter barrel
  double stiffness     = not_given;  ///< N/m, tangent at `load`: law spring
  double load          = not_given;  ///< N, where the stiffness belongs
  double exponent      = 1;          ///< -, of the law spring
  double loss_factor   = not_given;  ///< -; absent: that of [response]
  double damping       = 0;          ///< N s/m, of impact
  double damping_depth = 0;          ///< m, approach at which the damping is in full
  Place place;
};

/// [[support]] of one roll on the ground.
struct ClusterSupport {
  std::string roll;
  std::string name;  ///< absent: the roll's
  SupportType type = SupportType::radial;
  std::string like;                ///< support of which this one is the mirror image; empty: none
  double stiffness  = not_given;   ///< N/m, tangent at `load`
  double load       = not_given;   ///< N
  double exponent   = 0.9;         ///< -, q of d = kappa F^q; 1: a straight spring
  double direction  = 0;           ///< rad, of a guide
  double half_angle = not_given;   ///< rad, between the outward normal and either roller
  double preload    = not_given;   ///< N, of each roller
  std::string against;             ///< roll that the rollers press theirs against
  double guard       = 1e4;        ///< N/m, across and along, that holds a roll out of contact
  double loss_factor = not_given;  ///< -; absent: that of [response]
  bool fitted        = false;      ///< follows only from a fit; the results state this
  Place place;

  const std::string &own_name() const
  {
    return name.empty() ? roll : name;
  }
};

/// [[pass]]; the tensions of Pass are given, or follow from the pulls.
struct ClusterPass : Pass {
  double entry_pull        = not_given;  ///< N, whole tension force of the strip before the bite
  double exit_pull         = not_given;  ///< N
  double horizontal_force  = 0;          ///< N, on the roll at the strip, along +x
  double dynamic_force     = not_given;  ///< N, amplitude
  double dynamic_frequency = not_given;  ///< Hz
  double loss_factor       = not_given;  ///< -, of the contacts in this pass; absent: that of [response]
  double published_force   = not_given;  ///< N, of a published model
  double published_dynamic = not_given;  ///< N
  std::array<double, 2> measured_force = {not_given, not_given};  ///< N, range
  bool common_fit = true;  ///< takes part in what all passes have in common; false: a blind test of it
};

/// [[mode]]: a motion that has a name, published frequencies with it.
struct ClusterMode {
  std::string name;
  std::string shape;             ///< "W y, I y 0.8, L x -1"
  double frequency = not_given;  ///< Hz, published
  Place place;
};

/// [[variant]]: the stack with other laws, and what is fitted of it.
struct ClusterVariant {
  std::string name;
  std::vector<std::string> set;       ///< "contact.W-R.law=spring"
  std::vector<std::string> unknowns;  ///< "support.E.stiffness"
  std::vector<std::string> modes;     ///< names of [[mode]]
  std::string pass;                   ///< by name; empty: the first
  Place place;
};

/// Coupled: tangential springs in the contacts.
enum class ClusterSpin { free, coupled };
constexpr auto words_of(ClusterSpin)
{
  return choice_words<ClusterSpin>("free", "coupled");
}

/// [stack]
struct ClusterSettings {
  std::string strip;                      ///< roll at the strip, or "S-T": upper and lower one
  double strip_stiffness    = not_given;  ///< N/m, between those two; absent: the force is imposed
  bool gravity              = true;
  ClusterSpin spin          = ClusterSpin::free;
  double tangential_ratio   = 1;          ///< -, tangential over normal stiffness of a contact
  double flattening_modulus = not_given;  ///< Pa, of the roll at the strip in Hitchcock's formula; absent: its own
  double flattening_poisson = not_given;  ///< -
};

/// [response]
struct ClusterResponse {
  double loss_factor                = 0;                       ///< -, of contacts
  double support_loss_factor        = 0;                       ///< -
  std::array<double, 2> frequencies = {not_given, not_given};  ///< Hz
  int points                        = 600;
  double duration                   = 0.02;  ///< s, of a history
  double force_factor               = 1;     ///< -, on the dynamic force of a history
  double depth_share                = 0.2;   ///< -, depth of the damping over the approach at rest
};

/// All of a case of kind "cluster".
struct ClusterStand {
  Material steel;
  ClusterSettings stack;
  std::vector<ClusterRoll> rolls;
  std::vector<ClusterContact> contacts;
  std::vector<ClusterSupport> supports;
  Strip strip;  ///< width, laws; thicknesses are those of the passes
  std::vector<ClusterPass> schedule;
  BiteSetup bite;
  ClusterResponse response;
  StandSpan span;            ///< strip before and behind the stand, for chatter
  ChatterAnalysis analysis;  ///< of chatter
  ChatterAdvice advice;
  std::vector<ClusterMode> modes;
  std::vector<ClusterVariant> variants;
};
}  // namespace mill
