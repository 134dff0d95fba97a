#pragma once
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <string>

/// Writes FOLDER/mill.csv: force and one roll, 1 kHz.  @return its path
inline std::string played_record(const std::string &folder, const int samples,
                                 const std::string &force = "force [kN]")
{
  const std::string path = folder + "/mill.csv";
  std::ofstream file(path);
  file << "time [s]," << force << ",upper_work_roll [g]\n";
  for (int k = 0; k < samples; ++k)
    file << fmt::format("{:.3f},{:.3f},{:.4f}\n", k * 1e-3, 976 + 5 * std::sin(0.3 * k), 0.1 * std::sin(0.2 * k));
  return path;
}
