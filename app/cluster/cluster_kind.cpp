#include "app/cluster/cluster_bite.h"
#include "app/cluster/cluster_chatter.h"
#include "app/review/case_review.h"
#include "app/run/kind_rolls.h"
#include "app/run/run_kind.h"
#include "app/trace/closed_form_parts.h"
#include "core/case/fields.h"
#include "core/model/case.h"
#include "core/model/cluster.h"
#include "dynamics/marks/marks.h"
#include <algorithm>
#include <nlohmann/json.hpp>

namespace mill {
namespace {
const ClusterStand &stand_of(const Case &the_case)
{
  return *std::get<ClusterCase>(the_case.spec).stand;
}

}  // namespace

const RunKind &cluster_kind()
{
  static const RunKind kind = [] {
    RunKind k;
    k.verbs  = {Verb::run, Verb::stiffness, Verb::modes, Verb::chatter, Verb::simulate};
    k.check  = check_cluster;
    k.review = [](const Case &the_case, const std::string &) {
      CaseReview review;
      const ClusterStand &stand = stand_of(the_case);
      for (std::size_t p = 0; p < stand.schedule.size(); ++p)
        if (const std::string missing = missing_of_chatter(stand, p); !missing.empty())
          review_speed(stand.schedule[p], split(missing, ", "), review);
      return review;
    };
    k.driven = driven_cluster;
    k.stages = [](const Case &the_case) -> std::vector<std::pair<std::string, double>> {
      std::vector<std::pair<std::string, double>> stages;
      for (const ClusterContact &c : stand_of(the_case).contacts)
        if (c.law == ClusterLaw::computed && c.like.empty()) {
          stages.emplace_back("condensation", 5);
          stages.emplace_back("contact " + c.pair, 1);
        }
      stages.emplace_back("stack", 2);
      return stages;
    };
    k.run = [](RunContext &run, const Goal goal, const std::string &) {
      solve_cluster(run, stand_of(run.the_case), goal);
    };
    k.mark_sources = [](const Case &the_case) {
      dynamics::MarkSources sources;
      const ClusterStand &stand = stand_of(the_case);
      for (std::size_t i = 0; i < stand.rolls.size(); ++i)
        sources.rolls.push_back(mark_roll(stand.rolls[i].name, i, stand.rolls[i].barrel_diameter));
      if (stand.response.loss_factor > 0)
        sources.damping = 0.5 * stand.response.loss_factor;  // of a mode, at its resonance
      return sources;
    };
    k.describe = [](const Case &the_case, nlohmann::ordered_json &manifest) {
      manifest["geometry"] = nlohmann::ordered_json::object();
      for (const ClusterRoll &roll : stand_of(the_case).rolls)
        describe_roll(manifest, roll.name, roll.barrel_diameter);
    };
    k.trace = [](const Case &the_case, ClosedFormMemory &, const std::map<std::string, double> &) {
      return closed_form_cluster(the_case);
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
