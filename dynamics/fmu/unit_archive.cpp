#include "dynamics/fmu/unit_archive.h"
#include "core/base/errors.h"
#include "dynamics/fmu/archive.h"
#include "dynamics/fmu/description.h"
#include "dynamics/fmu/embedded.h"
#include "dynamics/fmu/model_text.h"
#include "dynamics/fmu/unpacked_unit.h"
#include <cctype>
#include <fmt/format.h>
#include <stdexcept>

namespace mill::fmu {
namespace {
void require_rules(const ExportedModel &model, const int fmi_version)
{
  std::string all;
  for (const std::string &broken : broken_rules(described_variables(model, fmi_version)))
    all += (all.empty() ? "" : "; ") + broken;
  if (!all.empty())
    throw InputError("the model cannot be exported as a functional mock-up unit: " + all);
}
}  // namespace

std::string identifier_of(const std::string &name)
{
  std::string identifier;
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    if (u < 0x80 && std::isalnum(u))
      identifier += c;
    else if (u < 0x80 && !identifier.empty() && identifier.back() != '_')
      identifier += '_';
  }
  while (!identifier.empty() && identifier.back() == '_')
    identifier.pop_back();
  if (identifier.empty() || std::isdigit(static_cast<unsigned char>(identifier[0])))
    identifier = "stand_" + identifier;
  return identifier.substr(0, 60);
}

std::string unit_archive(const ExportedModel &model, const int fmi_version)
{
  require_rules(model, fmi_version);
  const bool three = fmi_version == 3;
  std::vector<ArchiveEntry> entries{
      {"modelDescription.xml",   model_description(model, fmi_version)},
      {"documentation/index.html",                        documentation_page(model,                      fmi_version)},
      {"documentation/licenses/license.txt",            named_file("licence")             },
      {"documentation/externalDependencies.txt",external_dependencies() },
      {"resources/model.json",          model_json(model.data)                               }
  };
  entries.push_back({(three ? "binaries/x86_64-linux/" : "binaries/linux64/") + model.identifier + ".so",
                     named_file("linux64"), true});
  if (const std::string windows = named_file("win64"); !windows.empty())
    entries.push_back(
        {(three ? "binaries/x86_64-windows/" : "binaries/win64/") + model.identifier + ".dll", windows, true});
  if (model.data.has_series)
    entries.push_back({"resources/force.csv", series_csv(model.series)});
  for (const EmbeddedFile &file : source_files())
    entries.push_back({std::string("sources/") + file.name, file.bytes()});
  entries.push_back({"sources/buildDescription.xml", build_description(model)});
  return archive_of(entries);
}

void check_unit(const std::string &archive, const ExportedModel &model, const int fmi_version)
{
  double difference = 0;
  try {
    difference = difference_from(model.check, archive, model, fmi_version);
  } catch (const std::exception &e) {
    throw std::logic_error(std::string("the exported unit does not run: ") + e.what());
  }
  if (!(difference <= model.check.agreement))
    throw std::logic_error(
        fmt::format("the exported unit differs by {:.2g} from the integrator of this program, {:g} "
                    "is allowed; no file was written",
                    difference, model.check.agreement));
}
}  // namespace mill::fmu
