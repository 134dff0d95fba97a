#include "app/cluster/cluster_stage.h"
#include "app/stages/contact/condensed_rolls.h"
#include "app/stages/contact/contact_model.h"
#include "core/case/cluster_variants.h"
#include "core/model/two_cylinders.h"
#include "fem/roll/contact_study.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
const ClusterRoll &roll_of_name(const ClusterStand &stand, const std::string &name)
{
  return *std::find_if(stand.rolls.begin(), stand.rolls.end(),
                       [&](const ClusterRoll &r) { return r.name == name; });
}

RoundBody body_of(const ClusterRoll &roll)
{
  RoundBody body;
  body.diameter       = roll.barrel_diameter;
  body.youngs_modulus = roll.youngs_modulus;
  body.poisson_ratio  = roll.poisson_ratio;
  return body;
}

// Two rolls squeezed between opposite contact lines, as Johnson's closed form has them: kind "two-cylinders".
cluster::ContactLaw computed_law(RunContext &run, const ClusterStand &stand, const ClusterContact &contact,
                                 const double largest)
{
  const auto dash          = contact.pair.find('-');
  const ClusterRoll &one   = roll_of_name(stand, contact.pair.substr(0, dash)),
                    &other = roll_of_name(stand, contact.pair.substr(dash + 1));
  const double length =
      std::isnan(contact.length) ? std::min(one.barrel_length, other.barrel_length) : contact.length;
  TwoCylinders pair;
  pair.steel           = stand.steel;
  pair.upper           = body_of(one);
  pair.lower           = body_of(other);
  pair.contact.loads   = {1e-3 * largest / length, 2 * largest / length};
  const auto condensed = [&](const std::string &name, const RoundBody &body) {
    const PlannedRoll plan = planned_cylinder(pair, body.diameter);
    return condensed_pair(run, "roll " + name, plan.geometry, plan.size, material_of(body, pair.steel),
                          {true, false, false, "another law than \"computed\" for the contact " + contact.pair});
  };
  const CondensedPair first = condensed(one.name, pair.upper), second = condensed(other.name, pair.lower);
  StageTimer timer(run, "contact " + contact.pair);
  const auto touch =
      fem::make_pair(contact.pair, *first.fine, fem::held_by_mirror(*first.fine), *second.fine,
                     fem::held_by_mirror(*second.fine), Eigen::VectorXd::Zero(first.fine->grid.n_z));
  const ContactCurve curve = fem::sweep(
      touch, fem::log_spaced(pair.contact.loads[0], pair.contact.loads[1], pair.contact.samples), run.progress);
  const Eigen::VectorXd load = length * curve.load;
  double misfit              = 0;
  const auto law = cluster::fitted_line_law(load.data(), curve.approach.data(), int(load.size()), length, misfit);
  run.progress.note(
      fmt::format("contact {}: approach over load by finite elements, d = q (S - T ln q) meets {} samples "
                  "within {:.1e}",
                  contact.pair, load.size(), misfit));
  if (misfit > 5e-3)
    run.warn({WarningId::contact_law, "contact " + contact.pair,
              fmt::format("the law of a line contact misses the computed samples by {:.2g} %", 100 * misfit)});
  return law;
}
}  // namespace

cluster::ComputedLaws computed_laws(RunContext &run, const ClusterStand &stand)
{
  double largest = 0;
  for (const ClusterPass &pass : stand.schedule)
    largest = std::max(largest, cluster_force(stand, pass).value);
  cluster::ComputedLaws laws;
  const auto add = [&](const ClusterStand &written) {
    const ClusterStand out = cluster::written_out(written);
    for (std::size_t i = 0; i < out.contacts.size(); ++i) {
      const ClusterContact &contact = out.contacts[i];
      if (contact.law != ClusterLaw::computed || laws.count(contact.pair))
        continue;
      // A mirror image is the same pair of diameters.
      const std::string &like = written.contacts[i].like;
      if (const auto original = laws.find(like); !like.empty() && original != laws.end())
        laws[contact.pair] = original->second;
      else
        laws[contact.pair] = computed_law(run, out, contact, largest);
    }
  };
  add(stand);
  for (const ClusterVariant &variant : stand.variants)
    add(with_variant(stand, variant));
  return laws;
}
}  // namespace mill
