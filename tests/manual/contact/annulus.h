#pragma once
#include "fem/body/section_body.h"
#include "tests/manual/contact/meshed.h"
#include <Eigen/Core>

namespace mill::verify {
/// a < r < b in plane strain under the pressure cos(m theta) on its inner side.
struct Annulus {
  double a, b;  ///< m
  bool held;    ///< on the outer side; otherwise that is free
};

/// u_r / cos(m theta) on the inner side per unit pressure, m/Pa; m = 0 or >= 2.
/// Michell's solution with the Airy functions r^m, r^-m, r^(m+2), r^(2-m) times cos(m theta); Lame's for m = 0.
/// Source: J. R. Barber, Elasticity, chapters 8 and 9.
double inner_displacement(const Annulus &ring, int m, const Material &material);

/// The same by finite elements: a meridian rectangle whose faces are held in z.
class AnnulusByElements {
public:
  /// @param n_elements  through the wall, roughly; they grow away from the loaded side
  AnnulusByElements(const Annulus &ring, const Material &material, int n_elements);
  double displacement(int m) const;  ///< m/Pa, as inner_displacement

private:
  MeshFile mesh(int n_elements) const;
  Annulus ring;
  ScratchFile file;
  fem::SectionBody body;
  Eigen::MatrixXd load;
};
}  // namespace mill::verify
