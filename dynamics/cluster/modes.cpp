#include "dynamics/cluster/modes.h"
#include "core/base/choice.h"
#include "core/base/errors.h"
#include "core/base/name_part.h"
#include "core/numerics/eigen_instances.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <sstream>

namespace mill::cluster {
namespace {
enum class Axis { x, y };
constexpr auto words_of(Axis)
{
  return choice_words<Axis>("x", "y");
}

const char *const direction_names[] = {"x", "y", "turn"};

Motion full_state(const Stack &stack, const Motion &u)
{
  return stack.coupled && u.size() != stack.size() ? with_rotation(u) : u;
}

Eigen::MatrixXd mass_scaled(const Stack &stack, const Eigen::MatrixXd &K)
{
  const Eigen::VectorXd w = masses(stack).cwiseSqrt().cwiseInverse();
  return w.asDiagonal() * K * w.asDiagonal();
}

// The rolls that move, largest share of kinetic energy first, and what they move against.
std::string label_of(const Mode &mode)
{
  constexpr std::size_t most = 3;
  std::vector<Share> moving  = mode.kinetic;
  std::stable_sort(moving.begin(), moving.end(), [](const Share &a, const Share &b) { return a.value > b.value; });
  std::string rolls;
  std::size_t named = 0;
  for (const Share &s : moving)
    if ((s.value > 0.2 && named++ < most) || (rolls.empty() && s.value > 0))
      rolls += (rolls.empty() ? "" : ", ") + s.name;
  std::vector<Share> springs = mode.elastic;
  std::stable_sort(springs.begin(), springs.end(),
                   [](const Share &a, const Share &b) { return a.value > b.value; });
  std::string where;
  named = 0;
  for (const Share &s : springs)
    if (s.value > 0.2 && named++ < most)
      where += (where.empty() ? "" : ", ") + s.name;
  return where.empty() ? rolls : rolls + " on " + where;
}
}  // namespace

Motion with_rotation(const Motion &u)
{
  Motion full = Motion::Zero(u.size() / 2 * 3);
  for (Eigen::Index i = 0; i < u.size() / 2; ++i)
    full.segment<2>(3 * i) = u.segment<2>(2 * i);
  return full;
}

std::vector<Mode> modes(const Stack &stack, const Motion &u)
{
  const Tangent K         = tangent(stack, full_state(stack, u));
  const Eigen::VectorXd m = masses(stack);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(mass_scaled(stack, K.total));
  // -, of the largest eigenvalue: n eps for 120 unknowns are 3e-14.  A common rolling strains nothing, and shares
  // of the rounding of its energy have no meaning.
  constexpr double rounding = 1e-12;
  std::vector<Mode> all;
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    Mode mode;
    const double root   = eigen.eigenvalues()[i];
    const bool strained = std::abs(root) > rounding * eigen.eigenvalues().cwiseAbs().maxCoeff();
    mode.frequency      = std::copysign(std::sqrt(std::abs(root)), root) / (2 * M_PI);
    mode.shape          = eigen.eigenvectors().col(i).cwiseQuotient(m.cwiseSqrt());
    Eigen::Index largest;
    mode.shape.cwiseAbs().maxCoeff(&largest);
    mode.shape /= mode.shape[largest];
    mode.modal_mass   = mode.shape.dot(m.cwiseProduct(mode.shape));
    const double work = mode.shape.dot(K.total * mode.shape);
    const auto share  = [&](const Eigen::MatrixXd &part) {
      return strained ? mode.shape.dot(part * mode.shape) / work : 0;
    };
    for (std::size_t c = 0; c < K.contacts.size(); ++c)
      mode.elastic.push_back({stack.contacts[c].name, share(K.contacts[c])});
    for (std::size_t s = 0; s < K.supports.size(); ++s)
      mode.elastic.push_back({stack.supports[s].name, share(K.supports[s])});
    for (Eigen::Index k = 0; k < m.size(); ++k)
      mode.kinetic.push_back(
          {stack.rolls[std::size_t(k / stack.per_roll())].name + " " + direction_names[k % stack.per_roll()],
           m[k] * mode.shape[k] * mode.shape[k] / mode.modal_mass});
    mode.label = label_of(mode);
    all.push_back(std::move(mode));
  }
  return all;
}

double least_root(const Stack &stack, const Motion &u)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      mass_scaled(stack, total_tangent(stack, full_state(stack, u))), Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()[0];
}

double assurance(const Stack &stack, const Eigen::VectorXd &shape, const Mode &mode)
{
  const Eigen::VectorXd m = masses(stack);
  const double along      = shape.dot(m.cwiseProduct(mode.shape));
  return along * along / (shape.dot(m.cwiseProduct(shape)) * mode.modal_mass);
}

std::vector<int> identified(const Stack &stack, const std::vector<NamedShape> &named, const std::vector<Mode> &all)
{
  struct Pair {
    double value;
    std::size_t name, mode;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < named.size(); ++i)
    for (std::size_t k = 0; k < all.size(); ++k)
      pairs.push_back({assurance(stack, named[i].shape, all[k]), i, k});
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair &a, const Pair &b) { return a.value > b.value; });
  std::vector<int> which(named.size(), -1);
  std::vector<char> taken(all.size(), 0);
  for (const Pair &p : pairs)
    if (which[p.name] < 0 && !taken[p.mode]) {
      which[p.name] = int(p.mode);
      taken[p.mode] = 1;
    }
  return which;
}

Eigen::VectorXd parsed_shape(const Stack &stack, const std::string &text)
{
  Eigen::VectorXd shape = Eigen::VectorXd::Zero(stack.size());
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    std::istringstream words(part);
    std::string roll, direction, rest;
    double weight = 1;
    words >> roll >> direction;
    if (words >> rest) {
      std::istringstream number(rest);
      if (!(number >> weight) || !number.eof())
        throw InputError(fmt::format("'{}' is not a number", rest));
    }
    const auto result = std::find_if(stack.rolls.begin(), stack.rolls.end(),
                                     [&](const Roll &r) { return r.name == name_part(roll); });
    if (result == stack.rolls.end())
      throw InputError(fmt::format("no roll has the name '{}'", roll));
    const auto axis = choice_named<Axis>(direction);
    if (!axis)
      throw InputError(
          fmt::format("'{}' is not a direction; give x or y, for example \"{} y 0.8\"", direction, roll));
    shape[stack.per_roll() * (result - stack.rolls.begin()) + (*axis == Axis::y)] = weight;
  }
  if (shape.isZero())
    throw InputError("names no motion; for example \"W y, I y 0.8\"");
  return shape;
}
}  // namespace mill::cluster
