#include "core/case/kinds.h"
#include "core/case/stand_reader.h"
#include "core/case/stand_sections.h"

namespace mill {
const CaseKind &case_kind(const BiteCase *)
{
  static const CaseKind kind = [] {
    CaseKind k;
    using Repeat = SectionRows::Repeat;
    k.name       = word_of(KindOfCase::bite);
    k.title      = "roll bite";
    k.read       = [](const Node &root, Reading &reading) -> CaseSpec { return read_bite_case(root, reading); };
    k.sections   = {head_section(),
                    steel_section(),
                    {"work_roll", Repeat::once, true, "both work rolls", rows_of(bite_roll_rows())}};
    for (const SectionRows &section : strip_sections())
      k.sections.push_back(section);
    k.sections.push_back(
        {"pass", Repeat::list, true, "one pass, where it differs from the strip", rows_of(bite_pass_rows())});
    k.sections.push_back(bite_section());
    k.sections.push_back(published_section(bite_published_rows()));
    k.notes = {
        {"strip.flow_stress", "", {}, {"k"}}, {"strip.friction", "", {}, {}, true}  // [strip] says it in a number
    };
    k.given = k.published = bite_published_rows();
    k.repeated            = [](const CaseSpec &spec, const std::string &section) {
      const auto &the_case = std::get<BiteCase>(spec);
      return section == "pass" ? numbers_to(the_case.passes.size()) : std::vector<std::string>();
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
