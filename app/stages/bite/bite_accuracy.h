#pragma once
#include "app/stages/bite/bite_study.h"
#include <functional>

namespace mill {
/// What is not known of one number of the chosen model, relative: the largest of
///   finite elements: what doubling the elements changes, and the distance to the same number by the slab theory;
///   slab theory: the distance to the same number by the finite elements and by the other theories;
///   free arc: what the mesh error of the roll's section does to the same number, by the slab on a softer section;
///   circle beyond Hitchcock's range: the distance to the same number by the slab on the free arc.
/// nan where one of these is needed and is missing: then the error is not known.
/// @param coarse  the number on the coarse mesh, nan: there was none
/// @param same    the number in another model's answer
double bite_error(const BiteStudy &study, double value, double coarse,
                  const std::function<double(const BiteAnswer &)> &same);

/// |a/b - 1|
double apart(double a, double b);
}  // namespace mill
