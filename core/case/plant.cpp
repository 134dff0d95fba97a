#include "core/case/plant.h"
#include "core/case/stand_reader.h"
#include <cmath>
#include <filesystem>

namespace mill {
const std::vector<Field<Plant>> &plant_rows()
{
  static const std::vector<Field<Plant>> rows{
      Field<Plant>{"mains", &Plant::mains, "Hz", Range{50, 60}, absent, "50 Hz",
                   "frequency of the mains, 50 Hz or 60 Hz: analyse names lines at its multiples; when absent "
                   "both are tried"}};
  return rows;
}

SectionRows plant_section()
{
  return {"plant", SectionRows::Repeat::once, false, "what surrounds the stand and is seen in its records",
          rows_of(plant_rows())};
}

TemplateNote plant_note()
{
  return {"plant", "", {}, {}, true};
}

Plant read_plant(const Node &root, Reading &reading)
{
  Plant plant;
  const Section section = section_at(root, "plant", reading);
  if (!section.node)
    return plant;
  read_and_echo(section, section.header(), plant_rows(), plant, reading);
  const bool known =
      std::isnan(plant.mains) || std::abs(plant.mains - 50) < 1e-6 || std::abs(plant.mains - 60) < 1e-6;
  if (reading.usable({"plant.mains"}) && !known)
    contradict(reading, "plant.mains", "must be \"50 Hz\" or \"60 Hz\"", {});
  return plant;
}

Plant plant_of(const std::string &path, const std::vector<std::string> &sets)
{
  const Node root                    = read_case_file(path, sets);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  Reading reading;
  reading.file   = path;
  reading.folder = folder.empty() ? "." : folder.string();
  Plant plant    = read_plant(root, reading);
  if (!reading.problems.empty())
    throw InputError(std::move(reading.problems));
  return plant;
}
}  // namespace mill
