#include "app/stages/bite/bite_study.h"
#include "core/base/errors.h"
#include "core/model/case.h"
#include "tests/support/drawn_pass.h"
#include <atomic>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <gtest/gtest.h>
#include <mutex>
#include <thread>

// Passes drawn from hot and cold practice: each ends with a value by a named solver, or says why no roll takes it.
// The suite takes passes 4 to 10: before and after them stand an elastic-plastic strip of 8 s and passes that no
// finite elements solve, 10 s each.  MILLSTAND_PASSES=2000 MILLSTAND_PASSES_FROM=0 runs the long form, another
// first pass goes on where an earlier one was ended (pass i is the same in all), MILLSTAND_PASSES_MESH=1 with the
// elements that a run takes (four times the time), and MILLSTAND_PASSES_REPORT=1 prints one line a pass.
namespace {
using namespace mill;

int number_in(const char *variable, const int otherwise)
{
  const char *given = std::getenv(variable);
  return given ? std::atoi(given) : otherwise;
}

double thread_seconds()
{
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

struct Ending {
  enum { value, impossible, failed } what = failed;
  std::string words;  // the solver, or the reason
  double force = not_given, slab = not_given, seconds = 0;
};

BiteQuestion question_of(const int i)
{
  BiteQuestion q;
  q.bite   = drawn_pass(i);
  q.pass   = "pass " + std::to_string(i);
  q.curves = false;
  if (!std::getenv("MILLSTAND_PASSES_MESH")) {  // which way a pass takes is asked, not digits
    q.setup.elements_along   = 12;
    q.setup.elements_through = 4;
    if (!std::getenv(
            "MILLSTAND_PASSES"))  // they come to the elastic-plastic strip when the rigid-plastic one fails
      q.setup.strip = BiteStrip::rigid_plastic;
  }
  return q;
}

Ending ending_of(RunContext &run, const int i)
{
  Ending e;
  const double begin = thread_seconds();
  try {
    const BiteStudy study = study_bite(run, question_of(i));
    e.what                = Ending::value;
    e.words               = study.chosen().state.model;
    e.force               = study.chosen().state.force;
    for (const std::string &failure : study.failures)
      e.words += "; " + failure;
    for (const char *slab : {"karman-elastic-arc", "karman"})
      if (const BiteAnswer *answer = study.find(slab); answer && std::isnan(e.slab))
        e.slab = answer->state.force;
  } catch (const InputError &error) {
    e.what  = Ending::impossible;
    e.words = error.problems.front().message;
  } catch (const SolverError &error) {
    e.words = error.report.what;
  }
  e.seconds = thread_seconds() - begin;
  return e;
}
}  // namespace

TEST(BiteCampaign, EveryPassEndsWithAValueOrAPhysicalReason)
{
  const int first = number_in("MILLSTAND_PASSES_FROM", 4), n = number_in("MILLSTAND_PASSES", 11);
  ASSERT_LT(first, n);
  const std::string folder = testing::TempDir() + "bite-campaign-" + std::to_string(::getpid());
  Case the_case;
  the_case.name = "campaign";
  const OutputDir out(folder, the_case, true, "id");
  std::vector<Ending> endings{std::size_t(n)};
  std::atomic<int> next{first};
  std::mutex printing;
  const auto work = [&] {
    RunContext run{the_case, out, folder};
    for (int i = next++; i < n; i = next++) {
      const Ending e = endings[std::size_t(i)] = ending_of(run, i);
      if (std::getenv("MILLSTAND_PASSES_REPORT")) {
        const std::lock_guard<std::mutex> lock(printing);
        std::printf("%d %s %.4g kN, slab %.4g kN, %.1f s: %s\n", i,
                    e.what == Ending::value        ? "value"
                    : e.what == Ending::impossible ? "impossible"
                                                   : "failed",
                    e.force / 1e3, e.slab / 1e3, e.seconds, e.words.c_str());
      }
    }
  };
  std::thread second(work);
  work();
  second.join();
  std::filesystem::remove_all(folder);

  int possible = 0, values = 0;
  for (int i = first; i < n; ++i) {
    const Ending &e = endings[std::size_t(i)];
    EXPECT_FALSE(e.words.empty()) << i;
    EXPECT_LT(e.seconds, 20) << i << ": " << e.words;
    if (e.what == Ending::impossible)
      continue;
    ++possible;
    if (e.what == Ending::value) {
      ++values;
      EXPECT_TRUE(e.force > 0 && std::isfinite(e.force)) << i;
    } else {
      ADD_FAILURE() << i << ": " << e.words;
    }
  }
  EXPECT_GE(values, 0.995 * possible);
  EXPECT_GT(possible, (n - first) / 2) << "too few passes that rolls can take: the draw says little";
}
