#pragma once
#include "twin/records/raw_record.h"
#include <optional>
#include <string>

namespace mill::twin {
/// Unit of a voltage behind a sensor: "50 mV/g" is 0.05 V for one g; "10 g/V" is its reciprocal form; "20 g" is
/// what one unit of the file (1 V, or the full scale of a WAV file) stands for.
/// @param text    of the option --scale
/// @throws InputError  the text is none of these forms, or the unit is unknown
ColumnUnit unit_by_scale(const std::string &text, const std::string &column);

/// Unit of a column by --scale: for a voltage, and for a column without a unit.  Nothing where no scale is given
/// for it or it has another unit.
std::optional<ColumnUnit> scale_of(const std::string &column, const ColumnUnit &unit, const ReadOptions &options);
}  // namespace mill::twin
