#include "reduce/bearing/oil_film/film.h"
#include <algorithm>
#include <cmath>

namespace mill::bearing {
namespace {
constexpr int most_steps        = 100;
constexpr double least_film     = 1e-4;   // of the clearance: thinner ones are not solved
constexpr double least_pressure = 1e-11;  // of the largest: what rounding leaves at the rupture boundary
}  // namespace

Film::Film(const FilmProblem &problem, FilmGrid grid, const Film *start) : of(problem), mesh(std::move(grid))
{
  set_rigid();
  const Eigen::Index rows = mesh.rows(), columns = mesh.columns();
  around_factor = mesh.z_width * mesh.gap.cwiseInverse().transpose();
  along_factor.resize(rows + 1, columns);
  const double slender = 1 / (of.length_ratio * of.length_ratio);
  for (Eigen::Index j = 0; j <= rows; ++j)
    along_factor.row(j) = mesh.z_gap[j] > 0 ? Eigen::RowVectorXd(slender / mesh.z_gap[j] * mesh.width.transpose())
                                            : Eigen::RowVectorXd::Zero(columns);
  q = p = Eigen::MatrixXd::Zero(rows, columns);
  slope = Eigen::MatrixXd::Ones(rows, columns);
  active.resize(rows, columns);
  if (start && start->failure() == FilmFailure::none)
    take_start(*start);
  else
    guess();
  for (Eigen::Index i = 0; i < columns; ++i)
    for (Eigen::Index j = 0; j < rows; ++j)
      if (is_held(j, i)) {
        const double held = mesh.held(j, i), a = of.pressure_viscosity;
        active(j, i) = false;
        q(j, i)      = a > 0 ? -std::expm1(-a * held) / a : held;
      }
  if (least_rigid_film(of) < least_film)  // at the ends there is no pressure and no deflection
    failed = FilmFailure::touching;
  else
    solve();
}

void Film::set_rigid()
{
  rigid.around.resize(mesh.rows(), mesh.columns());
  rigid.along.resize(mesh.rows() + 1, mesh.columns());
  for (Eigen::Index i = 0; i < mesh.columns(); ++i) {
    for (Eigen::Index j = 0; j < mesh.rows(); ++j)
      rigid.around(j, i) = rigid_film(of, mesh.angle[i] + mesh.gap[i] / 2, mesh.z[j]);
    for (Eigen::Index j = 0; j <= mesh.rows(); ++j)
      rigid.along(j, i) = rigid_film(of, mesh.angle[i], face_place(j));
  }
}

double Film::face_place(const Eigen::Index j) const
{
  return j < mesh.rows() ? mesh.z[j] - mesh.z_gap[j] / 2 : mesh.z[j - 1] + mesh.z_gap[j] / 2;
}

// The converging half: from the widest gap to the narrowest one.
void Film::guess()
{
  if (!of.ruptures) {
    active.setConstant(true);
    return;
  }
  for (Eigen::Index i = 0; i < mesh.columns(); ++i)
    for (Eigen::Index j = 0; j < mesh.rows(); ++j)
      active(j, i) = rigid.around(j, i) < rigid.around(j, i > 0 ? i - 1 : mesh.columns() - 1);
}

void Film::take_start(const Film &start)
{
  const Eigen::Index ratio = mesh.columns() / start.mesh.columns(), rows = start.mesh.rows();
  const bool half = mesh.mirror > 1;
  if (ratio < 1 || ratio * start.mesh.columns() != mesh.columns())
    return guess();
  for (Eigen::Index i = 0; i < mesh.columns(); ++i)
    for (Eigen::Index j = 0; j < mesh.rows(); ++j) {
      const Eigen::Index from = std::clamp<Eigen::Index>(half ? j / ratio : (j + 1) / ratio - 1, 0, rows - 1);
      active(j, i)            = start.active(from, i / ratio);
      q(j, i)                 = start.q(from, i / ratio);
    }
}

// p of the reduced pressure by Barus' law, theory.md (29.4), its slope, and the film under it.
void Film::update_pressure()
{
  const double a = of.pressure_viscosity;
  if (a > 0) {
    p     = -(-a * q.array()).log1p() / a;
    slope = (1 - a * q.array()).inverse();
  } else {
    p     = q;
    slope = Eigen::MatrixXd::Ones(q.rows(), q.cols());
  }
}

template <class Visit> void Film::each_face(const Visit &visit) const
{
  for (Eigen::Index i = 0; i < mesh.columns(); ++i) {
    for (Eigen::Index j = 0; j < mesh.rows(); ++j)
      visit(Face{{j, i}, {j, next(i)}, rigid.around(j, i), around_factor(j, i), 6 * mesh.z_width[j], true});
    for (Eigen::Index j = 0; j <= mesh.rows(); ++j)
      if (along_factor(j, i) > 0)
        visit(Face{{j - 1, i}, {j, i}, rigid.along(j, i), along_factor(j, i), 0, false});
  }
}

double Film::at(const Eigen::MatrixXd &field, const Node &node) const
{
  return node.row >= 0 && node.row < mesh.rows() ? field(node.row, node.column) : 0;
}

Eigen::Index Film::place_of(const Node &node) const
{
  return node.row >= 0 && node.row < mesh.rows() ? place(node.row, node.column) : -1;
}

double Film::film_at(const Face &f) const
{
  return f.rigid + of.compliance / 2 * (at(p, f.a) + at(p, f.b));
}

// What flows out of every control volume: theory.md (29.3).
Eigen::MatrixXd Film::balance() const
{
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(mesh.rows(), mesh.columns());
  each_face([&](const Face &f) {
    const double film = film_at(f),
                 flow = f.couette * film - f.factor * film * film * film * (at(q, f.b) - at(q, f.a));
    if (f.a.row >= 0)
      out(f.a.row, f.a.column) += flow;
    if (f.b.row < mesh.rows())
      out(f.b.row, f.b.column) -= flow;
  });
  return out;
}

// Active nodes column by column; the first column after one that carries nothing.  A film that carries all round
// goes out to both sides at once, which doubles the band.
void Film::order_nodes()
{
  const Eigen::Index columns = mesh.columns();
  std::vector<Eigen::Index> order(std::size_t(columns), 0);
  Eigen::Index empty = 0;
  while (empty < columns && active.col(empty).any())
    ++empty;
  for (Eigen::Index k = 0; k < columns; ++k)
    order[std::size_t(k)] =
        empty < columns ? (empty + k) % columns : (k % 2 ? (k + 1) / 2 : (columns - k / 2) % columns);
  place.resize(mesh.rows(), columns);
  place.setConstant(-1);
  nodes.clear();
  for (const Eigen::Index i : order)
    for (Eigen::Index j = 0; j < mesh.rows(); ++j)
      if (active(j, i)) {
        place(j, i) = Eigen::Index(nodes.size());
        nodes.push_back({j, i});
      }
}

// How much nearer than the next node the film ends behind its last node: theory.md (29.8).
double Film::nearer_rupture(const Face &f, const Node &last) const
{
  const bool forwards = last.row == f.a.row && last.column == f.a.column;
  const Node &beyond  = forwards ? f.b : f.a;
  if (beyond.row < 0 || beyond.row >= mesh.rows() || is_held(beyond.row, beyond.column))
    return 1;
  Node before = last;
  if (f.around)
    before.column = forwards ? (last.column > 0 ? last.column - 1 : mesh.columns() - 1) : next(last.column);
  else
    before.row += forwards ? -1 : 1;
  const double bend = at(q, before) - 2 * at(q, last);
  return bend > 0 ? 1 / std::clamp(0.5 + at(q, last) / bend, 0.5, 1.5) : 1;
}

Eigen::Index Film::band_width() const
{
  Eigen::Index width = 1;
  each_face([&](const Face &f) {
    const Eigen::Index a = place_of(f.a), b = place_of(f.b);
    if (a >= 0 && b >= 0)
      width = std::max(width, std::abs(a - b));
  });
  return width;
}

// Jacobian of balance() on the active nodes, factored.
void Film::factor_balance(const bool between_nodes)
{
  factored.emplace(Eigen::Index(nodes.size()), band_width());
  const double c = of.compliance / 2;
  each_face([&](const Face &f) {
    const Eigen::Index a = place_of(f.a), b = place_of(f.b);
    if (a < 0 && b < 0)
      return;
    const double film = film_at(f), g = f.factor * film * film * film;
    const double by_film = c * (f.couette - 3 * f.factor * film * film * (at(q, f.b) - at(q, f.a)));
    const double by_a = g + by_film * at(slope, f.a), by_b = by_film * at(slope, f.b) - g;
    if (a >= 0 && b >= 0) {
      factored->at(a, a) += by_a;
      factored->at(a, b) += by_b;
      factored->at(b, a) -= by_a;
      factored->at(b, b) -= by_b;
    } else if (a >= 0)
      factored->at(a, a) += by_a + (between_nodes ? (nearer_rupture(f, f.a) - 1) * g : 0);
    else
      factored->at(b, b) -= by_b - (between_nodes ? (nearer_rupture(f, f.b) - 1) * g : 0);
  });
  factored->factor();
}

void Film::place_rupture()
{
  if (failed == FilmFailure::none)
    factor_balance(true);
}

// Nodes that pull leave the film, nodes into which more flows than out of them join it.
bool Film::move_boundary(const Eigen::MatrixXd &rest)
{
  if (!of.ruptures)
    return false;
  const double small_q = least_pressure * std::max(q.maxCoeff(), 1e-300);
  const double small_r = least_pressure * 6 * mesh.z_width.maxCoeff() * mesh.gap.maxCoeff();
  bool moved           = false;
  for (Eigen::Index i = 0; i < mesh.columns(); ++i)
    for (Eigen::Index j = 0; j < mesh.rows(); ++j) {
      if (is_held(j, i))
        continue;
      const bool was = active(j, i), is = was ? q(j, i) > -small_q : rest(j, i) < -small_r;
      if (is == was)
        continue;
      moved        = true;
      active(j, i) = is;
      q(j, i)      = 0;
    }
  return moved;
}

void Film::solve()
{
  const bool linear = of.compliance == 0;
  const double a    = of.pressure_viscosity;
  for (Eigen::Index i = 0; i < mesh.columns(); ++i)
    for (Eigen::Index j = 0; j < mesh.rows(); ++j)
      if (!active(j, i) && !is_held(j, i))
        q(j, i) = 0;
  for (steps = 1; steps <= most_steps; ++steps) {
    if (!linear)
      update_pressure();
    order_nodes();
    factor_balance(false);
    const Eigen::MatrixXd rest = balance();
    Eigen::VectorXd step(Eigen::Index(nodes.size()));
    for (std::size_t k = 0; k < nodes.size(); ++k)
      step[Eigen::Index(k)] = -rest(nodes[k].first, nodes[k].second);
    factored->solve(step);
    double part = 1;
    if (!linear && a > 0)  // not beyond the pressure at which Barus' law has no bound
      for (std::size_t k = 0; k < nodes.size(); ++k)
        if (const double dq = step[Eigen::Index(k)]; dq > 0)
          part = std::min(part, 0.5 * (1 / a - q(nodes[k].first, nodes[k].second)) / dq);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      q(nodes[k].first, nodes[k].second) += part * step[Eigen::Index(k)];
    if (!step.allFinite())
      break;
    const bool small = linear || (part == 1 && step.size() > 0 &&
                                  step.cwiseAbs().maxCoeff() <= 1e-10 * std::max(q.maxCoeff(), 1e-300));
    if (!linear)
      update_pressure();
    if (!move_boundary(balance()) && (small || step.size() == 0))
      return settle();
  }
  failed = FilmFailure::no_convergence;
}

// Pressure, film and factor of the state that was found.
void Film::settle()
{
  if (of.ruptures)
    q = q.cwiseMax(0);
  if (of.pressure_viscosity > 0 && of.pressure_viscosity * q.maxCoeff() >= 1) {
    failed = FilmFailure::unbounded_pressure;
    return;
  }
  update_pressure();
  h.resize(q.rows(), q.cols());
  for (Eigen::Index i = 0; i < mesh.columns(); ++i)
    for (Eigen::Index j = 0; j < mesh.rows(); ++j)
      h(j, i) = rigid_film(of, mesh.angle[i], mesh.z[j]) + of.compliance * p(j, i);
  if (h.minCoeff() < least_film)
    failed = FilmFailure::touching;
  else if (of.compliance > 0)  // the last step moved the state by rounding only, but the factor is that before it
    factor_balance(false);
}

// Change of the pressure itself, not of the reduced one.
Eigen::MatrixXd Film::response(const Opening &opening, const Eigen::MatrixXd &squeeze) const
{
  Eigen::VectorXd x = Eigen::VectorXd::Zero(Eigen::Index(nodes.size()));
  each_face([&](const Face &f) {
    const Eigen::Index a = place_of(f.a), b = place_of(f.b);
    if (a < 0 && b < 0)
      return;
    const Eigen::Index i = f.a.column;
    const double change  = f.around ? opening(mesh.angle[i] + mesh.gap[i] / 2, mesh.z[f.a.row])
                                    : opening(mesh.angle[i], face_place(f.b.row));
    const double film    = film_at(f);
    const double flow    = (f.couette - 3 * f.factor * film * film * (at(q, f.b) - at(q, f.a))) * change;
    if (a >= 0)
      x[a] -= flow;
    if (b >= 0)
      x[b] += flow;
  });
  if (squeeze.size() > 0)
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto &[j, i] = nodes[k];
      x[Eigen::Index(k)] -= 12 * squeeze(j, i) * mesh.width[i] * mesh.z_width[j];
    }
  factored->solve(x);
  Eigen::MatrixXd dp = Eigen::MatrixXd::Zero(q.rows(), q.cols());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto &[j, i] = nodes[k];
    dp(j, i)           = slope(j, i) * x[Eigen::Index(k)];
  }
  return dp;
}

// Through the faces next to the ends, and what the strips behind them add: theory.md (29.9).
double Film::side_flow() const
{
  const Eigen::Index rows = mesh.rows();
  double flow             = 0;
  const auto end          = [&](const Eigen::Index j, const Eigen::Index face) {
    for (Eigen::Index i = 0; i < mesh.columns(); ++i) {
      const double film = rigid.along(face, i) + of.compliance / 2 * p(j, i);
      flow += along_factor(face, i) * film * film * film * q(j, i);
      if (active(j, i) && !is_held(j, i)) {
        const Eigen::Index previous = i > 0 ? i - 1 : mesh.columns() - 1;
        flow -= 6 * (rigid.around(j, i) - rigid.around(j, previous)) * mesh.z_gap[face] / 2;
      }
    }
  };
  end(rows - 1, rows);
  if (mesh.mirror == 1)
    end(0, 0);
  return mesh.mirror * flow / 12;
}
}  // namespace mill::bearing
