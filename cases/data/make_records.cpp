// Writes the synthetic rolling-force records of this folder:  make_records FOLDER
//
// Published are only the ranges of the two passes (preprint doi 10.21203/rs.3.rs-1441429/v1).  The records have
// exactly these ranges; that the force is white up to 1 kHz is an assumption.
#include "dynamics/response/rolling_force.h"
#include <cstdio>
#include <exception>
#include <string>

namespace {
struct SyntheticPass {
  const char *file;
  std::array<double, 2> range;  // N
  std::uint64_t seed;
};
const SyntheticPass passes[] = {{"pass-1.csv", {972898, 979537}, 1}, {"pass-2.csv", {733705, 742280}, 2}};

bool write(const std::string &path, const mill::ForceRecord &record)
{
  std::FILE *file = std::fopen(path.c_str(), "wb");
  if (!file)
    return false;
  std::fputs("time [s],force [kN]\n", file);
  for (Eigen::Index i = 0; i < record.time.size(); ++i)
    std::fprintf(file, "%.4f,%.4f\n", record.time[i], record.force[i] / 1e3);
  return std::fclose(file) == 0;
}
}  // namespace

int main(int argc, char **argv)
try {
  const std::string folder = argc > 1 ? argv[1] : ".";
  for (const SyntheticPass &pass : passes) {
    mill::dynamics::NoiseSettings settings;
    settings.range = pass.range;
    settings.seed  = pass.seed;
    if (!write(folder + "/" + pass.file, mill::dynamics::synthetic_force(settings))) {
      std::fprintf(stderr, "%s/%s cannot be written\n", folder.c_str(), pass.file);
      return 2;
    }
  }
  return 0;
} catch (const std::exception &error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
