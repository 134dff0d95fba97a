#include "core/case/kinds.h"
#include "core/base/require.h"
#include "core/model/stack_input.h"
#include <algorithm>
#include <type_traits>

namespace mill {
namespace {
template <class... Spec> std::vector<const CaseKind *> kinds_in(const std::variant<Spec...> *)
{
  return {&case_kind(static_cast<const Spec *>(nullptr))...};
}

template <class Spec, class = void> struct HasPasses : std::false_type {
};
template <class Spec> struct HasPasses<Spec, std::void_t<decltype(Spec::passes)>> : std::true_type {
};
template <class Spec, class = void> struct HasBearings : std::false_type {
};
template <class Spec> struct HasBearings<Spec, std::void_t<decltype(Spec::bearings)>> : std::true_type {
};
}  // namespace

const std::vector<Pass> &all_passes(const Case &the_case)
{
  static const std::vector<Pass> none;
  return std::visit(
      [](const auto &spec) -> const std::vector<Pass> & {
        if constexpr (HasPasses<std::decay_t<decltype(spec)>>::value)
          return spec.passes;
        else
          return none;
      },
      the_case.spec);
}

const std::vector<RollerBearing> &all_bearings(const Case &the_case)
{
  static const std::vector<RollerBearing> none;
  return std::visit(
      [](const auto &spec) -> const std::vector<RollerBearing> & {
        if constexpr (HasBearings<std::decay_t<decltype(spec)>>::value)
          return spec.bearings;
        else if constexpr (std::is_same_v<std::decay_t<decltype(spec)>, StackCase>)
          return spec.input->bearings;
        else
          return none;
      },
      the_case.spec);
}

const std::vector<const CaseKind *> &all_kinds()
{
  static_assert(std::variant_size_v<CaseSpec> == words_of(KindOfCase()).size(), "each kind has its word");
  static const auto kinds = kinds_in(static_cast<const CaseSpec *>(nullptr));
  return kinds;
}

const CaseKind &kind_named(const std::string &name)
{
  const auto &kinds = all_kinds();
  const auto match  = std::find_if(kinds.begin(), kinds.end(), [&](const CaseKind *k) { return k->name == name; });
  require(match != kinds.end(), "unknown kind " + name);
  return **match;
}

const CaseKind &kind_of(const Case &the_case)
{
  return kind_named(the_case.kind);
}

std::vector<std::string> repeated_sections(const Case &the_case, const std::string &section)
{
  const CaseKind &kind = kind_of(the_case);
  return kind.repeated ? kind.repeated(the_case.spec, section) : std::vector<std::string>();
}

std::vector<std::string> numbers_to(const std::size_t n)
{
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < n; ++i)
    numbers.push_back(std::to_string(i));
  return numbers;
}

const std::vector<std::string> &case_kinds()
{
  static const auto names = [] {
    std::vector<std::string> list;
    for (const CaseKind *kind : all_kinds())
      list.push_back(kind->name);
    return list;
  }();
  return names;
}

const std::vector<SectionRows> &sections_of(const std::string &kind)
{
  return kind_named(kind).sections;
}

const std::vector<Row> &given_rows(const std::string &kind, const bool published)
{
  return published ? kind_named(kind).published : kind_named(kind).given;
}
}  // namespace mill
