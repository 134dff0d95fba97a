#include "tests/support/unit_client.h"
#include "core/base/require.h"
#include "dynamics/fmu/model_text.h"
#include "dynamics/fmu/runtime/variables.h"
#include "dynamics/fmu/unit_archive.h"
#include "dynamics/response/modes.h"
#include "tests/support/published_stand.h"
#include <climits>
#include <cmath>

using namespace mill;

SampleStand sample_stand(const ForceMeaning force_meaning, const double damping, const double gap_damper)
{
  LumpedModel lumped = published_stand();
  lumped.K[2].value = lumped.K[4].value = 4.02e10;
  lumped.C.value                        = gap_damper > 0 ? gap_damper : not_given;
  SampleStand stand{dynamics::mill_model(lumped, settings(force_meaning, damping)), {}};
  const auto &chain         = stand.chain;
  fmu::ExportedModel &model = stand.model;
  model.identifier          = "sample_stand";
  model.title               = "sample & <stand>";
  model.origin              = "case sample";
  model.force_meaning       = force_meaning;
  model.method              = "chain of six masses";
  model.program             = "millstand test";
  model.step                = 5e-5;
  fmu::ModelData &data      = model.data;
  data.runtime              = fmu::runtime_version;
  data.kind                 = fmu::StandKind::chain;
  data.points               = {"upper_frame",     "upper_backup_roll", "upper_work_roll",
                               "lower_work_roll", "lower_backup_roll", "lower_frame"};
  data.modal_damping        = damping;
  data.gap_damper           = force_meaning == ForceMeaning::measured ? 0 : gap_damper;
  data.mean_force           = 976e3;
  data.share_from_statics   = force_meaning == ForceMeaning::published;
  data.load_cell_spring     = 6;
  for (Eigen::Index i = 0; i < 6; ++i) {
    data.mass.push_back(chain.M[i]);
    data.bite_row.push_back(chain.b[i]);
  }
  for (const auto &spring : chain.springs)
    data.springs.push_back({spring.name, spring.from, spring.to, spring.stiffness, spring.name == "K4"});
  data.guid = fmu::identity_of(model);
  return stand;
}

fmu::ExportedModel in_modes(const SampleStand &stand)
{
  fmu::ExportedModel model   = stand.model;
  fmu::ModelData &data       = model.data;
  const auto modes           = dynamics::modes(stand.chain);
  const Eigen::VectorXd bite = modes.shape.transpose() * stand.chain.b;
  const Eigen::VectorXd cell = modes.shape.transpose() * stand.chain.load_cell;
  data.kind                  = fmu::StandKind::modal;
  data.mass.clear(), data.springs.clear(), data.bite_row.clear();
  for (Eigen::Index k = 0; k < 6; ++k) {
    data.frequency.push_back(modes.frequency[k]);
    data.bite_mode.push_back(bite[k]);
    data.load_cell_mode.push_back(cell[k]);
    for (Eigen::Index j = 0; j < 6; ++j)
      data.shape.push_back(modes.shape(k, j));
  }
  data.load_cell_share    = stand.chain.load_cell_share;
  data.share_from_statics = false;
  data.guid               = fmu::identity_of(model);
  return model;
}

ForceRecord sample_force(const Eigen::Index n, const double spacing)
{
  ForceRecord force{Eigen::VectorXd(n), Eigen::VectorXd(n), {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = double(i) * spacing;
    force.time[i]  = t;
    force.force[i] = 976e3 + 3e3 * std::sin(2 * M_PI * 39 * t) + 2e3 * std::sin(2 * M_PI * 610 * t + 1);
  }
  return force;
}

void carry(fmu::ExportedModel &model, const ForceRecord &force)
{
  model.series          = force;
  model.data.has_series = true;
  model.data.mean_force = force.force.mean();
  model.data.guid       = fmu::identity_of(model);
}

unsigned reference_of(const fmu::ExportedModel &model, const std::string &name)
{
  const auto all = fmu::variables_of(model.data);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].name == name)
      return unsigned(i);
  require(false, "no variable " + name);
  return 0;
}

namespace {
std::string taken(std::string &text)
{
  std::string out;
  std::swap(out, text);
  return out;
}

void note(void *client, fmi2String, fmi2Status, fmi2String category, fmi2String message, ...)
{
  static_cast<Client2 *>(client)->messages += std::string(message) + "\n";
  static_cast<Client2 *>(client)->categories += std::string(category) + "\n";
}

void note_3(fmi3InstanceEnvironment client, fmi3Status, fmi3String, fmi3String message)
{
  static_cast<Client3 *>(client)->messages += std::string(message) + "\n";
}

void give_force(fmi3InstanceEnvironment environment, fmi3Float64, fmi3Boolean wanted, fmi3Boolean, fmi3Boolean,
                fmi3Boolean, fmi3Boolean *, fmi3Float64 *)
{
  auto &client         = *static_cast<Client3 *>(environment);
  const unsigned force = 1;
  if (wanted)
    FMI3(client, SetFloat64)(client.c, &force, 1, &client.force_at_end, 1);
}
}  // namespace

Client2::Client2(const fmu::ExportedModel &of, const bool logging)
    : Client2(std::make_shared<fmu::UnpackedUnit>(fmu::unit_archive(of, 2), of.identifier, 2), of, of.data.guid,
              "", logging)
{
}

Client2::Client2(std::shared_ptr<fmu::UnpackedUnit> of, const fmu::ExportedModel &m, const std::string &guid,
                 const std::string &location, const bool logging)
    : unit(std::move(of)), model(m), callbacks{note, nullptr, nullptr, nullptr, this}
{
  const std::string from = location.empty() ? "file://" + unit->resources() : location;
  c = FMI2(*this, Instantiate)("one", fmi2CoSimulation, guid.c_str(), from.c_str(), &callbacks, 0, logging);
}

Client2::~Client2()
{
  FMI2(*this, FreeInstance)(c);
}

int Client2::set(const std::string &name, const double value)
{
  const unsigned vr = at(name);
  return FMI2(*this, SetReal)(c, &vr, 1, &value);
}

double Client2::get(const std::string &name)
{
  const unsigned vr = at(name);
  double value      = not_given;
  return FMI2(*this, GetReal)(c, &vr, 1, &value) == fmi2OK ? value : not_given;
}

int Client2::whole(const std::string &name)
{
  const unsigned vr = at(name);
  int value         = INT_MIN;
  return FMI2(*this, GetInteger)(c, &vr, 1, &value) == fmi2OK ? value : INT_MIN;
}

int Client2::choose(const std::string &name, const bool value)
{
  const unsigned vr = at(name);
  const int truth   = value;
  return FMI2(*this, SetBoolean)(c, &vr, 1, &truth);
}

int Client2::slope(const double value)
{
  const unsigned vr = 1;
  const int order   = 1;
  return FMI2(*this, SetRealInputDerivatives)(c, &vr, 1, &order, &value);
}

int Client2::start(const double force, const double begin, const double stop)
{
  int worst = FMI2(*this, SetupExperiment)(c, 0, 0, begin, stop >= 0, stop);
  worst     = std::max<int>(worst, FMI2(*this, EnterInitializationMode)(c));
  worst     = std::max(worst, set("F_roll", force));
  return std::max<int>(worst, FMI2(*this, ExitInitializationMode)(c));
}

int Client2::step(const double from, const double length)
{
  return FMI2(*this, DoStep)(c, from, length, 1);
}

std::string Client2::logged()
{
  return taken(messages);
}

Client3::Client3(const fmu::ExportedModel &of, const bool asks_for_force, const bool logging)
    : Client3(std::make_shared<fmu::UnpackedUnit>(fmu::unit_archive(of, 3), of.identifier, 3), of, asks_for_force,
              logging)
{
}

Client3::Client3(std::shared_ptr<fmu::UnpackedUnit> made, const fmu::ExportedModel &of, const bool asks_for_force,
                 const bool logging)
    : unit(std::move(made)), model(of)
{
  const unsigned force = 1;
  c = FMI3(*this, InstantiateCoSimulation)("one", of.data.guid.c_str(), unit->resources().c_str(), false, logging,
                                           false, false, &force, asks_for_force ? 1 : 0, this, note_3, give_force);
}

Client3::~Client3()
{
  FMI3(*this, FreeInstance)(c);
}

int Client3::set(const std::string &name, const double value)
{
  const unsigned vr = at(name);
  return FMI3(*this, SetFloat64)(c, &vr, 1, &value, 1);
}

double Client3::get(const std::string &name)
{
  const unsigned vr = at(name);
  double value      = not_given;
  return FMI3(*this, GetFloat64)(c, &vr, 1, &value, 1) == fmi3OK ? value : not_given;
}

int Client3::start(const double force, const double begin)
{
  int worst = FMI3(*this, EnterInitializationMode)(c, false, 0, begin, false, 0);
  worst     = std::max(worst, set("F_roll", force));
  return std::max<int>(worst, FMI3(*this, ExitInitializationMode)(c));
}

int Client3::whole(const std::string &name)
{
  const unsigned vr = at(name);
  fmi3Int32 value   = INT_MIN;
  return FMI3(*this, GetInt32)(c, &vr, 1, &value, 1) == fmi3OK ? value : INT_MIN;
}

int Client3::step(const double from, const double length)
{
  bool event = true;
  terminated = early = true;
  last_time          = not_given;
  const int status   = FMI3(*this, DoStep)(c, from, length, true, &event, &terminated, &early, &last_time);
  if (event || early)
    return 99;
  return status == 0 && !terminated && last_time != from + length ? 98 : status;
}

std::string Client3::logged()
{
  return taken(messages);
}
