#include "app/command/described_verbs.h"
#include <CLI/CLI.hpp>
#include <algorithm>

namespace mill {
namespace {
DescribedOption described_option(const CLI::Option &option)
{
  DescribedOption d;
  d.named = option.nonpositional();
  for (const std::string &name : option.get_snames())
    d.names.push_back("-" + name);
  for (const std::string &name : option.get_lnames())
    d.names.push_back("--" + name);
  if (!d.named)
    d.names = {option.get_name(true)};
  d.takes   = option.get_items_expected_max() > 0;
  d.needed  = option.get_required();
  d.meaning = option.get_description();
  return d;
}
}  // namespace

bool is_long(const std::string &option)
{
  return option.rfind("--", 0) == 0;
}

std::vector<std::string> DescribedVerb::long_names() const
{
  std::vector<std::string> list;
  for (const DescribedOption &option : options)
    for (const std::string &word : option.names)
      if (is_long(word))
        list.push_back(word);
  return list;
}

std::vector<DescribedVerb> described_verbs(const CLI::App &app)
{
  std::vector<DescribedVerb> verbs;
  for (const CLI::App *verb : app.get_subcommands([](const CLI::App *) { return true; })) {
    DescribedVerb d{verb->get_name(), verb->get_description(), {}};
    for (const CLI::Option *option : verb->get_options())
      d.options.push_back(described_option(*option));
    std::stable_partition(d.options.begin(), d.options.end(), [](const DescribedOption &o) { return !o.named; });
    verbs.push_back(d);
  }
  return verbs;
}
}  // namespace mill
