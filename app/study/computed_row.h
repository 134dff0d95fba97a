#pragma once
#include "app/study/row_model.h"
#include "app/study/store/row_files.h"
#include "app/study/study_folder.h"

namespace mill {
/// The watched results of a row, or the sentence of its failure.
/// @throws SystemError  a fault of the machine and not of the row: disk, memory mapping
FinishedRow computed_row(RowModel &model, const Study &study, const DesignRow &design);
}  // namespace mill
