#include "core/case/errors.h"
#include "core/records/files.h"
#include "core/records/json_archive.h"
#include "report/schedule/figures.h"
#include <filesystem>
#include <map>

namespace mill::report {
ScheduleData read_schedule(const std::string &run_directory)
{
  const std::filesystem::path path = std::filesystem::path(run_directory) / schedule_file;
  ScheduleData data;
  if (!std::filesystem::exists(path))
    return data;
  try {
    static_cast<ScheduleRecord &>(data) = record_of_json<ScheduleRecord>(read_text(path.string()));
    data.stored                         = true;
  } catch (const InputError &) {
    data.problem =
        std::string(schedule_file) +
        " is not what this program writes, so the forces of the passes are not shown; run the case again.";
  }
  return data;
}

std::string schedule_meaning(const std::string &quantity)
{
  static const std::map<std::string, std::string> words{
      {"flow_stress",             "flow stress, fitted with flattened rolls"             },
      {"flow_stress_unflattened", "flow stress, fitted with rigid rolls"                 },
      {"flattened_radius",        "flattened radius"                                     },
      {"friction",                "friction by its law"                                  },
      {"deformation_power",       "power of homogeneous deformation"                     },
      {"deformation_torque",      "torque of homogeneous deformation, one roll"          },
      {"dynamic_force",           "dynamic force by one constant for all passes"         },
      {"force_per_displacement",  "force per displacement of a work roll"                },
      {"hardening_stress",        "hardening law of all passes, shear stress at strain 1"},
      {"hardening_exponent",      "hardening law of all passes, exponent"                },
      {"dynamic_constant",        "constant of the dynamic force, all passes"            }
  };
  const auto found = words.find(quantity);
  return found == words.end() ? "" : found->second;
}
}  // namespace mill::report
