#pragma once
#include "core/records/result_row.h"

// One row for each family whose results a page shows, or a user may ask for, even where no row of this version
// makes the name.  They have neither unit nor meaning and are not in docs/output.md.
namespace mill::row::open {
inline constexpr RowOf<2> roll_contact{"{roll_contact}.{key}", "", "", ""};
inline constexpr RowOf<1> bite_spring{"K4.{key}", "", "", ""};
inline constexpr RowOf<2> contact{"contact.{rolls}.{key}", "", "", ""};
inline constexpr RowOf<1> one_bearing{"Kzc.{key}", "", "", ""};
inline constexpr RowOf<2> rating{"bearing.{bearing}.{key}", "", "", ""};
inline constexpr RowOf<2> film{"bearing.{bearing}.film.{key}", "", "", ""};
inline constexpr RowOf<2> bite{"bite.{pass}.{quantity}", "", "", ""};
inline constexpr RowOf<3> bite_model{"bite.{pass}.{bite_model}.{quantity}", "", "", ""};
inline constexpr RowOf<4> below_bite_model{"bite.{pass}.{bite_model}.{quantity}.{key}", "", "", ""};
inline constexpr RowOf<1> bite_fit{"bite.fit.{key}", "", "", ""};
inline constexpr RowOf<2> chatter{"chatter.{pass}.{key}", "", "", ""};
inline constexpr const ResultRow *all[]{&roll_contact,     &bite_spring, &contact, &one_bearing,
                                        &rating,           &film,        &bite,    &bite_model,
                                        &below_bite_model, &bite_fit,    &chatter};
}  // namespace mill::row::open
