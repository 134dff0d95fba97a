#include "app/run/curve_files.h"

namespace mill {
void write_curve(const RunContext &run, const CurveKind &kind, const std::string &item, const Table &table,
                 const std::string &of)
{
  require_columns(kind, table);
  run.out.write_table(curve_path(kind, item, of), table);
}
}  // namespace mill
