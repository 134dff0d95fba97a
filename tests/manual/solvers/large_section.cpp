#include "tests/manual/solvers/large_section.h"
#include "core/base/errors.h"
#include <Eigen/Eigenvalues>
#include <cmath>

namespace mill::fem {
namespace {
using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Principal second Piola-Kirchhoff stresses and their derivatives with respect to the principal Green's strains.
struct Principal {
  Vector2d S;
  Matrix2d dS;
};

// @param c  principal values of F^T F: squares of the stretches
Principal principal_stress(const double lambda, const double mu, const ElasticLaw law, const Vector2d &c)
{
  const double ln_J = 0.5 * std::log(c[0] * c[1]);
  Principal out;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const double same = i == j;
      switch (law) {
      case ElasticLaw::hencky:  // S_i = (lambda ln J + mu ln c_i) / c_i ,  d ln c_i / dE_i = 2 / c_i
        out.S[i]     = (lambda * ln_J + mu * std::log(c[i])) / c[i];
        out.dS(i, j) = (lambda + 2 * mu * same) / (c[i] * c[j]) - 2 * same * out.S[i] / c[i];
        break;
      case ElasticLaw::biot: {  // S_i = (lambda (l_1 + l_2 - 2) + 2 mu (l_i - 1)) / l_i ,  d l_i / dE_i = 1 / l_i
        const Vector2d l = c.cwiseSqrt();
        out.S[i]         = (lambda * (l.sum() - 2) + 2 * mu * (l[i] - 1)) / l[i];
        out.dS(i, j)     = (lambda + 2 * mu * same) / (l[i] * l[j]) - same * out.S[i] / c[i];
        break;
      }
      case ElasticLaw::st_venant_kirchhoff:
        out.S[i]     = 0.5 * lambda * (c.sum() - 2) + mu * (c[i] - 1);
        out.dS(i, j) = lambda + 2 * mu * same;
        break;
      case ElasticLaw::neo_hooke:
        out.S[i]     = mu + (lambda * ln_J - mu) / c[i];
        out.dS(i, j) = lambda / (c[i] * c[j]) - 2 * same * (lambda * ln_J - mu) / (c[i] * c[i]);
        break;
      }
    }
  return out;
}
}  // namespace

LargeStress large_stress(const Material &material, const ElasticLaw law, const Matrix2d &F)
{
  if (!(F.determinant() > 0))
    throw SolverError({"large displacements: a cell is turned inside out", "", "a load step that is too large", "",
                       "load in smaller steps"});
  const double mu     = material.youngs_modulus / (2 * (1 + material.poisson_ratio)),
               lambda = 2 * mu * material.poisson_ratio / (1 - 2 * material.poisson_ratio);
  const Eigen::SelfAdjointEigenSolver<Matrix2d> eigen(F.transpose() * F);
  const Vector2d c  = eigen.eigenvalues();
  const Principal p = principal_stress(lambda, mu, law, c);
  // Stress and strain turn alike: in principal axes shear has the modulus (S1 - S2)/(c1 - c2), or its limit.
  Matrix3d D              = Matrix3d::Zero();
  D.topLeftCorner<2, 2>() = p.dS;
  D(2, 2)                 = std::abs(c[0] - c[1]) > 1e-6 ? (p.S[0] - p.S[1]) / (c[0] - c[1])
                                                         : 0.25 * (p.dS(0, 0) - p.dS(0, 1) + p.dS(1, 1) - p.dS(1, 0));
  const Matrix2d &N       = eigen.eigenvectors();
  Matrix3d R;  // strains (xx, yy, 2 xy) to principal axes
  for (int i = 0; i < 2; ++i)
    R.row(i) << N(0, i) * N(0, i), N(1, i) * N(1, i), N(0, i) * N(1, i);
  R.row(2) << 2 * N(0, 0) * N(0, 1), 2 * N(1, 0) * N(1, 1), N(0, 0) * N(1, 1) + N(1, 0) * N(0, 1);
  return {R.transpose() * Vector3d(p.S[0], p.S[1], 0), R.transpose() * D * R};
}

LargeForces large_forces(const SectionBody &body, const Material &material, const ElasticLaw law,
                         const Eigen::VectorXd &displacement)
{
  if (body.section() != Section::plane_strain || displacement.size() != body.stiffness().rows())
    throw InputError(
        "large displacements: a plane-strain body and a displacement of each of its unknowns are needed");
  LargeForces out{Eigen::VectorXd::Zero(displacement.size()), body.stiffness()};
  Eigen::Map<Eigen::ArrayXd>(out.tangent.valuePtr(), out.tangent.nonZeros()).setZero();
  Eigen::MatrixXd u, K, B;
  Eigen::VectorXd f;
  body.each_cell([&](const std::vector<int> &nodes, const std::vector<CellPoint> &points) {
    const auto n = Eigen::Index(nodes.size());
    u.resize(2, n);
    for (Eigen::Index a = 0; a < n; ++a)
      u.col(a) = displacement.segment<2>(2 * nodes[a]);
    K.setZero(2 * n, 2 * n);
    f.setZero(2 * n);
    B.resize(3, 2 * n);
    for (const CellPoint &point : points) {
      const Matrix2d F    = Matrix2d::Identity() + u * point.gradient;
      const LargeStress s = large_stress(material, law, F);
      for (Eigen::Index a = 0; a < n; ++a) {
        const double x = point.gradient(a, 0), y = point.gradient(a, 1);
        for (int c = 0; c < 2; ++c)
          B.col(2 * a + c) << F(c, 0) * x, F(c, 1) * y, F(c, 0) * y + F(c, 1) * x;
      }
      f += point.weight * (B.transpose() * s.stress);
      K += point.weight * (B.transpose() * (s.tangent * B));
      // The stress that is already there turns with the material.
      const Matrix2d S            = (Matrix2d() << s.stress[0], s.stress[2], s.stress[2], s.stress[1]).finished();
      const Eigen::MatrixXd turns = point.weight * (point.gradient * S * point.gradient.transpose());
      for (Eigen::Index b = 0; b < n; ++b)
        for (Eigen::Index a = 0; a < n; ++a)
          for (int c = 0; c < 2; ++c)
            K(2 * a + c, 2 * b + c) += turns(a, b);
    }
    for (Eigen::Index j = 0; j < 2 * n; ++j) {
      const int column = 2 * nodes[j / 2] + int(j % 2);
      out.force[column] += f[j];
      for (Eigen::Index i = 0; i < 2 * n; ++i)
        if (const int row = 2 * nodes[i / 2] + int(i % 2); row <= column)
          out.tangent.coeffRef(row, column) += K(i, j);
    }
  });
  return out;
}
}  // namespace mill::fem
