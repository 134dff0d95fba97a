#pragma once
#include "core/case/fields.h"
#include "core/model/bearing_case.h"
#include "core/model/bite_setup.h"
#include "core/model/campbell.h"
#include "core/model/chatter.h"
#include "core/model/contact_settings.h"
#include "core/model/dynamics_settings.h"
#include "core/model/frame.h"
#include "core/model/frequency_response.h"
#include "core/model/housing.h"
#include "core/model/lumped.h"
#include "core/model/pass.h"
#include "core/model/roll.h"
#include "core/model/strip.h"
#include "core/model/two_cylinders.h"
#include <string>
#include <vector>

// Every parameter of the case files, one row each.
namespace mill {
inline constexpr Range any;  ///< every value is allowed

/// [work_roll]: drawn with its total length, stored with its neck length.
struct WorkRollInput : Roll {
  double total_length = 0;  ///< m
};

/// [[pass]]: peaks are kept in g by the program, read as accelerations here.
struct PassInput : Pass {
  std::array<double, 2> published_peak = {not_given, not_given};  ///< m/s2
  std::array<double, 2> measured_peak  = {not_given, not_given};  ///< m/s2
};

/// [model] of kind = "bearing": what of the loaded bearing's model it says again.
struct BearingModelInput {
  std::optional<OneRollerLaw> roller_law;
  std::optional<RingBodies> rings;
  int slices = 0;
};

/// [strip]: friction is a number, or a section of its own.
struct StripInput : Strip {
  double coulomb = not_given;  ///< -
};

/// [strip.flow_stress] and [strip.friction]: the law by its name.
struct FlowStressInput : FlowStress {
  std::string name = name_of(law);
};
struct FrictionInput : Friction {
  std::string name = name_of(law);
};

/// [work_roll] of kind = "bite".
struct BiteRollInput {
  double diameter = 0;  ///< m
};

/// [oil] of kind = "chatter": its part of the friction law, and where that was measured.
struct OilInput : Friction {
  std::array<double, 2> film_range = {not_given, not_given};  ///< m
};

/// The top of every case file.
struct CaseHead {
  int schema = 0;
  std::string kind, title, confirmed;
};

const std::vector<Field<CaseHead>> &head_rows();
const std::vector<Field<Material>> &steel_rows();
const std::vector<Field<WorkRollInput>> &work_roll_rows();
const std::vector<Field<Roll>> &backup_roll_rows();
const std::vector<Field<RollerBearing>> &bearing_rows();
const std::vector<Field<RollerBearing>> &bearing_catalogue_rows();  ///< the last of bearing_rows
const std::vector<Field<OilFilmBearing>> &oil_film_rows();          ///< of a [bearing.*] of type oil-film
const std::vector<Field<BearingLoad>> &bearing_load_rows();
const std::vector<Field<BearingModelInput>> &bearing_model_rows();
const std::vector<Field<BearingExcitation>> &bearing_motion_rows();
const std::vector<Field<Frame>> &frame_rows();
const std::vector<Field<MillHousing>> &housing_rows();
const std::vector<Field<Screwdown>> &screwdown_rows();
const std::vector<Field<StripInput>> &strip_rows();
const std::vector<Field<FrictionInput>> &friction_rows();
const std::vector<Field<BiteSetup>> &bite_rows();
const std::vector<Field<BiteRollInput>> &bite_roll_rows();
const std::vector<Field<PassInput>> &bite_pass_rows();
const std::vector<Field<FlowStressInput>> &flow_stress_rows();
const std::vector<Field<Material>> &chatter_steel_rows();
const std::vector<Field<StripInput>> &chatter_strip_rows();  ///< friction last
const std::vector<Field<OilInput>> &oil_rows();
const std::vector<Field<OilInput>> &oil_friction_rows();
const std::vector<Field<ChatterStand>> &chatter_stand_rows();  ///< of [stand] and [variant.NAME]
const std::vector<Field<StandSpan>> &stand_span_rows();        ///< [stand] of a four-high
const std::vector<Field<RollingCondition>> &condition_rows();
const std::vector<Field<ChatterAnalysis>> &chatter_analysis_rows();
const std::vector<Field<PassInput>> &pass_rows();
const std::vector<Field<ContactSettings>> &roll_contact_rows();        ///< four-high: loads are forces
const std::vector<Field<LineContactSettings>> &line_contact_rows();    ///< two-cylinders: loads per length
const std::vector<Field<SpaceContactSettings>> &space_contact_rows();  ///< two-cylinders in space: forces
const std::vector<Field<DynamicsSettings>> &dynamics_rows();
const std::vector<Field<DynamicsSettings>> &chain_dynamics_rows();  ///< of kind "lumped"
const std::vector<Field<ModelFiles>> &model_file_rows();            ///< [model] of kind "lumped"
const std::vector<Field<FrequencyResponseSettings>> &frequency_response_rows();
const std::vector<Field<CampbellSettings>> &campbell_rows();
const std::vector<Field<CampbellSettings>> &
chain_campbell_rows();  ///< of kind "lumped": with the sizes of the rolls
const std::vector<Field<DriveOrder>> &drive_order_rows();
/// [upper] and [lower] of kind two-cylinders; a plane (of `section`) needs no diameter.
const std::vector<Field<RoundBody>> &upper_body_rows();
const std::vector<Field<RoundBody>> &lower_body_rows();
std::vector<Field<RoundBody>> body_rows_for(const Section &section);

/// Rows of [given]; they share a reader of their own because a value may carry its source.
/// @param published  of [published], which may hold more than what could replace a computed value
const std::vector<Row> &given_rows(const std::string &kind, bool published = false);

/// Uncertainty of given values: one row KEY_tolerance for every quantity of `rows`.
std::vector<Row> tolerance_rows(const std::vector<Row> &rows);
bool is_tolerance(const std::string &key);
std::string tolerance_key(const std::string &key);  ///< "K1_tolerance" of "K1"

/// One section of a kind of case, as schema, template and reference need it.
struct SectionRows {
  enum class Repeat {
    once,
    named,  ///< [bearing.NAME], one example name
    list    ///< [[pass]]
  };
  std::string name;  ///< "work_roll", "strip.flow_stress", "bearing"; "" for the top level
  Repeat repeat;
  bool needed;  ///< false: the section may be left out
  std::string meaning;
  std::vector<Row> rows;
  std::string type = "";  ///< of the named ones, where sections of this name have several: "oil-film"; else empty
  /// The name under which notes of the template and names of a case are stored.
  const std::string &id() const
  {
    return type.empty() ? name : type;
  }
};
const std::vector<std::string> &case_kinds();  ///< those this version reads
const std::vector<SectionRows> &sections_of(const std::string &kind);
}  // namespace mill
