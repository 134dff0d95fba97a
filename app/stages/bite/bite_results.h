#pragma once
#include "app/stages/bite/bite_study.h"
#include "core/case/bite_inputs.h"
#include "core/records/result_row.h"
#include <functional>

namespace mill {
/// The keys behind what is asked of a bite.
using BiteKeys = std::function<KeyList(const BiteReading &reading)>;
/// Those of a pass of the case.
BiteKeys keys_of_bite(const RunContext &run, std::size_t pass);

/// bite.<pass>.* of the chosen model and bite.<pass>.<model>.* of all.
void add_bite_results(RunContext &run, const BiteStudy &study, const BiteKeys &keys);

/// The four quantities called K4 of one pass; the combined one enters the lumped model.
struct BiteSpring {
  Parameter plastic_slope, flattening, combined, path_plateau;
};
BiteSpring bite_spring(const BiteStudy &study, const BiteKeys &keys);
void add_bite_spring(RunContext &run, const BiteSpring &spring);

/// Sentences about the range of the models, what they refused, how far they are apart.
void note_bite(RunContext &run, const BiteStudy &study);
}  // namespace mill
