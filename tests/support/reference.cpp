#include "tests/support/reference.h"
#include <fstream>
#include <map>

nlohmann::json reference(const std::string &entry, const std::string &file)
{
  static std::map<std::string, nlohmann::json> read;
  if (!read.count(file))
    read[file] = nlohmann::json::parse(
        std::ifstream(std::string(MILLSTAND_SOURCE_DIR "/tests/reference/") + file + ".json"));
  return read[file].at("entries").at(entry).at("value");
}

Eigen::VectorXd reference_vector(const std::string &entry, const std::string &file)
{
  const auto values = reference(entry, file).get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size()));
}
