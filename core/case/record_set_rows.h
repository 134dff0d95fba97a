#pragma once
#include "core/case/fields.h"
#include "core/case/stand_rows.h"
#include "core/model/record_set.h"
#include <vector>

// Keys of records.toml, which describes a folder of records to millstand calibrate.
namespace mill {
const std::vector<Field<RecordSet>> &record_set_rows();
const std::vector<Field<RecordEntry>> &record_rows();   ///< of [[record]], but for its table `channels`
const std::vector<Field<MeasuredLevel>> &level_rows();  ///< of [[level]]

/// For the reference: top of the file, [[record]], [[level]].
std::vector<SectionRows> record_set_sections();
}  // namespace mill
