#include "reduce/stand/stand_comparison.h"
#include "core/base/errors.h"
#include "core/base/short_number.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace mill::reduce {
namespace {
constexpr std::size_t most_listed = 9;  // modes without counterpart that a sentence names

/// (columns of a, columns of b): squared cosine between shapes in the norm of M.
Eigen::MatrixXd assurance(const Eigen::MatrixXd &a, const Eigen::MatrixXd &b, const Eigen::MatrixXd &M)
{
  const Eigen::MatrixXd Mb = M * b;
  const Eigen::VectorXd aa = (a.cwiseProduct(M * a)).colwise().sum(), bb = (b.cwiseProduct(Mb)).colwise().sum();
  return (a.transpose() * Mb).cwiseAbs2().cwiseQuotient(aa * bb.transpose());
}

/// Unknown that a row reads alone, -1 when it reads several.
Eigen::Index single_unknown(const Eigen::RowVectorXd &row)
{
  Eigen::Index i;
  const double largest = row.cwiseAbs().maxCoeff(&i);
  return largest == 1 && row.cwiseAbs().sum() == 1 ? i : -1;
}

/// Row of `line` at z, linear between its stations.
Eigen::RowVectorXd row_at(const StandLine &line, const double z)
{
  const auto above     = std::upper_bound(line.z.begin(), line.z.end(), z) - line.z.begin();
  const Eigen::Index i = std::clamp<Eigen::Index>(above - 1, 0, line.z.size() - 2);
  const double t       = (z - line.z[i]) / (line.z[i + 1] - line.z[i]);
  return (1 - t) * line.rows.row(i) + t * line.rows.row(i + 1);
}

template <class Named>
const Named &named(const std::vector<Named> &all, const std::string &name, const std::string &stand)
{
  const auto match = std::find_if(all.begin(), all.end(), [&](const Named &n) { return n.name == name; });
  if (match == all.end())
    throw InputError("stand model \"" + stand + "\" has no \"" + name + "\" to compare with");
  return *match;
}

/// (n_beam, n_other): what the unknowns of a stand of beams would be in another model of the same stand.
Eigen::MatrixXd seen_at(const StandModel &beam, const StandModel &other)
{
  Eigen::MatrixXd seen = Eigen::MatrixXd::Zero(beam.M.rows(), other.M.rows());
  std::vector<bool> done(std::size_t(beam.M.rows()), false);
  const auto set = [&](const Eigen::Index i, const Eigen::RowVectorXd &row) {
    seen.row(i)          = row;
    done[std::size_t(i)] = true;
  };
  for (const StandLine &line : beam.lines) {
    const StandLine &twin = named(other.lines, line.name, other.name);
    for (Eigen::Index k = 0; k < line.z.size(); ++k)
      if (const Eigen::Index i = single_unknown(line.rows.row(k)); i >= 0)
        set(i, row_at(twin, line.z[k]));
  }
  for (const StandPoint &point : beam.points)
    if (const Eigen::Index i = single_unknown(point.row.transpose()); i >= 0 && !done[std::size_t(i)])
      set(i, named(other.points, point.name, other.name).row.transpose());
  if (std::find(done.begin(), done.end(), false) != done.end())
    throw InputError("stand model \"" + beam.name +
                     "\" has an unknown that is neither on a line nor a point; it cannot be "
                     "the model that others are compared with");
  return seen;
}

std::string list_of(const std::vector<std::string> &items)
{
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i)
    text += (i == 0 ? "" : i + 1 == items.size() ? " and " : ", ") + items[i];
  return text;
}

std::string hertz(const double f)
{
  return short_number(f);
}

std::string percent(const double share)
{
  return short_number(100 * share, share < 0.1 ? 2 : 3) + " %";
}

/// The parts that move most in a mode.
std::string movers(const StandWithModes &stand, const Eigen::Index mode)
{
  const Eigen::VectorXd share = stand.modes.kinetic.col(mode);
  Eigen::Index most;
  const double largest = share.maxCoeff(&most);
  return stand.model.parts[std::size_t(most)] + " " + std::to_string(std::lround(100 * largest)) + " %";
}
}  // namespace

Eigen::MatrixXd chain_shapes(const StandModel &stand)
{
  const Eigen::MatrixXd P = point_rows(stand, 6);
  const Eigen::MatrixXd A = static_solution(stand, P.transpose());
  const Eigen::MatrixXd F = P * A;
  return F.ldlt().solve(A.transpose()).transpose();  // (22.16)
}

Eigen::VectorXd in_chain(const StandWithModes &stand)
{
  const Eigen::MatrixXd T = chain_shapes(stand.model), MT = stand.model.M * T;
  const Eigen::MatrixXd onto = MT.transpose() * stand.modes.shape;
  const Eigen::MatrixXd gram = T.transpose() * MT;
  return onto.cwiseProduct(gram.ldlt().solve(onto)).colwise().sum();  // (22.18), modes are mass-normalised
}

Eigen::MatrixXd mac_with_chain(const StandWithModes &stand, const StandWithModes &chain)
{
  const Eigen::MatrixXd expanded = chain_shapes(stand.model) * point_rows(chain.model, 6) * chain.modes.shape;
  return assurance(stand.modes.shape, expanded, stand.model.M);
}

Eigen::MatrixXd mac_between(const StandWithModes &other, const StandWithModes &beam)
{
  // A mass that a beam carries has its own displacement, which another model may know apart from the
  // seat's.
  const auto &carried  = beam.model.carried;
  const Eigen::Index n = beam.model.M.rows(), c = Eigen::Index(carried.size());
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n + c, n + c);
  Eigen::MatrixXd a(n + c, other.modes.shape.cols()), b(n + c, beam.modes.shape.cols());
  M.topLeftCorner(n, n) = beam.model.M;
  a.topRows(n)          = seen_at(beam.model, other.model) * other.modes.shape;
  b.topRows(n)          = beam.modes.shape;
  for (Eigen::Index i = 0; i < c; ++i) {
    const CarriedMass &mass = carried[std::size_t(i)];
    M.topLeftCorner(n, n) -= mass.mass * mass.row * mass.row.transpose();
    M(n + i, n + i) = mass.mass;
    a.row(n + i)    = named(other.model.points, mass.name, other.model.name).row.transpose() * other.modes.shape;
    b.row(n + i)    = mass.row.transpose() * beam.modes.shape;
  }
  return assurance(a, b, M);
}

std::vector<ModePair> pair_modes(const Eigen::MatrixXd &mac, const Eigen::VectorXd &row_frequency,
                                 const Eigen::VectorXd &column_frequency, const double least,
                                 const double most_apart)
{
  std::vector<ModePair> pairs(std::size_t(mac.cols()));
  for (Eigen::Index c = 0; c < mac.cols(); ++c)
    pairs[std::size_t(c)].mode = int(c);
  Eigen::MatrixXd open = mac;
  for (Eigen::Index r = 0; r < mac.rows(); ++r)
    for (Eigen::Index c = 0; c < mac.cols(); ++c)
      if (std::abs(std::log(row_frequency[r] / column_frequency[c])) > std::log(most_apart))
        open(r, c) = -1;
  while (open.size() > 0) {
    Eigen::Index r, c;
    const double best = open.maxCoeff(&r, &c);
    if (!(best >= least))
      break;
    pairs[std::size_t(c)] = {int(c), int(r), best, column_frequency[c] / row_frequency[r] - 1};
    open.row(r).setConstant(-1);
    open.col(c).setConstant(-1);
  }
  return pairs;
}

ChainVerdict chain_verdict(const StandWithModes &detailed, const StandWithModes &chain, const double limit,
                           const std::string &title)
{
  const Eigen::VectorXd &f  = detailed.modes.frequency;
  const Eigen::Index below  = std::upper_bound(f.begin(), f.end(), limit) - f.begin();
  const Eigen::MatrixXd mac = mac_with_chain(detailed, chain).topRows(below);
  ChainVerdict verdict;
  verdict.pairs      = pair_modes(mac.transpose(), chain.modes.frequency, f.head(below));
  double worst_right = 0;
  std::vector<std::string> shown, wrong, missing;
  for (const ModePair &pair : verdict.pairs) {
    const std::string frequency_text = hertz(f[pair.mode]);
    if (pair.other < 0) {
      verdict.missing.push_back(f[pair.mode]);
      missing.push_back(frequency_text + " Hz (" + movers(detailed, pair.mode) + ")");
      continue;
    }
    const double chain_frequency = chain.modes.frequency[pair.other], error = chain_frequency / f[pair.mode] - 1;
    if (std::abs(error) <= right_frequency) {
      shown.push_back(frequency_text);
      worst_right = std::max(worst_right, std::abs(error));
    } else
      wrong.push_back(frequency_text + " Hz (six masses: " + hertz(chain_frequency) + " Hz, " +
                      (error > 0 ? "+" : "") + percent(error) + ")");
  }
  const std::string range = " below " + hertz(limit) + " Hz";
  auto &say               = verdict.sentences;
  if (below == 0) {
    say.push_back(title + " has no mode" + range + ".");
    return verdict;
  }
  say.push_back(shown.empty() ? "Six masses are right to 5 % for no mode of the " + std::to_string(below) +
                                    " modes of " + title + range + "."
                              : "Six masses are right to " + percent(worst_right) + " for " +
                                    std::to_string(shown.size()) + " of the " + std::to_string(below) +
                                    " modes of " + title + range + ": " + list_of(shown) + " Hz.");
  if (!wrong.empty())
    say.push_back("They are wrong for " + list_of(wrong) + ".");
  if (missing.size() > most_listed) {
    const std::size_t others = missing.size() - most_listed;
    missing.resize(most_listed);
    missing.push_back(std::to_string(others) + " more up to " + hertz(verdict.missing.back()) + " Hz");
  }
  if (!missing.empty())
    say.push_back("They cannot show " + list_of(missing) + ".");
  return verdict;
}
}  // namespace mill::reduce
