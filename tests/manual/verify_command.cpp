#include "app/command/verify_options.h"
#include "app/process/address_space.h"
#include "app/process/console.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/model/case.h"
#include "core/numerics/sparse.h"
#include "fem/body/elastic_body.h"
#include "tests/manual/groups.h"
#include "tests/manual/manual.h"
#include "tests/manual/peer/calculix.h"
#include <algorithm>
#include <fmt/format.h>
#include <thread>
#include <utility>

namespace mill {
namespace {
// The page shows the whole manual or nothing: half a page would hide what was not run.
void require_whole_manual(const VerifyOptions &options)
{
  if (!options.markdown.empty() && (!options.names.empty() || options.list))
    throw InputError("--markdown writes the page of the whole manual; leave out the names and --list");
  if (!options.markdown.empty())
    try {
      verify::peer::program_and_date();
    } catch (const verify::Skipped &e) {
      throw InputError(std::string("--markdown writes the page of the whole manual, and the family 'peer' ") +
                       e.what());
    }
}

void print_now(const std::string &text)
{
  console::print(text);
  console::flush();
}
}  // namespace

int verify_command(const VerifyOptions &options)
{
  require_whole_manual(options);
  const auto cases = verify::select(verify::all_cases(), options.names);
  if (options.list) {
    print_now(verify::list_text(cases));
    return 0;
  }
  const int threads = threads_that_start(threads_that_fit(
      options.threads > 0 ? options.threads : int(std::max(1u, std::thread::hardware_concurrency()))));
  set_blas_threads(threads);
  reserve_address_space(threads);
  fem::set_assembly_threads(threads);

  std::vector<std::pair<std::string, double>> stages;
  for (const verify::Case &c : cases)
    stages.push_back({c.name, 1});
  console::ProgressBar bar(stages, options.quiet);
  std::vector<verify::Outcome> outcomes;
  for (const verify::Case &c : cases) {
    bar.show(c.name, 0);
    outcomes.push_back(verify::run(c));
    bar.show(c.name, 1);
    if (!options.quiet || !passes(outcomes.back())) {
      bar.finish();
      print_now(verify::outcome_text(outcomes.back()) + "\n");
    }
  }
  bar.finish();
  print_now(verify::summary_text(outcomes) + "\n" + verify::known_text(outcomes));
  if (!options.markdown.empty())
    write_atomically(options.markdown, verify::manual_page(outcomes));
  bool skipped = false;
  for (const verify::Outcome &o : outcomes) {
    skipped = skipped || !o.skipped.empty();
    if (o.skipped.empty() && !passes(o))
      return 3;
  }
  return skipped && !options.names.empty() ? 4 : 0;  // who did not ask for them by name misses nothing
}
}  // namespace mill
