#include "reduce/stand/mode_names.h"
#include "reduce/stand/mode_verdict.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <utility>

namespace mill::reduce {
namespace {
// Limits of the rules, theory.md 22.9.
constexpr double frame_limit = 0.5, chock_limit = 0.4, path_limit = 0.6, octave_limit = 0.5, bending_limit = 0.5;
constexpr double still   = 0.05;  // kinetic share below which a stack is at rest
constexpr double unclear = 0.2;   // the best two rules nearer than this: mixed

/// One half of the stand in one mode.
struct Stack {
  const char *side;                        ///< "upper"
  double frame = 0, backup = 0, work = 0;  ///< kinetic shares, chocks of rolls not in them
  double backup_chock = 0, work_chock = 0, cylinder = 0;
  double backup_moves = 0, work_moves = 0;      ///< displacement at mid-length, any scale
  double seat_moves     = 0;                    ///< of the backup roll at its bearings
  double backup_bending = 0, work_bending = 0;  ///< shares of the strain energy
  double kinetic() const
  {
    return frame + backup + work + backup_chock + work_chock + cylinder;
  }
  double rolls() const
  {
    return backup + work + backup_chock + work_chock;
  }
  bool moves() const
  {
    return kinetic() > still;
  }
  /// 1 where the rolls move in phase, neither more than twice the other, the backup roll as a body; less beyond
  /// these limits, 0 in antiphase.
  double together() const
  {
    const double ratio = work_moves / backup_moves;
    return ratio > 0 ? std::min({1., 2 * ratio, 2 / ratio, body()}) : 0;
  }
  double body() const  ///< 1 where the bearings of the backup roll move at least half as far as its middle
  {
    return std::clamp(2 * seat_moves / backup_moves, 0., 1.);
  }
  /// 1 where the backup roll moves opposite to, or below half of, its work roll; less beyond that.
  double work_alone() const
  {
    const double ratio = backup_moves / work_moves;
    return ratio > 0.5 ? 0.5 / ratio : 1;
  }
};

/// One mode in the terms of the rules.
struct Motion {
  std::array<Stack, 2> stacks;
  double contact = 0, gap = 0, path = 0;  ///< strain shares: K3 + K5; K4; K1, K2, K6, K7 with what is in them
};

/// A rule that may hold: what it measures over its limit, 0 where a condition of phase fails.
struct Verdict {
  double score = 0;
  ModeName mode;
};

int whole_percent(const double share)
{
  return int(std::lround(100 * share));
}

bool starts_with(const std::string &text, const char *start)
{
  return text.rfind(start, 0) == 0;
}

/// Shares of the kinetic energy by part; what a part carries is a part of its own.
std::vector<std::pair<std::string, double>> kinetic_shares(const StandWithModes &s, const Eigen::Index mode)
{
  std::vector<std::pair<std::string, double>> shares;
  for (std::size_t p = 0; p < s.model.parts.size(); ++p)
    shares.emplace_back(s.model.parts[p], s.modes.kinetic(Eigen::Index(p), mode));
  for (const CarriedMass &carried : s.model.carried) {
    const double share = carried.mass * std::pow(carried.row.dot(s.modes.shape.col(mode)), 2);  // phi^T M phi = 1
    for (auto &[part, energy] : shares)
      if (part == carried.carrier)
        energy -= share;
    shares.emplace_back(carried.name, share);
  }
  return shares;
}

void add_kinetic(Motion &m, const StandWithModes &s, const Eigen::Index mode)
{
  double housing = 0;
  for (const auto &[part, share] : kinetic_shares(s, mode)) {
    if (part == "housing") {
      housing += share;
      continue;
    }
    Stack &stack     = m.stacks[starts_with(part, "lower") ? 1 : 0];
    const bool chock = part.find("chock") != std::string::npos, work = part.find("work") != std::string::npos;
    if (part.find("frame") != std::string::npos)
      stack.frame += share;
    else if (part == "cylinder")
      stack.cylinder += share;
    else
      (chock ? work ? stack.work_chock : stack.backup_chock : work ? stack.work : stack.backup) += share;
  }
  // One body carries both ends: its energy goes with those of its lumps.
  Stack &more = m.stacks[0].kinetic() >= m.stacks[1].kinetic() ? m.stacks[0] : m.stacks[1];
  more.frame += housing;
}

void add_strain(Motion &m, const StandWithModes &s, const Eigen::Index mode)
{
  for (std::size_t c = 0; c < s.model.connections.size(); ++c) {
    const std::string &name = s.model.connections[c].name;
    const double share      = s.modes.strain(Eigen::Index(c), mode);
    if (name == "K3" || name == "K5")
      m.contact += share;
    else if (name == "K4")
      m.gap += share;
    else if (!starts_with(name, "Kzc"))
      m.path += share;
  }
  for (std::size_t p = 0; p < s.model.parts.size(); ++p) {
    const std::string &part = s.model.parts[p];
    const double share      = s.modes.strain_of_part(Eigen::Index(p), mode);
    Stack &stack            = m.stacks[starts_with(part, "lower") ? 1 : 0];
    if (part.find("work roll") != std::string::npos)
      stack.work_bending += share;
    else if (part.find("backup roll") != std::string::npos) {
      stack.backup_bending += share;
      m.path += share;  // K2 and K6 hold K_ZW
    } else
      m.path += share;
  }
}

Motion motion_of(const StandWithModes &s, const Eigen::Index mode)
{
  Motion m;
  m.stacks[0].side         = "upper";
  m.stacks[1].side         = "lower";
  const Eigen::VectorXd y  = point_rows(s.model, 6) * s.modes.shape.col(mode);
  m.stacks[0].backup_moves = y[1];
  m.stacks[0].work_moves   = y[2];
  m.stacks[1].work_moves   = y[3];
  m.stacks[1].backup_moves = y[4];
  for (Stack &stack : m.stacks) {
    stack.seat_moves = stack.backup_moves;  // of a mass
    for (const StandPoint &point : s.model.points)
      if (point.name == std::string(stack.side) + " backup roll seat")
        stack.seat_moves = point.row.dot(s.modes.shape.col(mode));
  }
  add_kinetic(m, s, mode);
  add_strain(m, s, mode);
  return m;
}

/// "third octave" of both stacks, of the one that moves.
ModeName of_stacks(const Motion &m, const std::string &name, const std::string &key)
{
  for (std::size_t i = 0; i < 2; ++i)
    if (!m.stacks[1 - i].moves())
      return {name + ", " + m.stacks[i].side + " stack", key + "_" + m.stacks[i].side, ""};
  return {name, key, ""};
}

Verdict judged(const double score, ModeName mode, const std::string &decided)
{
  mode.decided = decided;
  return {score, std::move(mode)};
}

void judge_frame(std::vector<Verdict> &all, const Motion &m)
{
  for (const Stack &s : m.stacks)
    all.push_back(judged(s.frame / frame_limit,
                         {std::string("frame, ") + s.side, std::string("frame_") + s.side, ""},
                         fmt::format("{} frame {} % of the kinetic energy", s.side, whole_percent(s.frame))));
}

void judge_chocks(std::vector<Verdict> &all, const Motion &m)
{
  for (const Stack &s : m.stacks)
    for (const bool work : {false, true}) {
      const double chock = work ? s.work_chock : s.backup_chock, roll = work ? s.work : s.backup;
      const char *which = work ? "work" : "backup";
      all.push_back(judged(
          chock > roll ? chock / chock_limit : 0,
          {fmt::format("chock, {} {} roll", s.side, which), fmt::format("chock_{}_{}_roll", s.side, which), ""},
          fmt::format("its chocks {} % of the kinetic energy, the roll {} %", whole_percent(chock),
                      whole_percent(roll))));
    }
}

/// The least that a condition reaches in the stacks that move.
template <class Condition> double least_of_those_that_move(const Motion &m, Condition &&condition)
{
  double least = 1;
  for (const Stack &s : m.stacks)
    if (s.moves())
      least = std::min(least, condition(s));
  return least;
}

void judge_stack(std::vector<Verdict> &all, const Motion &m)
{
  const auto &[upper, lower] = m.stacks;
  const bool both = upper.moves() && lower.moves(), alike = both && upper.work_moves * lower.work_moves > 0;
  const auto in_phase = [](const Stack &s) { return s.work_moves * s.backup_moves > 0 ? s.body() : 0; };
  const double rolls  = (upper.rolls() + lower.rolls()) / octave_limit;
  all.push_back(judged(
      alike ? least_of_those_that_move(m, in_phase) * std::min(m.path / path_limit, rolls) : 0,
      {"whole stack", "whole_stack", ""},
      fmt::format("all rolls in phase, K1, K2, K6 and K7 {} % of the strain energy", whole_percent(m.path))));
  const double together = alike ? 0 : least_of_those_that_move(m, [](const Stack &s) { return s.together(); });
  all.push_back(judged(
      together * std::min((m.gap + m.path) / octave_limit, rolls), of_stacks(m, "third octave", "third_octave"),
      fmt::format("{}work rolls with their backup rolls, gap {} %, K1, K2, K6 and K7 {} % of the "
                  "strain energy",
                  both ? "stacks against each other, " : "", whole_percent(m.gap), whole_percent(m.path))));
  const double alone = least_of_those_that_move(m, [](const Stack &s) { return s.work_alone(); });
  all.push_back(judged(alone * m.contact / octave_limit,
                       alike ? ModeName{"fifth octave, rolls together", "fifth_octave_together", ""}
                             : of_stacks(m, "fifth octave", "fifth_octave"),
                       fmt::format("K3 and K5 {} % of the strain energy, backup rolls at most half of their work "
                                   "rolls",
                                   whole_percent(m.contact))));
}

void judge_bending(std::vector<Verdict> &all, const Motion &m)
{
  for (const Stack &s : m.stacks)
    for (const bool work : {false, true}) {
      const double share = work ? s.work_bending : s.backup_bending;
      const char *which  = work ? "work" : "backup";
      all.push_back(judged(share / bending_limit,
                           {fmt::format("bending, {} {} roll", s.side, which),
                            fmt::format("bending_{}_{}_roll", s.side, which), ""},
                           fmt::format("bending of the roll {} % of the strain energy", whole_percent(share))));
    }
}

/// The first rule that holds, or "mixed".
ModeName decided(const Motion &m)
{
  std::vector<Verdict> all;
  judge_frame(all, m);
  judge_chocks(all, m);
  judge_stack(all, m);
  judge_bending(all, m);
  std::vector<const Verdict *> best;
  for (const Verdict &v : all)
    best.push_back(&v);
  std::stable_sort(best.begin(), best.end(),
                   [](const Verdict *a, const Verdict *b) { return a->score > b->score; });
  const bool near  = best[1]->score > (1 - unclear) * best[0]->score;
  const auto holds = std::find_if(all.begin(), all.end(), [](const Verdict &v) { return v.score > 1; });
  if (holds != all.end() && !near)
    return holds->mode;
  const auto words = [](const Verdict &v) { return v.mode.name + " (" + v.mode.decided + ")"; };
  if (best[0]->score < 0.5)
    return {"mixed", "mixed", "no rule is near"};
  if (best[1]->score < 0.5)
    return {"mixed", "mixed", "nearest: " + words(*best[0])};
  return {"mixed", "mixed", "between " + words(*best[0]) + " and " + words(*best[1])};
}

}  // namespace

std::vector<ModeName> own_names(const StandWithModes &stand)
{
  std::vector<ModeName> names;
  for (Eigen::Index k = 0; k < stand.modes.frequency.size(); ++k)
    names.push_back(decided(motion_of(stand, k)));
  return names;
}

void number_names(std::vector<ModeName> &names, const std::vector<bool> &fixed, std::set<std::string> keys)
{
  for (std::size_t k = 0; k < names.size(); ++k) {
    ModeName &mode = names[k];
    if (fixed[k] || mode.key == "mixed")
      continue;
    const std::string name = mode.name, key = mode.key;
    for (int order = 2; !keys.insert(mode.key).second; ++order) {
      mode.name = fmt::format("{}, order {}", name, order);
      mode.key  = fmt::format("{}_{}", key, order);
    }
  }
}

std::vector<ModeName> mode_names(const StandWithModes &stand)
{
  std::vector<ModeName> names = own_names(stand);
  number_names(names, std::vector<bool>(names.size(), false), {});
  return names;
}
}  // namespace mill::reduce
