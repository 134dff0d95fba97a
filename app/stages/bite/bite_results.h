#pragma once
#include "app/stages/bite/bite_study.h"

namespace mill {
/// bite.<pass>.* of the chosen model and bite.<pass>.<model>.* of all.
void add_bite_results(RunContext &run, const BiteStudy &study);

/// The four quantities called K4 of one pass; the combined one enters the lumped model.
struct BiteSpring {
  Parameter plastic_slope, flattening, combined, path_plateau;
};
BiteSpring bite_spring(const BiteStudy &study);
void add_bite_spring(RunContext &run, const BiteSpring &spring);

/// Sentences about the range of the models, what they refused, how far they are apart.
void note_bite(RunContext &run, const BiteStudy &study);
}  // namespace mill
