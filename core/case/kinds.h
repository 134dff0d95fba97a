#pragma once
#include "core/case/stand_rows.h"
#include "core/model/bearing_case.h"
#include "core/model/bite_case.h"
#include "core/model/case.h"
#include "core/model/four_high.h"
#include "core/model/kind_of_case.h"
#include "core/model/lumped.h"
#include "core/model/pass.h"
#include "core/model/stack_case.h"
#include "core/model/two_cylinders.h"
#include <map>
#include <string>
#include <vector>

// The kinds of case.  Each stands in a file of core/case/kinds; the list of them is Case::spec.
namespace mill {
using CaseSpec = decltype(Case::spec);

/// What the template of a kind says of one section beyond the examples of its rows, so that it runs without any
/// other file.  A section that is named twice stands twice in the template.
struct TemplateNote {
  std::string section;                        ///< its id
  std::string header;                         ///< "[bearing.trb]"; empty: that of the section
  std::map<std::string, std::string> values;  ///< TOML, instead of the example
  std::vector<std::string> shown;             ///< optional keys that are set all the same
  bool off = false;                           ///< every line a comment: something else says it already
};

/// A value that stands on a drawing or in a record, and where.
struct DrawingValue {
  std::string section, key;  ///< id of the section
  std::string where;         ///< "roll drawing: .."
};

/// One kind of case: all that reading and describing it needs.
struct CaseKind {
  std::string name;   ///< "four-high"
  std::string title;  ///< of its template
  CaseSpec (*read)(const Node &root, Reading &reading);
  std::vector<SectionRows> sections;
  std::vector<TemplateNote> notes;  ///< of the sections that need one
  std::vector<DrawingValue>
      drawing;                 ///< part one of its template, in the order in which one reads; empty: one part
  std::vector<Row> given;      ///< of [given], without tolerances
  std::vector<Row> published;  ///< of [published]
  /// Names of the sections of a case that repeat, by their id: bearings, or "0", "1" for those in double brackets.
  std::vector<std::string> (*repeated)(const CaseSpec &spec, const std::string &section) = nullptr;
};

/// One line for each alternative of Case::spec; without it nothing compiles.
const CaseKind &case_kind(const FourHigh *);
const CaseKind &case_kind(const Lumped *);
const CaseKind &case_kind(const TwoCylinders *);
const CaseKind &case_kind(const BearingCase *);
const CaseKind &case_kind(const BiteCase *);
const CaseKind &case_kind(const ChatterCase *);
const CaseKind &case_kind(const ClusterCase *);
const CaseKind &case_kind(const StackCase *);

const std::vector<const CaseKind *> &all_kinds();     ///< those this version reads
const CaseKind &kind_named(const std::string &name);  ///< one of them
const CaseKind &kind_of(const Case &the_case);

/// Passes and bearings of a case; of a kind without them, none.
const std::vector<Pass> &all_passes(const Case &the_case);
const std::vector<RollerBearing> &all_bearings(const Case &the_case);

/// "bearing" -> its names, "pass" -> "0", "1"; empty where the kind has none.
std::vector<std::string> repeated_sections(const Case &the_case, const std::string &section);

/// Names of the members of a list, and their numbers, for CaseKind::repeated.
template <class List> std::vector<std::string> names_in(const List &list)
{
  std::vector<std::string> names;
  for (const auto &one : list)
    names.push_back(one.name);
  return names;
}
/// Roller bearings first.
template <class Spec> std::vector<std::string> bearing_names(const Spec &spec)
{
  std::vector<std::string> names = names_in(spec.bearings);
  for (const OilFilmBearing &film : spec.oil_films)
    names.push_back(film.name);
  return names;
}
std::vector<std::string> numbers_to(std::size_t n);
}  // namespace mill
