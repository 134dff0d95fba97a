#include "app/verbs/roll_pair.h"
#include "app/run/scratch_folder.h"
#include "app/stages/contact/contact_stage.h"
#include "app/stages/response/dynamics_stage.h"
#include "core/model/case.h"
#include "core/records/contact_name.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
const FourHigh &stand_with_rolls(const Case &the_case)
{
  if (const auto *stand = std::get_if<FourHigh>(&the_case.spec))
    return *stand;
  throw InputError("kind = \"" + the_case.kind + "\" (" + the_case.path +
                   ") has no pair of rolls to solve; kind = \"four-high\" has");
}

// The range that a run of the case sweeps: the same condensed rolls serve both.
double largest_of_run(const FourHigh &stand, const std::string &name, const ContactSettings &settings)
{
  std::vector<double> loads;
  for (const Pass &pass : stand.passes)
    loads.push_back(working_load(pass, has_force(pass) ? force_of(pass) : ForceRecord()));
  return swept_range(name, settings, loads)[1];
}

bool touches_edge(const fem::ContactPair &pair, const std::vector<char> &active)
{
  for (int k = 0; k < pair.grid.n_z; ++k)
    if (active[std::size_t(k) * pair.grid.n_x + pair.grid.n_x - 1])
      return true;
  return false;
}

double given_or(const double value, const double otherwise)
{
  return std::isnan(value) ? otherwise : value;
}
}  // namespace

struct RollPair::Implementation {
  std::shared_ptr<const Case> the_case;
  FourHigh stand;  // with the crowns that the model has at present
  std::string name;
  double largest = 0;
  std::string cache;
  int threads = 1;
  ContactModel model;
  struct Profile {
    Eigen::VectorXd gap, drop;  // m
  };
  std::array<Profile, 2> as_condensed;  // of mirrored and in_stand
  std::mutex access;

  const ContactSettings &settings() const
  {
    return is_contact(name, ContactName::lower) ? stand.lower_contact : stand.upper_contact;
  }

  // Rolls with these crowns, meshed for the largest load.
  void condense(const Progress &progress)
  {
    const ScratchFolder scratch("millstand-pair", true);
    const OutputDir out(scratch.path(), *the_case, true, "pair");
    RunContext run{*the_case, out, cache, false};
    run.threads  = threads;
    run.progress = progress;
    model        = contact_model(run, stand, name, settings(), largest);
    as_condensed = {{{model.mirrored.problem.initial_gap, model.mirrored.drop},
                     {model.in_stand.problem.initial_gap, model.in_stand.drop}}};
  }

  void take_crowns(const PairQuestion &question)
  {
    const FourHigh &drawn = std::get<FourHigh>(the_case->spec);
    const double backup   = given_or(question.crown, drawn.backup_roll.crown),
                 work     = given_or(question.work_crown, drawn.work_roll.crown);
    if (backup == stand.backup_roll.crown && work == stand.work_roll.crown)
      return;
    if (stand.work_roll.axial_shift != 0)
      throw InputError(
          "the crowns of shifted rolls (work_roll.axial_shift) are changed in the case; a pair of rolls "
          "keeps theirs");
    stand.backup_roll.crown = backup;
    stand.work_roll.crown   = work;
    fem::ContactPair *const pairs[]{&model.mirrored, &model.in_stand};
    for (std::size_t i = 0; i < as_condensed.size(); ++i) {
      // From the gap of the condensed pair, so that an answer does not depend on the questions before it.
      pairs[i]->problem.initial_gap = as_condensed[i].gap;
      pairs[i]->drop                = as_condensed[i].drop;
      fem::change_profiles(
          *pairs[i],
          profile_drop(stand, settings(), is_contact(name, ContactName::lower) ? -1 : 1, pairs[i]->grid.z));
    }
  }

  const fem::ContactPair &pair(const PairQuestion &question) const
  {
    return question.in_stand ? model.in_stand : model.mirrored;
  }
};

RollPair::RollPair(std::shared_ptr<const Case> of, std::string name, const double largest, std::string cache,
                   const int threads, const Progress &progress)
    : implementation(std::make_unique<Implementation>())
{
  if (!is_of_stand(name))
    throw InputError("the pairs of rolls of a stand are \"upper\" and \"lower\", not \"" + name + "\"");
  implementation->stand    = stand_with_rolls(*of);
  implementation->the_case = std::move(of);
  implementation->name     = std::move(name);
  implementation->largest =
      given_or(largest, largest_of_run(implementation->stand, implementation->name, implementation->settings()));
  implementation->cache   = std::move(cache);
  implementation->threads = threads;
  if (!(implementation->largest > 0))
    throw InputError("the largest force of a pair of rolls must be above 0 kN");
  implementation->condense(progress);
}

RollPair::~RollPair() = default;

double RollPair::largest_load() const
{
  return implementation->largest;
}

PairState RollPair::solve(const PairQuestion &question)
{
  if (!(question.load > 0))
    throw InputError(fmt::format("force = {} must be above 0 kN", in_kN(question.load)));
  if (question.load > implementation->largest)
    throw InputError(fmt::format("force = {} is above the {} that the rolls are meshed for; make the pair with a "
                                 "larger largest force",
                                 in_kN(question.load), in_kN(implementation->largest)));
  const std::lock_guard lock(implementation->access);
  implementation->take_crowns(question);
  fem::ContactPoint point = fem::solve_load(implementation->pair(question), question.load);
  if (touches_edge(implementation->pair(question), point.state.active)) {
    implementation->condense({});
    point = fem::solve_load(implementation->pair(question), question.load);
  }
  const fem::ContactPair &pair = implementation->pair(question);
  PairState state;
  state.load         = point.load;
  state.approach     = point.approach;
  state.tangent      = point.tangent;
  state.secant       = point.load / point.approach;
  state.profile      = fem::barrel_profile(pair, point);
  state.touching     = point.state.active;
  state.nodes_across = pair.grid.n_x;
  state.reference    = pair.reference;
  return state;
}
}  // namespace mill
