#include "core/base/files.h"
#include "core/base/text.h"
#include "core/base/valid_text.h"
#include "twin/records/named_arrays.h"
#include "twin/records/npy_array.h"
#include "twin/records/npy_sidecar.h"
#include "twin/records/zip_entries.h"
#include <filesystem>
#include <fmt/format.h>

// Arrays that numpy.savez and numpy.savez_compressed put into one archive, each as a .npy file.
namespace mill::twin {
namespace {
std::string array_name(const std::string &entry)
{
  const bool npy = entry.size() > 4 && text_ends_with(entry, ".npy");
  return npy ? entry.substr(0, entry.size() - 4) : entry;
}

// The descriptor of a whole array in the archive: a single number has the shape ().
void take_array_of_archive(const std::string &path, const std::string &name, std::string bytes, NamedArrays &into)
{
  const std::string where  = path + ": '" + valid_text(name) + "'";
  const std::string scalar = "'shape': ()";
  if (const auto position = bytes.substr(0, 256).find(scalar); position != std::string::npos)
    bytes.replace(position, scalar.size(), "'shape':1, ");
  const NpyLayout layout = npy_layout(bytes, where);
  const double needed    = double(layout.start) + layout.n * double(layout.row);
  if (needed > double(bytes.size()))
    throw InputError(where + " is shorter than its header says; it was cut off while it was written or copied");
  const auto n = Eigen::Index(layout.n), m = Eigen::Index(layout.fields.size());
  const auto value = [&](const Eigen::Index r, const Eigen::Index c) {
    const NpyField &field  = layout.fields[std::size_t(c)];
    const std::size_t byte = layout.columns_first ? std::size_t(c * n + r) * std::size_t(field.type.size)
                                                  : std::size_t(r) * layout.row + field.offset;
    return number_at(&bytes[layout.start + byte], field.type);
  };
  if (layout.plain) {
    NamedArray array{name, Eigen::MatrixXd(n, m)};
    for (Eigen::Index r = 0; r < n; ++r)
      for (Eigen::Index c = 0; c < m; ++c)
        array.value(r, c) = value(r, c);
    into.arrays.push_back(std::move(array));
    return;
  }
  for (Eigen::Index c = 0; c < m; ++c) {
    NamedArray array{name + "." + layout.fields[std::size_t(c)].name, Eigen::MatrixXd(n, 1)};
    for (Eigen::Index r = 0; r < n; ++r)
      array.value(r, 0) = value(r, c);
    into.arrays.push_back(std::move(array));
  }
}
}  // namespace

RawRecord read_npz_record(const std::string &path, const ReadOptions &options)
{
  const std::string archive = read_text(path);
  NamedArrays arrays;
  for (const ZipEntry &entry : zip_entries(path, archive)) {
    const std::string name = array_name(entry.name);
    std::string bytes      = unpacked(path, entry);
    try {
      take_array_of_archive(path, name, std::move(bytes), arrays);
    } catch (const SystemError &) {
      throw;
    } catch (const InputError &) {  // texts and objects next to the arrays
      arrays.others.push_back("'" + valid_text(name) + "'");
    }
  }
  std::map<std::string, std::string> units;
  const std::string sidecar_path = std::filesystem::path(path).replace_extension(".json").string();
  double rate                    = std::numeric_limits<double>::quiet_NaN();
  if (std::filesystem::exists(sidecar_path)) {
    const NpySidecar sidecar = npy_sidecar(sidecar_path, path);
    units                    = {sidecar.units.begin(), sidecar.units.end()};
    rate                     = sidecar.rate;
  }
  if (rate > 0)
    arrays.arrays.push_back({"Fs", Eigen::MatrixXd::Constant(1, 1, rate)});
  return record_of_arrays(path, "numpy", std::move(arrays), units, options);
}
}  // namespace mill::twin
