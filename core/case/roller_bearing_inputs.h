#pragma once
#include "core/model/bearing_case.h"
#include "core/model/roller_bearing.h"
#include "core/records/result_row.h"
#include <array>
#include <string>

// What the results of one roller bearing read of a case, whatever loads it; as core/case/contact_inputs.h.
namespace mill {
/// A roller bearing in equilibrium.
struct BearingInputs {
  std::string type;                                        ///< which angles are read
  RollerBearing bearing;                                   ///< without what its model does not read
  std::string designation, catalogue;                      ///< that gave what the case does not
  std::array<double, 2> ratings = {not_given, not_given};  ///< N, that rollers were estimated from
};

template <class Io> void each_member(Io &&io, const BearingInputs &record)
{
  const auto &[type, bearing, designation, catalogue, ratings] = record;
  io("type", type);
  io("bearing", bearing);
  io("designation", designation);
  io("catalogue", catalogue);
  io("ratings", ratings);
}

/// What a result of a bearing is, as far as it decides which keys move it.
enum class BearingAsks {
  along,              ///< stiffness, motion or load that the equilibrium gives
  across,             ///< stiffness across the load
  tilting,            ///< stiffness against tilt: arms of the rows, and of the slices along a roller
  row_share,          ///< share of a row in the radial load
  row_axial,          ///< axial force of a row, whose sign is that of its arrangement
  rib,                ///< force on the rib of the cone
  fitted_load,        ///< load at which the curve takes a published stiffness
  dynamic_rating,     ///< C
  static_rating,      ///< C0
  equivalent_load,    ///< P
  safety,             ///< S0
  basic_life,         ///< L10
  life_by_slices,     ///< L10r
  modified_life,      ///< L10mr
  cage_speed,         ///< of the rollers around the shaft
  centrifugal_force,  ///< of one roller
  estimate,           ///< rollers that are estimated from ratings
  motion,             ///< of the mass that swings on the curve of the bearing
  least_speed         ///< of an oil film
};
struct BearingReading {
  BearingAsks asks = BearingAsks::along;
  bool in_time     = false;  ///< a life at the speed of the shaft
  bool closed_form = false;  ///< between rigid rings, laminae in the place of finite elements
};
/// What a result of a bearing reads.  @param row  of row::bearing, row::rating or row::motion
BearingReading reading_of_bearing(const ResultRow &row);

/// What acts on a bearing beside a radial load.
struct LoadForm {
  bool tilts  = false;  ///< a tilt or a moment, for which the places of the rows are decisive
  bool pushes = false;  ///< an axial force or displacement, for which their arrangement is
  bool turns  = false;  ///< a speed at which the rollers press the cup by themselves
};
LoadForm form_of(const BearingLoad &load);

BearingInputs inputs_of_bearing(const RollerBearing &bearing, const BearingReading &reading = {},
                                const LoadForm &form = {});

/// A bearing under a load: the texts that the inputs of its results are joined from.
struct LoadedTexts {
  const RollerBearing &bearing;
  LoadForm form;
  std::string name;    ///< which bearing it is
  std::string radial;  ///< the radial load and all that it is made from
  std::string beside;  ///< what acts beside it
  std::string cage;    ///< where its cage stands
  std::string axial;   ///< the axial force, where it is imposed; empty: the ring keeps its place, or is moved
  std::string speed;   ///< of the shaft
  std::string mesh;    ///< of contact elements: the loads that they are made for
};
/// Inputs of one result.
std::string text_of_loaded_bearing(const LoadedTexts &on, const BearingReading &reading);

/// What the case takes the sizes of a bearing from, where it does not draw it.
std::string text_of_source(const RollerBearing &bearing);
}  // namespace mill
