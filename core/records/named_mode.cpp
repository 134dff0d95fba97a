#include "core/records/named_mode.h"
#include <utility>

namespace mill {
namespace {
constexpr const char *before_why = ": ", *before_model = "; ";

// The text before `position` and the one after the two characters there; all of it before, where nothing is found.
std::pair<std::string, std::string> parted(const std::string &text, const std::size_t position)
{
  if (position == std::string::npos)
    return {text, ""};
  return {text.substr(0, position), text.substr(position + 2)};
}
}  // namespace

std::string mode_method(const NamedMode &mode)
{
  return mode.name + before_why + mode.why + before_model + mode.model;
}

NamedMode named_mode_of(const std::string &method)
{
  const auto [name, rest] = parted(method, method.find(before_why));
  const auto [why, model] = parted(rest, rest.rfind(before_model));  // a semicolon may be in the reason
  return {name, why, model};
}

std::optional<ResultWord> gap_kind_of(const std::string &mode)
{
  for (const ResultWord kind : {ResultWord::gap_first_kind, ResultWord::gap_second_kind})
    if (is_word(mode, kind) || mode.rfind(word_of(kind) + std::string("_"), 0) == 0)
      return kind;
  return std::nullopt;
}
}  // namespace mill
