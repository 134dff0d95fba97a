#include "app/kinds/mark_sources.h"
#include "app/review/case_review.h"
#include "app/run/run_kind.h"
#include "app/stages/bite/bite_stage.h"
#include "app/trace/closed_form_chain.h"
#include "app/trace/trace_key.h"
#include "core/model/bite_case.h"
#include "core/model/case.h"
#include <nlohmann/json.hpp>

namespace mill {
namespace {
std::optional<StandIn> bite_stand_in(const Case &the_case, const TraceKey &key,
                                     const std::vector<ClosedFormResult> &)
{
  return pass_of(key) ? strip_instead(std::get<BiteCase>(the_case.spec).strip, key) : std::nullopt;
}
}  // namespace

const RunKind &run_kind(const BiteCase &)
{
  static const RunKind kind = [] {
    RunKind k;
    k.verbs  = {Verb::run, Verb::stiffness};
    k.check  = check_bites;
    k.review = [](const Case &the_case, const std::string &) {
      CaseReview review;
      const auto &spec = std::get<BiteCase>(the_case.spec);
      for (const Pass &pass : spec.passes)
        if (auto warning =
                bite_without_theory(bite_of(spec.strip, pass, spec.roll_diameter, spec.steel), spec.bite, pass))
          review.said_by_run.push_back(std::move(*warning));
      return review;
    };
    k.stages = [](const Case &) -> std::vector<std::pair<std::string, double>> {
      return {{"bite, finite elements", 3}, {"bite, curves", 4}};
    };
    k.run = [](RunContext &run, Goal, const std::string &) {
      solve_bite_case(run, std::get<BiteCase>(run.the_case.spec));
    };
    k.mark_sources = [](const Case &the_case) { return mark_sources(std::get<BiteCase>(the_case.spec)); };
    k.describe     = [](const Case &the_case, nlohmann::ordered_json &manifest) {
      manifest["geometry"]["work_roll_diameter"] = std::get<BiteCase>(the_case.spec).roll_diameter;
    };
    k.trace = [](const Case &the_case, ClosedFormMemory &memory, const std::map<std::string, double> &) {
      return closed_form_bite_case(std::get<BiteCase>(the_case.spec), wanted_keys(memory, the_case.spec).get());
    };
    k.stand_in = bite_stand_in;
    return k;
  }();
  return kind;
}
}  // namespace mill
