#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace sample {
// Columns of a file, one after the other.
struct Csv {
  std::vector<std::string> headers;
  std::vector<Eigen::VectorXd> columns;
  Csv &with(const std::string &header, const Eigen::VectorXd &values)
  {
    headers.push_back(header);
    columns.push_back(values);
    return *this;
  }
};

inline void write_csv(const std::filesystem::path &path, const Csv &csv)
{
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path);
  file.precision(9);
  for (std::size_t c = 0; c < csv.headers.size(); ++c)
    file << (c ? ", " : "") << csv.headers[c];
  file << '\n';
  for (Eigen::Index r = 0; r < csv.columns[0].size(); ++r)
    for (std::size_t c = 0; c < csv.columns.size(); ++c)
      file << (c ? "," : "") << csv.columns[c][r] << (c + 1 == csv.columns.size() ? "\n" : "");
}
}  // namespace sample
