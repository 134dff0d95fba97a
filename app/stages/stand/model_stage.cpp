#include "app/stages/stand/model_stage.h"
#include "app/run/curve_files.h"
#include "app/stages/stand/mode_results.h"
#include "app/stages/stand/model_files.h"
#include "app/stages/stand/models_file.h"
#include "core/case/lumped_model_toml.h"
#include "core/case/provenance.h"
#include "core/model/dynamics_settings.h"
#include "core/numerics/mesh_pair.h"
#include "core/records/chain_number.h"
#include "core/records/csv.h"
#include "core/records/json_archive.h"
#include "core/records/result_names.h"
#include "reduce/stand/beam_stand.h"
#include "reduce/stand/component_stand.h"
#include "reduce/stand/kept_modes.h"
#include "reduce/stand/mass_breakdown.h"
#include "reduce/stand/masses_needed.h"
#include "reduce/stand/mode_names.h"
#include "reduce/stand/six_masses.h"
#include "reduce/stand/stand_errors.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace mill {
namespace {
constexpr int most_masses   = 20;
constexpr int beam_elements = 24;  // per span of a roll; half as many for the error estimate

// Modes are kept to twice the limit, as the components are.
reduce::StandWithModes with_modes_of(StandModel model, const double limit)
{
  reduce::StandWithModes s{std::move(model), {}};
  s.modes = reduce::stand_modes(s.model, 2 * limit);
  return s;
}

std::vector<std::string> keys_of(const LumpedModel &model)
{
  std::vector<std::string> keys;
  const auto add = [&](const Parameter &p) {
    for (const std::string &key : p.inputs)
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        keys.push_back(key);
  };
  std::for_each(model.M.begin(), model.M.end(), add);
  std::for_each(model.K.begin(), model.K.end(), add);
  return keys;
}

void add_frequencies(RunContext &run, const reduce::StandWithModes &s, const reduce::StandWithModes &other,
                     const Eigen::MatrixXd &mac, const reduce::FrequencyErrors &errors,
                     const reduce::LumpedStand &chain, const double limit, const GapState named)
{
  const auto pairs = reduce::pair_modes(mac, other.modes.frequency, s.modes.frequency);
  for (Eigen::Index i = 0; i < s.modes.frequency.size() && s.modes.frequency[i] <= limit; ++i) {
    Parameter f;
    f.value          = s.modes.frequency[i];
    f.unit           = "Hz";
    f.method         = title_of(s.model.name);
    f.at             = chain.model.at;
    f.error_estimate = s.modes.error_estimate[i] + errors.error[i];
    f.error_lacks    = errors.lacks[std::size_t(i)];
    f.inputs         = keys_of_models(*run.keys, chain);
    if (s.model.name == word_of(StandModelKind::craig_bampton))  // its work-roll chocks stand on their bearings
      f.inputs = joined(std::move(f.inputs), chain.model.Kzc[1].inputs, chain.model.Kzc[2].inputs);
    for (const reduce::ModePair &pair : pairs)
      if (pair.mode == i && pair.other >= 0) {
        f.checks.push_back({title_of(other.model.name), other.modes.frequency[pair.other],
                            fmt::format("modal assurance {:.3f}", pair.mac)});
        // Beams are the coarser theory: how far they are from the solid is what they are sure to.
        if (s.model.name == word_of(StandModelKind::beam))
          f.error_estimate += std::abs(other.modes.frequency[pair.other] / f.value - 1);
      }
    run.results.add(frequency_result(s.model, std::size_t(i), named), f);
  }
}

// Where the chain first fails: a mode without counterpart, or one it puts more than 5 % off.
std::string up_to_where(const StandModels &models, const double limit)
{
  const auto &f = models.craig_bampton.modes.frequency;
  double worst  = 0;
  for (const reduce::ModePair &pair : models.verdict.pairs) {
    const double error =
        pair.other < 0 ? 0 : std::abs(models.chain.modes.frequency[pair.other] / f[pair.mode] - 1);
    if (pair.other >= 0 && error <= 0.05) {
      worst = std::max(worst, error);
      continue;
    }
    const char *fails = pair.other < 0 ? "cannot show" : "put in a wrong place";
    return pair.mode == 0
               ? fmt::format("Six masses are not enough: the lowest mode, at {:.1f} Hz, they {}.", f[0], fails)
               : fmt::format(
                     "Below {:.1f} Hz six masses are enough (frequencies within {:.1f} %); the mode there is the "
                     "first they {}.",
                     f[pair.mode], 100 * worst, fails);
  }
  return fmt::format("Six masses are enough up to {:g} Hz (frequencies within {:.1f} %).", limit, 100 * worst);
}

// Given values that the chain has and the other models have not, and what those models take to be even.
void say_what_differs(RunContext &run, const FourHigh &stand)
{
  std::string only;
  for (const char *name : {"K2", "K6", "M2", "M3", "M4", "M5"})
    if (stand.given.count(name))
      only += (only.empty() ? "given." : ", given.") + std::string(name);
  if (!only.empty())
    run.warn({WarningId::given_in_chain_only, "", only + " replace numbers of the six masses only",
              "beams and finite elements keep what is drawn, so that the models are of different stands"});
  if (stand.given.count("K_ZW"))
    run.assume(
        "given.K_ZW stiffens the backup rolls of six masses and beams; the finite elements keep what is drawn");
  const double facing       = std::min(stand.work_roll.barrel_length, stand.backup_roll.barrel_length);
  const Parameter *touching = run.find("contact.upper.contact_length");
  if (touching && touching->value < 0.98 * facing)
    run.assume(
        fmt::format("beams and finite elements are joined by K3 and K5 spread evenly over the common barrel; the "
                    "rolls touch over {:.0f} of {:.0f} mm, which the bending modes of the work rolls feel",
                    1e3 * touching->value, 1e3 * facing));
  run.assume(
      "the models of the stand move vertically and alike on both sides of mid-length; rocking is not in them");
}

KeptModes kept_modes(const FourHigh &stand, const reduce::StandSprings &springs,
                     const reduce::StandComponents &components, const double limit)
{
  Eigen::Index all =
      std::max(components.work_roll.fixed_frequency.size(), components.backup_roll.fixed_frequency.size());
  if (components.housing)
    all = std::max(all, components.housing->fixed_frequency.size());
  KeptModes result;
  for (Eigen::Index k = 0; k < all; k = k == 0 ? 1 : 2 * k)
    result.kept.push_back(int(k));
  result.kept.push_back(int(all));
  std::vector<Eigen::VectorXd> frequencies;
  for (const int k : result.kept) {
    reduce::StandComponents few{reduce::with_modes(components.work_roll, k),
                                reduce::with_modes(components.backup_roll, k), std::nullopt};
    if (components.housing)
      few.housing = reduce::with_modes(*components.housing, k);
    frequencies.push_back(reduce::stand_modes(reduce::component_stand(stand, springs, few)).frequency);
  }
  const Eigen::VectorXd &best = frequencies.back();
  const Eigen::Index m        = std::upper_bound(best.begin(), best.end(), limit) - best.begin();
  result.frequency            = best.head(m);
  result.error.resize(Eigen::Index(frequencies.size()), m);
  for (std::size_t s = 0; s < frequencies.size(); ++s)
    result.error.row(Eigen::Index(s)) =
        frequencies[s].head(m).cwiseQuotient(result.frequency).transpose().array() -
        1;  // fewer are always stiffer
  return result;
}

// Share of a drawn housing's kinetic energy above its feet, by the masses and displacements of the chain.
double upper_share_of_housing(const FourHigh &stand, const reduce::LumpedStand &chain)
{
  if (!stand.housing.present())
    return not_given;
  const Frame &f     = stand.frame;
  const auto &u      = chain.flexibility;
  const double above = (f.upper_post_mass + f.upper_beam_mass) * u.frame_upper * u.frame_upper,
               below = (f.lower_post_mass + f.lower_beam_mass) * u.frame_lower * u.frame_lower;
  return above / (above + below);
}

void write_shapes(RunContext &run, const FourHigh &stand, const reduce::LumpedStand &chain,
                  const StandModel &model)
{
  const reduce::StandShapes fe = reduce::stand_shapes(model);
  const auto shape_at          = [](const reduce::RollShape &shape, const Eigen::VectorXd &x, const double kink) {
    return Eigen::VectorXd(x.unaryExpr([&](const double z) { return reduce::value_at(shape, z, kink); }));
  };
  Table work, backup;
  const Eigen::VectorXd &xw = chain.f1_upper.x, &xb = chain.f2_upper.x;
  const double end_work = stand.work_roll.barrel_length / 2, end_backup = stand.backup_roll.barrel_length / 2;
  work.add("x", "m", xw).add("f1_upper", "m/N", chain.f1_upper.value).add("f1_lower", "m/N", chain.f1_lower.value);
  work.add("f1_upper_fe", "m/N", shape_at(fe.f1_upper, xw, end_work))
      .add("f1_lower_fe", "m/N", shape_at(fe.f1_lower, xw, end_work));
  backup.add("x", "m", xb)
      .add("f2_upper", "m/N", chain.f2_upper.value)
      .add("f2_lower", "m/N", chain.f2_lower.value);
  backup.add("f2_upper_fe", "m/N", shape_at(fe.f2_upper, xb, end_backup));
  backup.add("f2_lower_fe", "m/N", shape_at(fe.f2_lower, xb, end_backup));
  write_curve(run, curve::shape_work_roll, "", work);
  write_curve(run, curve::shape_backup_roll, "", backup);
}

std::vector<std::string> answer(const StandModels &models, const std::vector<MassesRow> &needed,
                                const double limit)
{
  std::vector<std::string> sentences = models.verdict.sentences;
  const int enough                   = reduce::masses_enough(needed, 0.05);
  sentences.insert(sentences.begin(), up_to_where(models, limit));
  sentences.push_back(
      enough > 0
          ? fmt::format("{} masses at well-chosen places show every vertical mode below {:g} Hz within 5 %.",
                        enough, limit)
          : fmt::format("Even {} masses at the places looked at do not show every vertical mode below {:g} Hz "
                        "within 5 %; drive dynamics.model = \"craig-bampton\" instead.",
                        needed.empty() ? 6 : needed.back().masses, limit));
  return sentences;
}

ModelsRecord comparison(const FourHigh &stand, const reduce::LumpedStand &chain, const StandModels &models,
                        const ComponentSets &components, const reduce::FeMasses &masses)
{
  const double limit = stand.dynamics.frequency_limit;
  ModelsRecord record;
  record.frequency_limit = limit;
  record.at              = chain.model.at.text();
  record.driven          = word_of(stand.dynamics.model);
  record.masses_needed   = reduce::masses_needed(models.craig_bampton, limit, most_masses, &models.chain);
  record.answer          = answer(models, record.masses_needed, limit);
  record.models          = {
               compared_model(models.chain, "six masses", "chain of six masses and seven springs", limit, {}),
               compared_model(models.beam, "beams",
                              fmt::format("stepped Timoshenko beams, {} elements per span", beam_elements), limit,
                              reduce::in_chain(models.beam)),
               compared_model(models.craig_bampton, "finite elements",
                              fmt::format("work roll: {}; backup roll: {}{}", components.fine.work_roll.source,
                                          components.fine.backup_roll.source,
                                 components.fine.housing ? "; housing: " + components.fine.housing->source : ""),
                              limit, reduce::in_chain(models.craig_bampton))};
  record.pairs      = mode_partners(models);
  record.mac        = mac_table(models, limit);
  record.kept_modes = kept_modes(stand, reduce::stand_springs(stand, chain, true), components.fine, limit);
  record.breakdown  = reduce::chain_breakdown(stand, chain);
  for (auto &mass : reduce::model_breakdown(stand, models.craig_bampton.model, stand.dynamics.mass_reference))
    if (!stand.housing.present() || (mass.mass != word_of(ChainNumber::M1) &&
                                     mass.mass != word_of(ChainNumber::M6)))  // a housing is one body there
      record.breakdown.push_back(std::move(mass));
  record.routes = mass_routes(stand, chain, masses);
  return record;
}
}  // namespace

StandModels stand_models(const FourHigh &stand, const reduce::LumpedStand &chain, const ComponentSets &components)
{
  const double limit = stand.dynamics.frequency_limit;
  const auto springs = reduce::stand_springs(stand, chain), on_bearing = reduce::stand_springs(stand, chain, true);
  StandModels m;
  m.chain = chain_with_modes(chain.model, stand.dynamics);
  m.beam  = with_modes_of(reduce::beam_stand(stand, springs, beam_elements), limit);
  // Without a limit: what a coarser mesh makes of a mode just below it may lie above.
  const double all  = std::numeric_limits<double>::infinity();
  const auto beam_2 = with_modes_of(reduce::beam_stand(stand, springs, beam_elements / 2), all);
  reduce::estimate_errors(m.beam.modes, beam_2.modes);
  m.craig_bampton   = with_modes_of(reduce::component_stand(stand, on_bearing, components.fine), limit);
  const auto coarse = with_modes_of(reduce::component_stand(stand, on_bearing, components.coarse), all);
  // The residual of the modes left out, and what a coarser mesh moves; of a mode that it lacks that is not known.
  auto &error = m.craig_bampton.modes.error_estimate;
  for (Eigen::Index i = 0; i < error.size(); ++i)
    error[i] += i < coarse.modes.frequency.size()
                    ? mesh_pair_error(m.craig_bampton.modes.frequency[i], coarse.modes.frequency[i],
                                      roll_mesh_gain(components))
                    : not_given;
  const auto names      = reduce::common_names({&m.craig_bampton, &m.beam, &m.chain},
                                               {{0, 1, reduce::mac_between(m.craig_bampton, m.beam)},
                                                {0, 2, reduce::mac_with_chain(m.craig_bampton, m.chain)},
                                                {1, 2, reduce::mac_with_chain(m.beam, m.chain)}});
  m.craig_bampton.names = names[0];
  m.beam.names          = names[1];
  m.chain.names         = names[2];
  m.verdict             = reduce::chain_verdict(m.craig_bampton, m.chain, limit, "the finite-element model");
  return m;
}

StandStates stand_states(RunContext &run, const FourHigh &stand, const reduce::LumpedStand &chain,
                         const ComponentSets &components, const bool driven_only)
{
  StandStates states;
  const auto build = [&](StandInState &state, const GapState gap) {
    state.stand = stand;
    if (driven_state(stand.dynamics) != gap)
      state.stand.dynamics = in_state(stand.dynamics, gap);
    return [&](RunContext &) { state.models = stand_models(state.stand, chain, components); };
  };
  std::vector<IndependentStage> both{build(states.open, GapState::open)};
  if (knows_strip(chain.model) && (!driven_only || driven_state(stand.dynamics) == GapState::rolling))
    both.push_back(build(states.rolling.emplace(), GapState::rolling));
  run_side_by_side(run, std::move(both));
  return states;
}

reduce::FeMasses add_fe_masses(LumpedModel &chain, const FourHigh &stand, const StandModels &models)
{
  const auto fe = reduce::fe_masses(stand, models.craig_bampton.model, stand.dynamics.mass_reference);
  for (std::size_t i = 0; i < 4; ++i) {
    Parameter &p = chain.M[i + 1];
    if (p.source != Source::computed)
      continue;
    if (stand.dynamics.mass_source == MassSource::fe) {
      p.checks.push_back(check(CheckId::closed_form_mass, p.value, p.method));
      p.checks.push_back(check(CheckId::fe_integral_mass, fe.integral[i]));
      p.method = "kinetic energy of all points of the finite-element shape (22.15)";
      p.error_estimate += std::abs(fe.integral[i] / fe.solid[i] - 1);
      p.value = fe.solid[i];
    } else {
      p.error_estimate += std::abs(fe.solid[i] / p.value - 1);
      // First, because the page shows the first check next to the number.
      p.checks.insert(p.checks.begin(), {check(CheckId::fe_solid_mass, fe.solid[i], "with what turns and bulges"),
                                         check(CheckId::fe_integral_mass, fe.integral[i])});
    }
  }
  return fe;
}

namespace {
// Puts a model of the stand together again from other numbers.
reduce::StandBuilder builder_of(const reduce::StandWithModes &s, const ComponentSets &components)
{
  if (s.model.name == word_of(StandModelKind::beam))
    return [](const FourHigh &stand, const reduce::StandSprings &springs) {
      return reduce::beam_stand(stand, springs, beam_elements);
    };
  return [&](const FourHigh &stand, const reduce::StandSprings &springs) {
    return reduce::component_stand(stand, springs, components.fine);
  };
}
}  // namespace

reduce::StandWithModes with_connection_errors(reduce::StandWithModes s, const FourHigh &stand,
                                              const reduce::LumpedStand &chain, const ComponentSets &components)
{
  const bool chock_on_bearing = s.model.name == word_of(StandModelKind::craig_bampton);
  reduce::set_connection_errors(s.model, stand, reduce::stand_springs(stand, chain, chock_on_bearing), chain,
                                builder_of(s, components));
  return s;
}

namespace {
// Frequencies of the finite elements, and of the beams in the state that is named.
void add_frequencies_of(RunContext &run, const StandInState &state, const GapState named,
                        const reduce::LumpedStand &chain, const ComponentSets &components)
{
  const auto &[stand, models] = state;
  const double limit          = stand.dynamics.frequency_limit;
  const Eigen::MatrixXd mac   = reduce::mac_between(models.craig_bampton, models.beam);
  if (named == GapState::rolling)
    add_frequencies(run, models.beam, models.craig_bampton, mac,
                    reduce::frequency_errors(models.beam, stand, reduce::stand_springs(stand, chain), chain,
                                             builder_of(models.beam, components)),
                    chain, limit, named);
  add_frequencies(run, models.craig_bampton, models.beam, mac.transpose(),
                  reduce::frequency_errors(models.craig_bampton, stand, reduce::stand_springs(stand, chain, true),
                                           chain, builder_of(models.craig_bampton, components)),
                  chain, limit, named);
  for (const auto *model : {&models.beam, &models.craig_bampton})
    write_mode_table(run, *model, named);
}
}  // namespace

void compare_models(RunContext &run, const StandStates &states, const StandInState &driven,
                    const reduce::LumpedStand &chain, const ComponentSets &components,
                    const reduce::FeMasses &masses)
{
  StageTimer timer(run, "models");
  const auto &[stand, models] = driven;
  say_what_differs(run, stand);
  write_shapes(run, stand, chain, models.craig_bampton.model);
  write_roll_shapes(run, stand, models.craig_bampton, components.fine.work_roll, components.fine.backup_roll);
  write_model_files(run, stand, models.chain, chain.model);
  for (const auto *model : {&models.beam, &models.craig_bampton})
    write_model_files(run, stand, with_connection_errors(*model, stand, chain, components), chain.model);
  add_frequencies_of(run, states.named(), GapState::rolling, chain, components);
  if (states.rolling)
    add_frequencies_of(run, states.open, GapState::open, chain, components);
  const auto riders = reduce::riders_of(stand);
  for (const auto *model : {&models.beam, &models.craig_bampton}) {
    const auto six = reduce::six_masses(model->model, riders, stand.dynamics.mass_reference,
                                        upper_share_of_housing(stand, chain));
    const auto chain_of_six =
        reduce::with_six_masses(chain.model, six, std::string("static shape of ") + title_of(model->model.name));
    run.out.write("lumped_model-six-of-" + model->model.name + ".toml",
                  lumped_model_toml(chain_of_six, run.the_case, run.out.path()));
  }
  run.out.write("curves/models.json", json_of_record(comparison(states.named().stand, chain, states.named().models,
                                                                components, masses)));
}

KeyList keys_of_models(MovingKeys &keys, const reduce::LumpedStand &chain)
{
  return joined(keys_of(chain.model), detailed_model_keys(keys));
}

std::vector<reduce::ModalSensitivity> inputs_of_modes(const FourHigh &stand, const reduce::LumpedStand &chain,
                                                      const StandModels &models, const ComponentSets &components)
{
  return reduce::modal_sensitivities(models.craig_bampton, stand, reduce::stand_springs(stand, chain, true), chain,
                                     builder_of(models.craig_bampton, components));
}

namespace {
void add_checks_of_state(RunContext &run, const StandModels &models, const GapState named)
{
  const auto pairs = reduce::pair_modes(reduce::mac_with_chain(models.craig_bampton, models.chain),
                                        models.craig_bampton.modes.frequency, models.chain.modes.frequency);
  for (auto &[name, p] : run.results.values)
    for (const reduce::ModePair &pair : pairs)
      if (pair.other >= 0 && name == frequency_result(models.chain.model, std::size_t(pair.mode), named).text()) {
        const double fe = models.craig_bampton.modes.frequency[pair.other];
        p.checks.insert(p.checks.begin(), Check{"rolls as reduced finite elements", fe,
                                                fmt::format("modal assurance {:.3f}", pair.mac)});
        p.error_estimate += std::abs(fe / p.value - 1);
      }
}
}  // namespace

void add_model_checks(RunContext &run, const StandStates &states)
{
  add_checks_of_state(run, states.named().models, GapState::rolling);
  if (states.rolling)
    add_checks_of_state(run, states.open.models, GapState::open);
}

void add_modes_by_name(RunContext &run, const StandStates &states, const reduce::LumpedStand &chain,
                       const ComponentSets &components)
{
  for (const StandInState *state : {&states.named(), &states.open}) {
    const StandModels &m = state->models;
    const auto uncertain = inputs_of_modes(state->stand, chain, m, components);
    add_named_modes(run, {states.name_of(*state),
                          {&m.craig_bampton, &m.beam, &m.chain},
                          uncertain,
                          state->stand.dynamics.frequency_limit});
    if (!states.rolling)
      return;
  }
}

const reduce::StandWithModes *driven(const StandModels &models, const DynamicsSettings &settings)
{
  if (settings.model == StandModelKind::beam)
    return &models.beam;
  return settings.model == StandModelKind::craig_bampton ? &models.craig_bampton : nullptr;
}
}  // namespace mill
