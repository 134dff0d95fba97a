#pragma once
#include "fem/strip/bite_answers.h"
#include "reduce/bite/slab/path_stiffness.h"
#include <functional>
#include <optional>

// What is read off the answers to one pass: K4 and the errors of all numbers.
namespace mill::fem {
/// What is not known of one number of the chosen model, relative: the largest of
///   finite elements: what the coarser mesh changes (1.5), and the distance to the same number by the slab theory;
///   slab theory: the distance to the same number by the finite elements and by the other theories;
///   free arc: what the mesh error of the roll's section does to the same number, by the slab on a softer section;
///   circle beyond Hitchcock's range: the distance to the same number by the slab on the free arc.
/// nan where one of these is needed and is missing: then the error is not known.
/// @param coarse  the number on the coarse mesh, nan: there was none
/// @param same    the number in another model's answer
double bite_error(const BiteStudy &study, double value, double coarse,
                  const std::function<double(const BiteAnswer &)> &same);

/// Whether flow stress and friction give the force of the question.  Beyond a tenth they are those of another
/// force, and K4 with them; a strip that was fitted to the force is within three standard deviations of it.
bool agrees_with_force(const BiteStudy &study);
bool is_fitted(const BiteStudy &study);

/// Thickness of the strip.
struct StripThickness {
  double leaving;   ///< m, of the strip that leaves the stand
  double smallest;  ///< m, under the rolls; NaN where the chosen model does not tell it from the former
};
StripThickness strip_thickness(const BiteStudy &study);

/// Whether the chosen answer is on an arc that is not a circle: strip.exit_thickness is the smallest thickness
/// there.
bool on_free_arc(const BiteStudy &study);

/// The four quantities called K4 of the chosen answer, N/m; errors are relative, NaN: not known.
struct SpringNumbers {
  double plastic_slope_error;               ///< -, relative
  double flattening_error;                  ///< -, the closed form against the section of the roll
  double combined_error;                    ///< -, with that of the flattening in series
  std::optional<bite::PathStiffness> path;  ///< nodal forces over how far the roll deflects; none: a rigid roll,
                                            ///< or no finite elements
};
SpringNumbers spring_numbers(const BiteStudy &study);
}  // namespace mill::fem
