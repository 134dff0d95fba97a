#include "dynamics/fmu/unit_archive.h"
#include "core/base/errors.h"
#include "dynamics/fmu/archive.h"
#include "dynamics/fmu/description.h"
#include "dynamics/fmu/embedded.h"
#include "dynamics/fmu/icon.h"
#include "dynamics/fmu/model_text.h"
#include "dynamics/fmu/source_names.h"
#include "dynamics/fmu/unpacked_unit.h"
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

namespace {
void add_icons(std::vector<ArchiveEntry> &entries, const ExportedModel &model, const bool three)
{
  if (!three) {
    entries.push_back({"model.png", icon_png()});
    return;
  }
  const std::string folder = "terminalsAndIcons/";
  entries.push_back({folder + "terminalsAndIcons.xml", terminals_and_icons(model)});
  entries.push_back({folder + "icon.png", icon_png()});
  entries.push_back({folder + terminal_icon + ".png", terminal_png()});
}

void add_sources(std::vector<ArchiveEntry> &entries, const ExportedModel &model)
{
  const std::string folder = "sources/";
  entries.push_back({folder + names_header, source_names(model.identifier)});
  for (const EmbeddedFile &file : source_files())
    entries.push_back({folder + file.name, travelling_source(file.name, file.bytes())});
  entries.push_back({folder + "buildDescription.xml", build_description(model)});
}

void add_libraries(std::vector<ArchiveEntry> &entries, const ExportedModel &model, const bool three)
{
  const std::string linux_folder   = three ? "binaries/x86_64-linux/" : "binaries/linux64/";
  const std::string windows_folder = three ? "binaries/x86_64-windows/" : "binaries/win64/";
  entries.push_back({linux_folder + model.identifier + ".so", named_file("linux64"), true});
  if (const std::string windows = named_file("win64"); !windows.empty())
    entries.push_back({windows_folder + model.identifier + ".dll", windows, true});
}
}  // namespace

std::string unit_archive(const ExportedModel &model, const int fmi_version)
{
  require_rules(model, fmi_version);
  const bool three = fmi_version == 3;
  std::vector<ArchiveEntry> entries;
  entries.push_back({description_file, model_description(model, fmi_version)});
  add_icons(entries, model, three);
  entries.push_back({"documentation/index.html", documentation_page(model, fmi_version)});
  entries.push_back({"documentation/licenses/license.txt", named_file("licence")});
  entries.push_back({"documentation/externalDependencies.txt", external_dependencies()});
  entries.push_back({"documentation/staticLinking.txt", static_linking(model)});
  entries.push_back({"resources/model.json", model_json(model.data)});
  if (model.data.has_series)
    entries.push_back({"resources/force.csv", series_csv(model.series)});
  add_libraries(entries, model, three);
  add_sources(entries, model);
  return archive_of(entries);
}

void check_unit(const std::string &archive, const ExportedModel &model, const int fmi_version)
{
  double difference = 0;
  try {
    difference = difference_from(model.check, archive, model, fmi_version);
  } catch (const SystemError &) {
    throw;
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
