#include "app/cluster/cluster_results.h"
#include "core/records/cluster_names.h"
#include "core/records/rows_of_cluster.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
ClusterFitRecord fit_record(const ClusterStand &, const ClusterVariant &variant, const cluster::StackFit &fit)
{
  ClusterFitRecord r;
  r.variant = fit.variant;
  r.pass    = fit.pass;
  for (const std::string &set : variant.set)
    r.set += (r.set.empty() ? "" : "; ") + set;
  for (const cluster::FittedNumber &n : fit.numbers)
    r.numbers.push_back({n.key, n.start, n.value, n.interval});
  for (const cluster::MatchedFrequency &f : fit.frequencies)
    r.frequencies.push_back({f.mode, f.wanted, f.computed, f.fitted});
  r.correlation   = fit.correlation;
  r.rms_fitted    = fit.rms_fitted;
  r.rms_predicted = fit.rms_predicted;
  r.converged     = fit.converged;
  r.undetermined  = fit.undetermined;
  r.refused       = fit.refused;
  return r;
}

void add_fit_results(RunContext &run, const cluster::StackFit &fit, const KeyList &keys)
{
  int matched = 0;
  for (const cluster::MatchedFrequency &f : fit.frequencies)
    matched += f.fitted;
  for (const cluster::FittedNumber &n : fit.numbers) {
    Parameter p;
    p.value  = n.value;
    p.unit   = unit_of_cluster_key(n.key);
    p.method = fmt::format("fit of {} number{} to {} frequencies (38.25)", fit.numbers.size(),
                           fit.numbers.size() == 1 ? "" : "s", matched);
    p.at     = fit.pass;
    p.inputs = keys;
    if (std::isnan(n.interval))
      p.error_lacks = {"variant.modes"};
    else
      p.error_estimate = n.interval / std::abs(n.value);
    p.checks.push_back({"start of the fit", n.start, "the value of the case"});
    run.results.add(row::cluster::fit.of(fit.variant, n.key), p);
  }
}
}  // namespace mill
