#include "app/run/curve_files.h"

namespace mill {
void write_curve(const RunContext &run, const CurveKind &kind, const std::string &item, const Table &table,
                 const std::string &quantity)
{
  require_columns(kind, table);
  run.out.write_table(curve_path(kind, item, quantity), table);
}
}  // namespace mill
