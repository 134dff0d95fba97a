#include "reduce/stand/masses_needed.h"
#include "core/base/short_number.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace mill::reduce {
namespace {
constexpr double shown = 0.5;  // assurance of a shape

/// A displacement of the stand that can carry a mass.
struct Candidate {
  std::string name;
  Eigen::VectorXd row;
};

std::vector<Candidate> candidates_of(const StandModel &stand)
{
  std::vector<Candidate> all;
  const auto add = [&](const std::string &name, const Eigen::VectorXd &row) {
    const bool known =
        std::any_of(all.begin(), all.end(), [&](const Candidate &c) { return (c.row - row).isZero(1e-12); });
    if (!known)
      all.push_back({name, row});
  };
  for (const StandPoint &point : stand.points)
    add(point.name, point.row);
  for (const StandLine &line : stand.lines)
    for (const int quarter : {1, 2, 3}) {
      const double z = line.z[line.z.size() - 1] * quarter / 4;
      Eigen::Index nearest;
      (line.z.array() - z).abs().minCoeff(&nearest);
      add(line.name + " at " + short_number(line.z[nearest], 3) + " m", line.rows.row(nearest));
    }
  return all;
}

/// Everything a static reduction to any choice of the candidates needs.  theory.md (22.21), (22.22)
struct Reduction {
  Eigen::MatrixXd F;          ///< (c, c) m/N, flexibility
  Eigen::MatrixXd G;          ///< (c, c) A^T M A, A = K^-1 P^T
  Eigen::MatrixXd C;          ///< (c, m) A^T M modes
  Eigen::VectorXd frequency;  ///< (m) Hz, of the modes below the limit
};

Reduction prepare(const StandWithModes &stand, const std::vector<Candidate> &candidates, const double limit)
{
  Eigen::MatrixXd P(Eigen::Index(candidates.size()), stand.model.M.rows());
  for (std::size_t i = 0; i < candidates.size(); ++i)
    P.row(Eigen::Index(i)) = candidates[i].row;
  const Eigen::MatrixXd A = static_solution(stand.model, P.transpose()), MA = stand.model.M * A;
  const Eigen::VectorXd &f = stand.modes.frequency;
  const Eigen::Index below = std::upper_bound(f.begin(), f.end(), limit) - f.begin();
  return {P * A, A.transpose() * MA, MA.transpose() * stand.modes.shape.leftCols(below), f.head(below)};
}

struct Score {
  MassesRow row;
  double sum = std::numeric_limits<double>::infinity();  ///< -, of errors; a missing mode adds 1
};

void judge(Score &score, const Eigen::MatrixXd &mac, const Eigen::VectorXd &reduced, const Eigen::VectorXd &full)
{
  score.sum                   = 0;
  score.row.modes_below_limit = int(full.size());
  for (const ModePair &pair : pair_modes(mac, reduced, full, shown)) {
    if (pair.other < 0) {
      score.row.missing.push_back(full[pair.mode]);
      score.sum += 1;
      continue;
    }
    const double error    = std::abs(reduced[pair.other] / full[pair.mode] - 1);
    score.row.worst_error = std::max(score.row.worst_error, error);
    score.row.right += error <= right_frequency;
    score.sum += std::min(1., error);
  }
}

Score evaluate(const Reduction &r, const std::vector<int> &places)
{
  Score score;
  score.row.masses        = int(places.size());
  const Eigen::MatrixXd F = r.F(places, places), G = r.G(places, places);
  const Eigen::LDLT<Eigen::MatrixXd> factor(F);
  // A choice of displacements that depend on each other cannot carry masses of their own.
  if (!(factor.vectorD().minCoeff() > 1e-10 * factor.vectorD().maxCoeff()))
    return score;
  const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(F.rows(), F.cols()));
  const Eigen::MatrixXd K       = 0.5 * (inverse + inverse.transpose()),
                        M       = inverse.transpose() * G * inverse;  // (22.21)
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(K, 0.5 * (M + M.transpose()));
  const Eigen::VectorXd f = modes.eigenvalues().cwiseMax(0).cwiseSqrt() / (2 * M_PI);
  // Shapes of the reduced stand are mass-normalised in the full one, as the full modes are.
  const Eigen::MatrixXd mac =
      (modes.eigenvectors().transpose() * inverse.transpose() * r.C(places, Eigen::all)).cwiseAbs2();
  judge(score, mac, f, r.frequency);
  return score;
}

std::vector<std::string> names(const std::vector<Candidate> &candidates, const std::vector<int> &places)
{
  std::vector<std::string> list;
  for (const int i : places)
    list.push_back(candidates[std::size_t(i)].name);
  return list;
}
}  // namespace

std::vector<MassesRow> masses_needed(const StandWithModes &stand, const double limit, const int most,
                                     const StandWithModes *chain)
{
  const auto candidates = candidates_of(stand.model);
  const Reduction r     = prepare(stand, candidates, limit);
  std::vector<MassesRow> rows;
  const auto keep = [&](Score score, const std::vector<int> &places, const std::string &added) {
    score.row.at    = names(candidates, places);
    score.row.added = added;
    rows.push_back(score.row);
  };
  for (int count = 1; count < 6; ++count) {  // the best choice among the six places
    Score best;
    std::vector<int> best_at;
    for (unsigned set = 1; set < 64; ++set) {
      std::vector<int> places;
      for (int i = 0; i < 6; ++i)
        if (set >> i & 1)
          places.push_back(i);
      if (int(places.size()) != count)
        continue;
      const Score score = evaluate(r, places);
      if (score.sum < best.sum) {
        best    = score;
        best_at = places;
      }
    }
    keep(best, best_at, "best " + std::to_string(count) + " of the six places");
  }
  if (chain) {
    Score lumped;
    lumped.row.masses        = 6;
    const Eigen::Index below = r.frequency.size();
    judge(lumped, mac_with_chain(stand, *chain).topRows(below).transpose(), chain->modes.frequency, r.frequency);
    keep(lumped, {0, 1, 2, 3, 4, 5}, "the chain of six lumped masses");
  }
  std::vector<int> places{0, 1, 2, 3, 4, 5};
  keep(evaluate(r, places), places, "the six places");
  while (int(places.size()) < std::min<int>(most, int(candidates.size()))) {
    Score best;
    int best_added = -1;
    for (int i = 6; i < int(candidates.size()); ++i) {
      if (std::find(places.begin(), places.end(), i) != places.end())
        continue;
      places.push_back(i);
      const Score score = evaluate(r, places);
      places.pop_back();
      if (score.sum < best.sum) {
        best       = score;
        best_added = i;
      }
    }
    if (best_added < 0)
      break;
    places.push_back(best_added);
    keep(best, places, candidates[std::size_t(best_added)].name);
  }
  return rows;
}

int masses_enough(const std::vector<MassesRow> &rows, const double error)
{
  int least = 0;
  for (const MassesRow &row : rows)
    if (row.missing.empty() && row.worst_error <= error && (least == 0 || row.masses < least))
      least = row.masses;
  return least;
}
}  // namespace mill::reduce
