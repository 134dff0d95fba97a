#pragma once

// Texts that are part of the library, so that an installed program has them: made from files at build time
// (cmake/embed_text.cmake).
namespace mill::embedded {
extern const char *const bearings_csv;  ///< core/case/bearings.csv
// cases/stack-*.toml
extern const char *const stack_two_high;
extern const char *const stack_four_high;
extern const char *const stack_six_high;
extern const char *const stack_twenty_high;
}  // namespace mill::embedded
