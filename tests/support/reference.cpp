#include "tests/support/reference.h"
#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

Reference Reference::operator[](const int index) const
{
  return Reference(json->at(std::size_t(index)));
}

Reference Reference::operator[](const std::string &key) const
{
  return Reference(json->at(key));
}

std::vector<std::pair<std::string, Reference>> Reference::items() const
{
  std::vector<std::pair<std::string, Reference>> all;
  for (const auto &[key, part] : json->items())
    all.emplace_back(key, Reference(part));
  return all;
}

std::size_t Reference::size() const
{
  return json->size();
}

bool Reference::contains(const std::string &key) const
{
  return json->contains(key);
}

template <class T> T Reference::get() const
{
  return json->get<T>();
}
template double Reference::get() const;
template bool Reference::get() const;
template int Reference::get() const;
template std::string Reference::get() const;
template std::vector<double> Reference::get() const;
template std::vector<int> Reference::get() const;
template std::vector<std::string> Reference::get() const;
template std::vector<std::vector<double>> Reference::get() const;
template std::vector<std::array<double, 3>> Reference::get() const;
template long Reference::get() const;
template unsigned long Reference::get() const;
template std::vector<long> Reference::get() const;
template std::map<std::string, double> Reference::get() const;

std::ostream &operator<<(std::ostream &out, const Reference &value)
{
  return out << value.json->dump();
}

Reference reference(const std::string &entry, const std::string &file)
{
  static std::map<std::string, nlohmann::json> read;
  if (!read.count(file))
    read[file] = nlohmann::json::parse(
        std::ifstream(std::string(MILLSTAND_SOURCE_DIR "/tests/reference/") + file + ".json"));
  return Reference(read[file].at("entries").at(entry).at("value"));
}

Eigen::VectorXd reference_vector(const std::string &entry, const std::string &file)
{
  const auto values = reference(entry, file).get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size()));
}
