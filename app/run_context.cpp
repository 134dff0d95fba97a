#include "app/run_context.h"
#include "app/case_kinds.h"
#include "app/out_of_memory.h"
#include "core/case/kinds.h"
#include "core/numerics/sparse.h"
#include "core/records/files.h"
#include "core/records/run_identity.h"
#include "fem/body/elastic_body.h"
#include "meshes/common/gmsh_scope.h"
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <unistd.h>

namespace mill {
using json = nlohmann::ordered_json;

void RunContext::warn(const std::string &sentence)
{
  const auto &said = results.warnings;
  if (sentence.empty() || std::find(said.begin(), said.end(), sentence) != said.end())
    return;
  results.warnings.push_back(sentence);
  progress.note("warning: " + sentence);
}

void RunContext::assume(const std::string &sentence)
{
  results.assumptions.push_back(sentence);
  progress.note("assumed: " + sentence);
}

namespace {
// The stages that run, the innermost last; one that an exception leaves stays, so that it can be named.
std::vector<std::string> &stages_in_progress()
{
  static std::vector<std::string> stages;
  return stages;
}
}  // namespace

std::string stage_in_progress()
{
  return stages_in_progress().empty() ? "" : stages_in_progress().back();
}

StageTimer::StageTimer(RunContext &s, std::string name)
    : run(s), stage(std::move(name)), start(std::chrono::steady_clock::now())
{
  stages_in_progress().push_back(stage);
}

StageTimer::~StageTimer()
{
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  run.times.push_back({stage, elapsed.count(), cached});
  if (std::uncaught_exceptions() == 0)
    stages_in_progress().pop_back();
}

std::string version()
{
  return MILLSTAND_VERSION;
}

namespace {
// Files beside the case that a run reads.
std::vector<std::string> input_files(const Case &the_case, const std::string &force_file)
{
  std::vector<std::string> files{force_file};
  for (const Pass &pass : all_passes(the_case))
    files.insert(files.end(), {pass.force_file, pass.measured_file});
  if (const auto more = run_kind(the_case).files)
    for (const std::string &file : more(the_case))
      files.push_back(file);
  files.erase(std::remove(files.begin(), files.end(), ""), files.end());
  return files;
}
}  // namespace

std::string run_id_of(const Case &the_case, const std::string &verb, const std::string &force_file)
{
  std::string all = version() + "\n" + verb + "\n" + the_case.resolved;
  for (const std::string &file : input_files(the_case, force_file))
    all += "\n" + hash_of(read_text(file));
  return hash_of(all);
}

std::string manifest_json(const RunContext &run)
{
  const Case &c = run.the_case;
  json manifest{
      {"program",   "millstand"     },
      {"version",   version()       },
      {"case",      c.name          },
      {"case_path", c.path          },
      {"kind",      c.kind          },
      {"title",     c.title         },
      {"run_id",    run.out.run_id()},
      {"date",      run.started     },
      {"threads",   run.threads     },
      {"blas",      blas_in_use()   },
      {"versions",
       {{"deal.II", fem::library_version()},
        {"Gmsh", meshes::library_version()},
        {"Eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                      std::to_string(EIGEN_MINOR_VERSION)},
        {"compiler", __VERSION__}}  }
  };
  for (const StageTime &time : run.times)
    manifest["timings"].push_back({
        {"stage",   time.stage  },
        {"seconds", time.seconds},
        {"cached",  time.cached }
    });
  for (const auto &[file, sum] : checksums_below(run.out.staging()))
    manifest["files"][file] = sum;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  manifest["peak_memory"] = 1024. * double(usage.ru_maxrss);
  if (const auto describe = run_kind(c).describe)
    describe(c, manifest);
  return manifest.dump(2) + "\n";
}
}  // namespace mill
