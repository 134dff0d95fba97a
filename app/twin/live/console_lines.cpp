#include "app/twin/live/console_lines.h"
#include "core/base/si_unit.h"
#include "core/base/visible_text.h"
#include "dynamics/response/mill_model.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace mill {
void ConsoleLines::begin(const live::LiveSource &source)
{
  source_ = source;
  n_      = 0;
}

std::string ConsoleLines::take(const live::LiveBlock &block)
{
  if (n_ == 0) {
    force_     = 0;
    measured_  = Eigen::VectorXd::Zero(block.measured.cols());
    counted_   = measured_;
    simulated_ = Eigen::VectorXd::Zero(block.simulated.cols());
  }
  n_ += block.force.size();
  force_ += block.force.sum();
  simulated_ += block.simulated.colwise().squaredNorm().transpose();
  for (Eigen::Index c = 0; c < block.measured.cols(); ++c)
    for (const double value : block.measured.col(c))
      if (std::isfinite(value)) {
        measured_[c] += value * value;
        counted_[c] += 1;
      }
  if (double(n_) < block.rate)
    return "";
  const std::string text = line(block);
  n_                     = 0;
  return text;
}

std::string ConsoleLines::line(const live::LiveBlock &block)
{
  const std::int64_t end = block.first + block.force.size();
  std::string text       = fmt::format("{:>10.2f} s", double(end) / block.rate) +
                     (block.driven ? fmt::format("  force {:.1f} kN", force_ / double(n_) / 1e3) : "");
  for (std::size_t p = 0; p < source_.places.size(); ++p) {
    const auto channel       = std::find_if(source_.channels.begin(), source_.channels.end(), [&](const auto &c) {
      return c.name == source_.places[p] && is_in(c.unit, SiUnit::acceleration);
    });
    const std::string &place = source_.places[p];
    static const std::set<std::string> always{"upper_work_roll", "lower_work_roll"};
    const bool shown = channel != source_.channels.end() || always.count(place);
    if (!shown)
      continue;
    const double g = dynamics::standard_gravity;
    text += "  " + place;
    if (block.driven)
      text += fmt::format(" {:.4g} g twin", std::sqrt(simulated_[Eigen::Index(p)] / double(n_)) / g);
    if (channel != source_.channels.end()) {
      const auto c = channel - source_.channels.begin();
      text += counted_[c] > 0 ? fmt::format(" {:.4g} g measured", std::sqrt(measured_[c] / counted_[c]) / g)
                              : " not measured";
    }
  }
  return text + (block.settling ? "  (settling)\n" : "\n");
}
}  // namespace mill
