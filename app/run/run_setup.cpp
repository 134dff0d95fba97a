#include "app/run/run_setup.h"
#include "app/process/address_space.h"
#include "core/base/files.h"
#include "core/numerics/sparse.h"
#include "fem/body/elastic_body.h"
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <thread>

namespace mill {
std::string cache_folder(const CommandLine &command, const std::string &fallback)
{
  if (!command.cache.empty())
    return command.cache;
  if (const char *base = std::getenv("XDG_CACHE_HOME"); base && *base)
    return std::string(base) + "/millstand";
  if (const char *home = std::getenv("HOME"); home && *home)
    return std::string(home) + "/.cache/millstand";
  return fallback;
}

void open_cache(RunContext &run, const std::string &instead)
{
  std::error_code cache_error;
  if (std::filesystem::create_directories(run.cache, cache_error); cache_error) {
    run.warn({WarningId::not_kept, "",
              "the cache folder " + run.cache + " cannot be created (" + cache_error.message() + ")",
              "nothing is kept for the next run"});
    run.cache = instead;
  }
  remove_stale_parts(run.cache);
}

int set_up_threads(RunContext &run, const CommandLine &command)
{
  const int wanted =
      command.threads > 0 ? command.threads : int(std::max(1u, std::thread::hardware_concurrency()));
  run.threads = threads_that_start(threads_that_fit(wanted));
  set_blas_threads(1);  // stages and their parts share the threads; results are then the same with any number
  reserve_address_space(run.threads);
  fem::set_assembly_threads(run.threads);
  return wanted;
}

std::string local_time()
{
  const std::time_t t = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", std::localtime(&t));
  return text;
}
}  // namespace mill
