#include "fem/body/component_modes.h"
#include "core/base/errors.h"
#include "fem/body/lowest_modes.h"
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace mill::fem {
namespace {
// T and M of a part in units that make eigenvalues of order one, for every size and unit of the body.
struct ScaledPart {
  const PartModel *part;
  double force, mass;  // N/m, kg
  explicit ScaledPart(const PartModel &p) : part(&p), force(p.body().stiffness_unit()), mass(p.mass() / p.copies())
  {
  }
  SymmetricOperator mass_operator() const
  {
    return [this](const Eigen::VectorXd &u) -> Eigen::VectorXd { return part->mass_times(u) / mass; };
  }
  // Frequencies in Hz, shapes of modal mass 1 kg for the whole body.
  void to_si(LowestModes &modes) const
  {
    modes.frequency /= 2 * M_PI * part->time_unit();
    modes.shapes /= std::sqrt(part->copies() * mass);
  }
};

LowestModes fixed_interface_modes(const ScaledPart &scaled, const BorderedPart &bordered, const int n_interface,
                                  const int n_modes)
{
  const PartModel &part     = *scaled.part;
  const SymmetricOperator T = [&](const Eigen::VectorXd &f) -> Eigen::VectorXd {
    return scaled.force * bordered.held_solve(f);
  };
  const int rank    = part.n_unknowns() + int(part.support().rigid.cols()) - n_interface;
  LowestModes modes = lowest_modes("fixed-interface modes of the " + part.name(), T, scaled.mass_operator(),
                                   3 * int(part.body().nodes().rows()), rank, n_modes);
  scaled.to_si(modes);
  return modes;
}

double squared(const double frequency)
{
  return std::pow(2 * M_PI * frequency, 2);
}

// The part of the component that depends on how many modes are kept.
struct Kept {
  Eigen::VectorXd frequency;  // Hz
  Eigen::MatrixXd coupling;   // (n_i, n_m) kg
  Eigen::MatrixXd residual;   // (n_i, n_i) kg s2
};

// (21.9): what all modes contribute, without the share of those that are kept.
Kept keep(const LowestModes &modes, const Eigen::MatrixXd &coupling, const Eigen::MatrixXd &all, const int n)
{
  Kept kept{modes.frequency.head(n), coupling.leftCols(n), all};
  for (int k = 0; k < n; ++k)
    kept.residual -= kept.coupling.col(k) * kept.coupling.col(k).transpose() / squared(kept.frequency[k]);
  return kept;
}

// (21.10).  A mode of an assembly, mass-normalised, has no more kinetic energy in this body than one half and no
// more strain energy than w^2 / 2: two quadratic forms of its interface part q, and every mean of the two, bound
// it.
double largest_share(const Eigen::MatrixXd &M_ii, const Eigen::MatrixXd &K_ii, const Kept &kept,
                     const double frequency)
{
  Eigen::MatrixXd M = M_ii;
  for (Eigen::Index k = 0; k < kept.frequency.size(); ++k)
    if (kept.frequency[k] < frequency / std::sqrt(2.))
      M -= kept.coupling.col(k) * kept.coupling.col(k).transpose();
  double least = std::numeric_limits<double>::infinity();
  for (const double share : {0.95, 0.8, 0.6, 0.4, 0.2, 0.05}) {
    const Eigen::MatrixXd bound = share * M + (1 - share) / squared(frequency) * K_ii;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> largest(kept.residual, bound,
                                                                            Eigen::EigenvaluesOnly);
    least = std::min(least, largest.eigenvalues().maxCoeff());
  }
  return 0.5 * squared(frequency) * std::max(0., least);
}
}  // namespace

double residual_share(const Component &c, const double frequency)
{
  const Eigen::Index n_i = c.n_interface();
  return largest_share(c.M.topLeftCorner(n_i, n_i), c.K.topLeftCorner(n_i, n_i),
                       {c.fixed_frequency, c.M.topRightCorner(n_i, c.fixed_frequency.size()), c.residual},
                       frequency);
}

Component component_modes(const PartModel &part, const PartInterface &interface, const ModeChoice &choice,
                          ComponentBasis *basis)
{
  if (choice.reach > 0 && choice.frequency_limit > choice.reach)
    throw InputError("the frequency limit of " + std::to_string(int(choice.frequency_limit)) +
                     " Hz is above what the mesh of the " + part.name() + " can follow, " +
                     std::to_string(int(choice.reach)) +
                     " Hz (four elements per wave): lower the limit or use a finer mesh");
  const BorderedPart bordered(part, interface);
  const ScaledPart scaled(part);
  const int copies           = part.copies();
  const int n_i              = int(interface.weights.cols());
  const Eigen::MatrixXd &Psi = bordered.constraint_modes;
  const Eigen::MatrixXd MPsi = part.mass_times(Psi);
  const Eigen::MatrixXd M_ii = copies * Psi.transpose() * MPsi;
  const Eigen::MatrixXd K_ii = copies * bordered.reactions;
  Eigen::MatrixXd all        = copies * MPsi.transpose() * bordered.held_solve(MPsi);
  all                        = 0.5 * (all + all.transpose()).eval();

  LowestModes modes;
  Kept kept;
  const auto solve = [&](const int n) {
    modes = fixed_interface_modes(scaled, bordered, n_i, n);
    return Eigen::MatrixXd(copies * MPsi.transpose() * modes.shapes);
  };
  if (choice.n_modes >= 0) {
    const Eigen::MatrixXd coupling = solve(choice.n_modes);
    kept                           = keep(modes, coupling, all, choice.n_modes);
  } else {
    const auto enough = [&](const Kept &k) {
      return modes.frequency[k.frequency.size()] >= 2 * choice.frequency_limit &&
             largest_share(M_ii, K_ii, k, choice.frequency_limit) <= choice.residual_share;
    };
    bool complete = false;
    for (int asked = 10; !complete; asked *= 2) {
      const Eigen::MatrixXd coupling = solve(asked);
      for (int n = 0; n < asked && !complete; ++n)
        complete = enough(kept = keep(modes, coupling, all, n));
    }
  }

  const int n_m = int(kept.frequency.size()), n = n_i + n_m;
  Component c;
  c.name   = part.name();
  c.source = "finite elements, " + std::to_string(part.n_unknowns()) + " unknowns" +
             (copies == 8   ? " of an eighth"
              : copies == 4 ? " of a quarter"
                            : "");
  c.interface = interface.names;
  c.M.setIdentity(n, n);
  c.M.topLeftCorner(n_i, n_i)    = 0.5 * (M_ii + M_ii.transpose());
  c.M.topRightCorner(n_i, n_m)   = kept.coupling;
  c.M.bottomLeftCorner(n_m, n_i) = kept.coupling.transpose();
  c.K.setZero(n, n);
  c.K.topLeftCorner(n_i, n_i) = K_ii;
  for (int k = 0; k < n_m; ++k)
    c.K(n_i + k, n_i + k) = squared(kept.frequency[k]);
  c.fixed_frequency = kept.frequency;
  c.residual        = kept.residual;
  c.mass            = part.mass();
  c.reach           = choice.reach;
  if (basis)
    *basis = {Psi, modes.shapes.leftCols(n_m)};
  return c;
}

FreeModes free_modes(const PartModel &part, const int n_modes)
{
  const ScaledPart scaled(part);
  const Eigen::MatrixXd &R = part.support().rigid;
  const Eigen::MatrixXd MR = part.mass_times(R);
  const Eigen::MatrixXd inverse =
      R.cols() > 0 ? Eigen::MatrixXd((R.transpose() * MR).inverse()) : Eigen::MatrixXd(0, 0);
  const SymmetricOperator T = [&](const Eigen::VectorXd &f) -> Eigen::VectorXd {  // (21.8)
    const Eigen::VectorXd u = part.solve(f - MR * (inverse * (R.transpose() * f)));
    return scaled.force * (u - R * (inverse * (MR.transpose() * u)));
  };
  LowestModes modes = lowest_modes("free modes of the " + part.name(), T, scaled.mass_operator(),
                                   3 * int(part.body().nodes().rows()), part.n_unknowns(), n_modes);
  scaled.to_si(modes);
  return {modes.frequency, modes.shapes};
}
}  // namespace mill::fem
