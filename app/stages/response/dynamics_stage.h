#pragma once
#include "app/run/run_context.h"
#include "core/base/warning.h"
#include "core/case/provenance.h"
#include "core/model/dynamics_settings.h"
#include "core/model/lumped_model.h"
#include "core/model/pass.h"
#include "core/records/records.h"
#include "dynamics/response/modes.h"
#include "dynamics/response/response.h"
#include "reduce/stand/stand_comparison.h"
#include <memory>
#include <optional>
#include <vector>

namespace mill {
/// Force record of a pass: its file, or the synthetic noise its keys describe.
ForceRecord force_of(const Pass &pass);

/// The measured record of a pass, in the times of its force where both have dates.
/// @throws InputError as twin::read_measured()
MeasuredRecord measured_of(const Pass &pass, const ForceRecord &force);

/// N: the working load of a pass, as given, or the mean of its record.
double working_load(const Pass &pass, const ForceRecord &force);

/// A sentence where the load of a pass is more than a twentieth off the mean of its record; else empty.
std::optional<Warning> load_against_record(const Pass &pass, std::size_t p, double mean);

bool has_force(const Pass &pass);  ///< a record, or a range to make one in

/// Vertical modes of the chain, and which half of the stand each moves.
struct ChainModes {
  dynamics::MillModel chain;
  dynamics::Modes modes;
  std::vector<Half> half;  ///< (modes)
};
ChainModes chain_modes(const LumpedModel &model, const DynamicsSettings &settings);

/// Modes of the rolls on their bearings along the pass line, and which roll each moves most; empty where no
/// bearing is known.
struct HorizontalModes {
  dynamics::MillModel rolls;
  dynamics::Modes modes;
  std::vector<std::string> mover;  ///< (modes) what moves most: "chocks of the upper work roll"
  std::vector<RollPlace> roll;     ///< (modes) the roll that it is or belongs to
};
/// @param chock_seat  N/m, of each work roll, both sides; NaN: rigid
/// @param chock_mass  kg, both chocks of the upper and of the lower work roll
HorizontalModes horizontal_modes(const LumpedModel &model, double chock_seat,
                                 const std::array<double, 2> &chock_mass);

/// Natural frequencies and shapes of the chain: f1.. of the rolling state and open.f1.. of the open one (f1..
/// where the strip is not known), fh1.., curves/modes*.csv and curves/poles.csv of the first.
void add_modes(RunContext &run, const LumpedModel &model, const DynamicsSettings &settings, double chock_seat,
               std::array<double, 2> chock_mass);

struct CurveDrive;

/// A model as a pass drives it, with what is known of it.
struct PassModel {
  dynamics::DrivenModel driven;
  std::string method;             ///< "six-mass chain"
  double highest_mode = 0;        ///< Hz
  std::array<KeyList, 2> inputs;  ///< keys behind the motion of the upper and of the lower work roll
  std::vector<double> missing;    ///< Hz, modes of the stand that it cannot show
  double limit = not_given;       ///< Hz, above which its modes are not trusted; NaN: not known
  std::shared_ptr<const CurveDrive> curves = nullptr;  ///< of its contacts; null: the linear model alone
  KeyList of_pass                          = {};       ///< keys of the force of its pass, and of how it drives
};
PassModel pass_model(const LumpedModel &model, const DynamicsSettings &settings);
/// @param chain  the lumped model of the same stand
PassModel pass_model(const reduce::StandWithModes &stand, const LumpedModel &chain,
                     const DynamicsSettings &settings);

/// The modes in which a detailed stand is driven: up to twice the frequency limit.
dynamics::ModalModel driven_modes(const reduce::StandWithModes &stand, const LumpedModel &chain,
                                  const DynamicsSettings &settings);

/// Drives the model with the force of a pass, on the curves of its contacts where it has them:
/// response/<pass>*.csv, peaks and rms compared with published and measured ones.
void simulate_pass(RunContext &run, const PassModel &model, const DynamicsSettings &settings, const Pass &pass,
                   const ForceRecord &force);
}  // namespace mill
