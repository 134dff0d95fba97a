#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
}

// The command line as it describes itself: one source of --help, of the manual page and of the completions.
namespace mill {
/// An option, or a word without a name ("CASE").
struct DescribedOption {
  std::vector<std::string> names;   ///< "-o", "--output"; of a word without a name its placeholder
  bool named  = true;               ///< begins with a dash
  bool takes  = false;              ///< has a value
  bool needed = false;              ///< may not be left out
  std::string meaning;              ///< one phrase
  std::vector<std::string> values;  ///< choices that are completed; empty: files or free text
};

struct DescribedVerb {
  std::string name, meaning;
  std::vector<DescribedOption> options;  ///< words without a name first

  std::vector<std::string> long_names() const;  ///< "--output", ... as the completions offer them
};

/// "--pass"; false of "-o".
bool is_long(const std::string &option);

/// Every verb of the command line in its order.
std::vector<DescribedVerb> described_verbs(const CLI::App &app);

/// The manual page, section 1, as text of troff.
/// @param summary  what the program is, one sentence
std::string manual_page(const std::vector<DescribedVerb> &verbs, const std::string &summary,
                        const std::string &version);
}  // namespace mill
