#include "core/case/kinds.h"
#include "core/case/stand_reader.h"
#include "core/case/stand_sections.h"

namespace mill {
const CaseKind &case_kind(const BearingCase *)
{
  static const CaseKind kind = [] {
    CaseKind k;
    using Repeat = SectionRows::Repeat;
    k.name       = word_of(KindOfCase::bearing);
    k.title      = "four-row tapered roller bearing";
    k.read       = [](const Node &root, Reading &reading) -> CaseSpec { return read_bearing_case(root, reading); };
    k.sections   = {head_section(),
                    {"bearing", Repeat::named, true, "a roller bearing and its chock", rows_of(bearing_rows())},
                    oil_film_section(),
                    {"load", Repeat::once, true, "what acts on one of them", rows_of(bearing_load_rows())},
                    {"model", Repeat::once, false, "how that one is computed", rows_of(bearing_model_rows())},
                    {"dynamics", Repeat::once, false, "a mass that swings on the bearing's curve",
                     rows_of(bearing_motion_rows())},
                    published_section(bearing_published_rows())};
    k.notes      = {
             {"bearing",
              "[bearing.trb]",
              {},
              {"bore", "outside_diameter", "width", "roller_diameter", "roller_cone_angle", "cup_angle", "profile",
               "chock_width", "chock_height", "chock_length", "chock_support_width", "chock_support_gap"}},
             {"oil-film", "[bearing.oil]", {}, {}, true},
             {"load", "", {}, {"loads"}}};
    k.given = k.published = bearing_published_rows();
    k.repeated            = [](const CaseSpec &spec, const std::string &section) {
      const auto &the_case = std::get<BearingCase>(spec);
      if (section == "oil-film")
        return names_in(the_case.oil_films);
      return section == "bearing" ? names_in(the_case.bearings) : std::vector<std::string>();
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
