#include "app/chatter/pass_studies.h"
#include "app/chatter/chatter_files.h"
#include "app/chatter/chatter_results.h"
#include "app/run/error_warnings.h"
#include <exception>

namespace mill {
void study_passes(RunContext &run, const std::size_t n_passes,
                  const std::function<ChatterStudy(std::size_t pass)> &study)
{
  std::exception_ptr failure;
  bool answered      = false;
  const auto refused = [&](const auto &error) {
    if (!failure)
      failure = std::current_exception();
    run.warn(warning_of(WarningId::chatter_refused, error));
  };
  for (std::size_t p = 0; p < n_passes; ++p) {
    try {
      const ChatterStudy one = study(p);
      add_chatter_results(run, one);
      write_chatter(run, one);
      run.summary += verdict_sentence(one) + "\n";
      answered = true;
    } catch (const InputError &e) {
      refused(e);
    } catch (const SolverError &e) {
      refused(e);
    }
    run.progress.at("chatter", double(p + 1) / double(n_passes));
  }
  if (failure && !answered)
    std::rethrow_exception(failure);
}
}  // namespace mill
