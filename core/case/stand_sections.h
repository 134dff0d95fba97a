#pragma once
#include "core/case/kinds.h"
#include "core/case/stand_rows.h"
#include <string>
#include <vector>

// Sections that several kinds of case share, and the rows of [given] and [published].
namespace mill {
SectionRows head_section();
SectionRows steel_section();
std::vector<SectionRows> strip_sections();  ///< [strip] with flow stress and friction
SectionRows oil_film_section();             ///< [bearing.NAME] of type oil-film
SectionRows bite_section();
SectionRows pass_section(bool needed);
SectionRows dynamics_section(const std::vector<Field<DynamicsSettings>> &rows);
SectionRows frequency_response_section();
SectionRows campbell_section(const std::vector<Field<CampbellSettings>> &rows);
SectionRows drive_order_section();
TemplateNote drive_order_note();  ///< the parts that turn in a drive have no default
SectionRows given_section(const std::vector<Row> &rows, bool needed);  ///< with tolerances
SectionRows published_section(const std::vector<Row> &rows);

std::vector<Row> stand_given_rows();
std::vector<Row> lumped_given_rows();  ///< masses and springs of the chain are required
std::vector<Row> stand_published_rows();
std::vector<Row> bearing_published_rows();
std::vector<Row> bite_published_rows();

/// The rows with one KEY_tolerance for each.
std::vector<Row> with_tolerances(std::vector<Row> rows);
}  // namespace mill
