#pragma once
#include "core/base/parameter.h"
#include "fem/body/body_pair.h"
#include "fem/body/section_body.h"
#include "fem/contact/active_set.h"
#include "tests/manual/check/verification.h"
#include <Eigen/Core>
#include <string>
#include <vector>

// What the cases on meshed bodies have in common: scratch meshes, plane and meridian bodies, what is read off a
// state.
namespace mill::verify {
/// Path for a mesh that is removed at the end of the scope.
struct ScratchFile {
  explicit ScratchFile(const std::string &name);
  ~ScratchFile();
  ScratchFile(const ScratchFile &) = delete;
  std::string path;
};

/// Rectangle (half width and depth `extent`) with a graded grid: elements of patch / n_patch on the patch, growing
/// away from it.  Symmetry line x or r = 0, base held, other sides free.  The group patch touches.
struct GradedRectangle {
  double patch  = 0;    ///< m, half width of the patch
  int n_patch   = 100;  ///< quadratic elements on it
  double extent = 0;    ///< m
  double growth = 1.3;  ///< -, of neighbouring elements along the surface and into the depth
};
fem::SectionBody half_space_section(const GradedRectangle &size, const Material &material, fem::Section section);
/// Unknowns held by the symmetry line (left) and the base (bottom: both directions).
std::vector<char> held_like_a_half_space(const fem::SectionBody &body);

/// Quarter of a disc as plane-strain body: elements half as wide as smallest / per_half_width at the contact line,
/// growing so that every half width up to `largest` is resolved alike.
fem::SectionBody disc_section(double radius, double smallest, double largest, int per_half_width,
                              const Material &material);

/// Ellipse p^2 = peak^2 (1 - x^2 / half_width^2) through the pressures at the nodes that touch, by least squares
/// in p^2 over x^2, without the outer tenth, where the edge of the contact falls between nodes.
struct Ellipse {
  double peak;        ///< Pa
  double half_width;  ///< m
};
Ellipse fitted_ellipse(const Eigen::VectorXd &x, const Eigen::VectorXd &pressure);

/// Tangent against the central difference of the solver's own curve, and the complementarity residual.
void add_identities(std::vector<Check> &checks, contact::ActiveSet &solver, const contact::State &state);

/// A section condensed onto its group patch, pressed along +y of its own coordinates: bodies that do not conform.
fem::CondensedSurface condensed_patch(const fem::SectionBody &body, const std::vector<char> &held);
/// Unknowns held by the planes symmetry.x and symmetry.y of a quarter section.
std::vector<char> held_quarter(const fem::SectionBody &body);
/// The second body of a pair, upside down, its contact point at the height `shift` (m) of its own coordinates.
fem::PlacedBody upside_down(const fem::CondensedSurface &body, double shift = 0);
fem::DrivenMode master_moves_down();
contact::Loading by_resultant(double value);  ///< N (N/m in plane strain)
contact::Loading prescribed(double value);    ///< m
Ellipse fitted_ellipse(const fem::BodyPair &pair, const contact::State &state);
}  // namespace mill::verify
