#include "core/base/files.h"
#include "twin/records/mat_arrays.h"

namespace mill::twin {
RawRecord read_mat_record(const std::string &path, const ReadOptions &options)
{
  return record_of_arrays(path, "MATLAB 5", mat_arrays(path, read_text(path)), {}, options);
}
}  // namespace mill::twin
