#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
}

// Options that several verbs share, each declared in one place.
namespace mill {
struct CommandLine;

void add_output(CLI::App *verb, CommandLine &c, const char *what);  ///< -o
void add_sets(CLI::App *verb, CommandLine &c);                      ///< --set
void add_overwrite(CLI::App *verb, CommandLine &c);                 ///< --force-overwrite
void add_threads(CLI::App *verb, CommandLine &c);                   ///< --threads
void add_cache(CLI::App *verb, CommandLine &c);                     ///< --fresh, --cache
void add_memory(CLI::App *verb, CommandLine &c);                    ///< --memory
void add_kind(CLI::App *verb, CommandLine &c);                      ///< --as
void add_held_case(CLI::App *verb, CommandLine &c);                 ///< --text, --progress-step
void add_common(CLI::App *verb, CommandLine &c);                    ///< what every verb that computes a case takes
void add_record_options(CLI::App *verb, CommandLine &c);            ///< rate, zone, channels, units, sensitivities

/// An option that may be given several times, with one value each time.
void add_repeatable(CLI::App *verb, const char *option, std::vector<std::string> &into, const char *what);

/// Folder of the results and overrides of the case, behind a verb's own options.
/// @param folder, quiet  meanings of -o and -q
void add_folder(CLI::App *verb, CommandLine &c, const char *folder, const char *quiet);

/// --model: which model of a drawing is taken.
void add_model(CLI::App *verb, CommandLine &c, const std::vector<std::string> &models, const char *what);
}  // namespace mill
