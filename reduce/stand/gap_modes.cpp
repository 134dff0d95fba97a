#include "reduce/stand/gap_modes.h"
#include "core/records/result_words.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace mill::reduce {
namespace {
constexpr double held       = 1e-7;  // a frequency below this part of the largest is rounding: a free motion
constexpr double opens_gap  = 1e-9;  // of the largest |g|: less is rounding
constexpr int highest_order = 3;     // in the name of a mode that is not a gap mode

/// The stack that moves more.
const StackMotion &moving_stack(const GapMotion &mode)
{
  return *std::max_element(mode.stacks.begin(), mode.stacks.end(),
                           [](const StackMotion &a, const StackMotion &b) { return a.kinetic < b.kinetic; });
}

const KineticShare *largest_part(const GapMotion &mode)
{
  const auto largest =
      std::max_element(mode.parts.begin(), mode.parts.end(),
                       [](const KineticShare &a, const KineticShare &b) { return a.kinetic < b.kinetic; });
  return largest == mode.parts.end() ? nullptr : &*largest;
}

std::string in_percent(const double share)
{
  return fmt::format("{:.{}f} %", 100 * share, share < 0.0995 ? 1 : 0);
}

std::string why(const GapMotion &mode, const GapKind kind)
{
  const std::string share = in_percent(mode.gap_share) + " of the static compliance of the gap";
  if (kind != GapKind::none) {
    const StackMotion &stack = moving_stack(mode);
    return fmt::format("work roll {} its backup roll{} ({} of the kinetic energy); {}",
                       kind == GapKind::first ? "with" : "against",
                       stack.side.empty() ? "" : " in the " + stack.side + " stack", in_percent(stack.kinetic),
                       share);
  }
  const KineticShare *part = largest_part(mode);
  return part ? fmt::format("{} {} of the kinetic energy; {}", part->part, in_percent(part->kinetic), share)
              : share;
}

/// A name before it is numbered.
struct Stem {
  std::string name, key;
};

Stem stem_of_kind(const GapKind kind)
{
  return kind == GapKind::first ? Stem{"gap mode, first kind", word_of(ResultWord::gap_first_kind)}
                                : Stem{"gap mode, second kind", word_of(ResultWord::gap_second_kind)};
}

Stem stem_of_part(const GapMotion &mode, const GapKind kind)
{
  const KineticShare *part = largest_part(mode);
  if (kind == GapKind::none)
    return part ? Stem{part->name, part->key} : Stem{"mode", "mode"};
  const Stem stem = stem_of_kind(kind);
  return part ? Stem{stem.name + ", " + part->part, stem.key + "_" + part->key} : stem;
}

/// Of a gap mode whose part has given its name three times: the second largest part is named too.
Stem stem_of_two_parts(GapMotion mode, const GapKind kind)
{
  const Stem stem             = stem_of_part(mode, kind);
  const KineticShare *largest = largest_part(mode);
  if (!largest)
    return stem;
  mode.parts.erase(mode.parts.begin() + (largest - mode.parts.data()));
  const KineticShare *second = largest_part(mode);
  return second ? Stem{stem.name + " and " + second->part, stem.key + "_" + second->key} : stem;
}
}  // namespace

Eigen::VectorXd gap_shares(const Eigen::VectorXd &frequency, const Eigen::MatrixXd &shape,
                           const Eigen::VectorXd &row, const double compliance)
{
  const Eigen::Index m  = frequency.size();
  Eigen::VectorXd share = Eigen::VectorXd::Zero(m);
  if (m == 0)
    return share;
  const Eigen::ArrayXd g2                          = (shape.transpose() * row).array().square();
  const double opens                               = opens_gap * opens_gap * g2.maxCoeff();
  const Eigen::Array<bool, Eigen::Dynamic, 1> free = frequency.array() <= held * frequency.maxCoeff();
  const Eigen::ArrayXd of_free                     = free.select((g2 > opens).select(g2, 0.), 0.);
  if (of_free.sum() > 0)
    return of_free / of_free.sum();
  const Eigen::ArrayXd w2 = (2 * M_PI * frequency.array()).square();
  const Eigen::ArrayXd c  = free.select(0., g2 / free.select(1., w2));
  const double sum        = std::isnan(compliance) ? c.sum() : compliance;
  if (sum > 0)
    share = c / sum;
  return share;
}

GapKind gap_kind(const GapMotion &mode)
{
  if (!(mode.gap_share >= least_share_of_gap_mode) || mode.stacks.empty())
    return GapKind::none;
  const StackMotion &stack = moving_stack(mode);
  return stack.work_roll * stack.backup_roll > 0 ? GapKind::first : GapKind::second;
}

std::string octave(const double frequency, const GapKind kind)
{
  if (kind == GapKind::none)
    return "";
  const double(&range)[2] = kind == GapKind::first ? third_octave : fifth_octave;
  if (frequency < range[0] || frequency > range[1])
    return "";
  return kind == GapKind::first ? " (third octave)" : " (fifth octave)";
}

bool named_alike(const GapMotion &a, const GapMotion &b)
{
  return gap_kind(a) == gap_kind(b) && (gap_kind(a) != GapKind::none ||
                                        stem_of_part(a, GapKind::none).key == stem_of_part(b, GapKind::none).key);
}

int gap_mode(const std::vector<GapMotion> &modes, const GapKind kind)
{
  int best = -1;
  for (std::size_t k = 0; k < modes.size(); ++k)
    if (gap_kind(modes[k]) == kind && (best < 0 || modes[k].gap_share > modes[std::size_t(best)].gap_share))
      best = int(k);
  return best;
}

std::vector<ModeName> gap_mode_names(const std::vector<GapMotion> &modes, const std::vector<ModeName> &given)
{
  std::set<std::string> keys;
  for (const ModeName &mode : given)
    keys.insert(mode.key);
  std::vector<ModeName> names(modes.size());
  const auto is_given = [&](const std::size_t k) { return !given.empty() && !given[k].key.empty(); };
  // A free name; empty: the third order is taken.
  const auto numbered = [&](const Stem &stem, const int highest) {
    Stem one = stem;
    for (int order = 2; !keys.insert(one.key).second; ++order) {
      if (order > highest)
        return Stem{};
      one = {fmt::format("{}, order {}", stem.name, order), fmt::format("{}_{}", stem.key, order)};
    }
    return one;
  };
  const auto name = [&](const std::size_t k, const Stem &stem) {
    const GapKind kind = gap_kind(modes[k]);
    Stem one           = numbered(stem, highest_order);
    if (one.key.empty() && kind != GapKind::none)
      one = numbered(stem_of_two_parts(modes[k], kind), std::numeric_limits<int>::max());
    names[k].name = one.key.empty() ? stem.name + ", higher" : one.name + octave(modes[k].frequency, kind);
    names[k].key  = one.key;
  };
  for (std::size_t k = 0; k < modes.size(); ++k) {
    if (is_given(k))
      names[k] = given[k];
    else
      names[k].decided = why(modes[k], gap_kind(modes[k]));
    names[k].kind      = gap_kind(modes[k]);
    names[k].gap_share = modes[k].gap_share;
  }
  // The gap modes that lead their kind come first, so that no other mode takes their names.
  for (const GapKind kind : {GapKind::first, GapKind::second})
    if (const int k = gap_mode(modes, kind); k >= 0 && !is_given(std::size_t(k)))
      name(std::size_t(k),
           keys.count(stem_of_kind(kind).key) ? stem_of_part(modes[std::size_t(k)], kind) : stem_of_kind(kind));
  for (std::size_t k = 0; k < modes.size(); ++k)
    if (!is_given(k) && names[k].name.empty())
      name(k, stem_of_part(modes[k], gap_kind(modes[k])));
  return names;
}
}  // namespace mill::reduce
