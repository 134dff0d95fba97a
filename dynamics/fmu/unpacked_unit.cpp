#include "dynamics/fmu/unpacked_unit.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "dynamics/fmu/archive.h"
#include "dynamics/fmu/runtime/fmi2_interface.h"
#include "dynamics/fmu/runtime/fmi3_interface.h"
#include "dynamics/fmu/runtime/variables.h"
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <sys/statvfs.h>
#include <vector>

namespace fs = std::filesystem;

namespace mill::fmu {
namespace {
// Is the file system of a folder mounted without the right to run programs?
bool runs_nothing(const std::string &folder)
{
  struct statvfs system {};
  return ::statvfs(folder.c_str(), &system) == 0 && (system.f_flag & ST_NOEXEC) != 0;
}
}  // namespace

UnpackedUnit::UnpackedUnit(const std::string &archive, const std::string &identifier, const int fmi_version)
{
  std::string pattern = (fs::temp_directory_path() / "millstand-unit-XXXXXX").string();
  if (!mkdtemp(pattern.data()))
    throw SystemError("the folder for the check of the unit cannot be made as " + pattern + ": " +
                      std::strerror(errno));
  folder_ = pattern;
  try {
    for (const ArchiveEntry &entry : entries_of(archive)) {
      const fs::path path = fs::path(folder_) / entry.name;
      fs::create_directories(path.parent_path());
      std::ofstream file(path, std::ios::binary);
      if (!file.write(entry.bytes.data(), std::streamsize(entry.bytes.size())).flush())
        throw SystemError("the folder for the check of the unit, " + folder_ + ", cannot be written");
    }
    const std::string path =
        folder_ + "/binaries/" + (fmi_version == 3 ? "x86_64-linux/" : "linux64/") + identifier + ".so";
    library_ = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library_) {
      const std::string reason = dlerror();
      if (runs_nothing(folder_))
        throw SystemError("the unit cannot be tried, since programs may not run from " +
                          fs::temp_directory_path().string() + " (mounted noexec): " + reason +
                          "; set TMPDIR to another folder");
      throw std::runtime_error(reason);
    }
  } catch (...) {
    remove_folder(folder_);
    throw;
  }
}

UnpackedUnit::~UnpackedUnit()
{
  dlclose(library_);
  remove_folder(folder_);
}

std::string UnpackedUnit::resources() const
{
  return folder_ + "/resources/";
}

void *UnpackedUnit::symbol(const char *name) const
{
  void *symbol = dlsym(library_, name);
  if (!symbol)
    throw std::runtime_error(std::string("the library lacks ") + name);
  return symbol;
}

namespace {
// What the callbacks of both versions work on.
struct Journal {
  std::string messages;
  const UnpackedUnit *unit = nullptr;
  fmi3Instance instance    = nullptr;
  double force_at_end      = 0;
};

void note_2(void *journal, fmi2String, fmi2Status, fmi2String, fmi2String message, ...)
{
  static_cast<Journal *>(journal)->messages += std::string(message) + "; ";
}
void note_3(fmi3InstanceEnvironment journal, fmi3Status, fmi3String, fmi3String message)
{
  static_cast<Journal *>(journal)->messages += std::string(message) + "; ";
}
void set_force_at_end(fmi3InstanceEnvironment environment, fmi3Float64, fmi3Boolean, fmi3Boolean, fmi3Boolean,
                      fmi3Boolean, fmi3Boolean *, fmi3Float64 *)
{
  auto &journal               = *static_cast<Journal *>(environment);
  const fmi3ValueReference vr = 1;
  journal.unit->function<decltype(&fmi3SetFloat64)>("fmi3SetFloat64")(journal.instance, &vr, 1,
                                                                      &journal.force_at_end, 1);
}

void require_ok(const int status, const char *function, const Journal &journal)
{
  if (status != 0)
    throw std::runtime_error(std::string(function) + " returns " + std::to_string(status) + ": " +
                             journal.messages);
}

// References of the accelerations, then of the load cell; or of the outputs that are named.
std::vector<unsigned> compared(const ModelData &model, const CheckRun &run)
{
  std::vector<unsigned> references;
  const auto all = variables_of(model);
  for (const std::string &name : run.names)
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].name == name)
        references.push_back(unsigned(i));
  if (!run.names.empty())
    return references;
  for (const Role role : {Role::acceleration, Role::cell_force})
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].role == role)
        references.push_back(unsigned(i));
  return references;
}

Eigen::MatrixXd run_2(const UnpackedUnit &unit, const CheckRun &run, const ExportedModel &model,
                      const std::vector<unsigned> &outputs)
{
  Journal journal;
  const fmi2CallbackFunctions callbacks{note_2, nullptr, nullptr, nullptr, &journal};
#define MILL_FMI(name) unit.function<decltype(&name)>(#name)
  const fmi2Component c = MILL_FMI(fmi2Instantiate)("check", fmi2CoSimulation, model.data.guid.c_str(),
                                                    ("file://" + unit.resources()).c_str(), &callbacks, 0, 0);
  if (!c)
    throw std::runtime_error(journal.messages);
  const auto n = run.force.size();
  Eigen::MatrixXd result(n, Eigen::Index(outputs.size()));
  std::vector<double> row(outputs.size());
  const unsigned force = 1;
  const int order      = 1;
  require_ok(MILL_FMI(fmi2SetupExperiment)(c, 0, 0, 0, 0, 0), "fmi2SetupExperiment", journal);
  require_ok(MILL_FMI(fmi2EnterInitializationMode)(c), "fmi2EnterInitializationMode", journal);
  require_ok(MILL_FMI(fmi2SetReal)(c, &force, 1, &run.force[0]), "fmi2SetReal", journal);
  require_ok(MILL_FMI(fmi2ExitInitializationMode)(c), "fmi2ExitInitializationMode", journal);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i > 0) {
      const double slope = (run.force[i] - run.force[i - 1]) / run.step;
      require_ok(MILL_FMI(fmi2SetReal)(c, &force, 1, &run.force[i - 1]), "fmi2SetReal", journal);
      require_ok(MILL_FMI(fmi2SetRealInputDerivatives)(c, &force, 1, &order, &slope),
                 "fmi2SetRealInputDerivatives", journal);
      require_ok(MILL_FMI(fmi2DoStep)(c, double(i - 1) * run.step, run.step, 1), "fmi2DoStep", journal);
    }
    require_ok(MILL_FMI(fmi2GetReal)(c, outputs.data(), outputs.size(), row.data()), "fmi2GetReal", journal);
    result.row(i) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), Eigen::Index(row.size()));
  }
  MILL_FMI(fmi2FreeInstance)(c);
  return result;
}

Eigen::MatrixXd run_3(const UnpackedUnit &unit, const CheckRun &run, const ExportedModel &model,
                      const std::vector<unsigned> &outputs)
{
  Journal journal;
  journal.unit                   = &unit;
  const fmi3ValueReference force = 1;
  journal.instance =
      MILL_FMI(fmi3InstantiateCoSimulation)("check", model.data.guid.c_str(), unit.resources().c_str(), false,
                                            true, false, false, &force, 1, &journal, note_3, set_force_at_end);
  const fmi3Instance c = journal.instance;
  if (!c)
    throw std::runtime_error(journal.messages);
  const auto n = run.force.size();
  Eigen::MatrixXd result(n, Eigen::Index(outputs.size()));
  std::vector<double> row(outputs.size());
  require_ok(MILL_FMI(fmi3EnterInitializationMode)(c, false, 0, 0, false, 0), "fmi3EnterInitializationMode",
             journal);
  require_ok(MILL_FMI(fmi3SetFloat64)(c, &force, 1, &run.force[0], 1), "fmi3SetFloat64", journal);
  require_ok(MILL_FMI(fmi3ExitInitializationMode)(c), "fmi3ExitInitializationMode", journal);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i > 0) {
      bool event = false, end = false, early = false;
      double last          = 0;
      journal.force_at_end = run.force[i];
      require_ok(MILL_FMI(fmi3DoStep)(c, double(i - 1) * run.step, run.step, true, &event, &end, &early, &last),
                 "fmi3DoStep", journal);
    }
    require_ok(MILL_FMI(fmi3GetFloat64)(c, outputs.data(), outputs.size(), row.data(), row.size()),
               "fmi3GetFloat64", journal);
    result.row(i) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), Eigen::Index(row.size()));
  }
  MILL_FMI(fmi3FreeInstance)(c);
#undef MILL_FMI
  return result;
}
}  // namespace

double difference_from(const CheckRun &run, const std::string &archive, const ExportedModel &model,
                       const int fmi_version)
{
  const UnpackedUnit unit(archive, model.identifier, fmi_version);
  const auto outputs         = compared(model.data, run);
  const Eigen::MatrixXd made = (fmi_version == 3 ? run_3 : run_2)(unit, run, model, outputs);
  const Eigen::Index m       = run.acceleration.cols();
  const auto relative        = [](const Eigen::MatrixXd &difference, const Eigen::MatrixXd &to) {
    const double largest = to.cwiseAbs().maxCoeff();
    return difference.cwiseAbs().maxCoeff() / (largest > 0 ? largest : 1);
  };
  if (!run.names.empty()) {
    double worst = made.cols() == run.values.cols() ? 0 : INFINITY;
    for (Eigen::Index c = 0; c < made.cols() && std::isfinite(worst); ++c) {
      const double one = relative(made.col(c) - run.values.col(c), run.values.col(c));
      worst            = std::isnan(one) ? INFINITY : std::max(worst, one);
    }
    return worst;
  }
  const double accelerations = relative(made.leftCols(m) - run.acceleration, run.acceleration);
  const double cell          = relative(made.col(m) - run.load_cell, run.load_cell);
  return std::isnan(accelerations) || std::isnan(cell) ? INFINITY : std::max(accelerations, cell);
}
}  // namespace mill::fmu
