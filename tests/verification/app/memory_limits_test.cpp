// Little address space (ulimit -v): every limit ends with results or with a sentence and exit code 3. Before, the
// BLAS asked for its buffers for ever, and what was too little for a factor was called our own mistake.
#include "tests/support/program.h"
#include <gtest/gtest.h>

namespace {
Outcome with_address_space(const int megabytes, const std::string &arguments)
{
  return millstand(arguments, MILLSTAND_SOURCE_DIR, "ulimit -v " + std::to_string(1024 * megabytes));
}

bool says(const std::string &text, const std::string &what)
{
  return text.find(what) != std::string::npos;
}
}  // namespace

TEST(MemoryLimits, ALimitBelowTheBuffersOfTheBlasIsReportedAtOnce)
{
  const Outcome outcome = with_address_space(300, "check cases/two-cylinders.toml");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_TRUE(says(outcome.err, "out of memory: 300 MB of address space are allowed (ulimit -v), at least "))
      << outcome.err;
  EXPECT_TRUE(says(outcome.err, "  change        a higher limit\n")) << outcome.err;
}

// Known before the factorisation begins; the numbers are those of this machine and mesh.
TEST(MemoryLimits, TheLimitOfTheUserRefusesWithTheKeyThatNeedsLess)
{
  const Outcome outcome = millstand("stiffness cases/two-cylinders.toml --memory 200MB -q --fresh -o " +
                                    scratch("allowed") + " --cache " + scratch("allowed-cache"));
  EXPECT_EQ(outcome.exit_code, 3);
  for (const char *part : {"upper cylinder: out of memory: the factor of a stiffness matrix of ",
                           " unknowns with what is made of it needs ", " may be taken for it: ",
                           " are left, the limit is set by the 200 MB that --memory allows\n",
                           "  usual cause   a finer mesh than this machine or this limit can hold\n",
                           "  change        a smaller contact.line.elements_per_half_width, fewer threads "
                           "(--threads), or a higher limit\n"})
    EXPECT_TRUE(says(outcome.err, part)) << part << " in\n" << outcome.err;
}

TEST(MemoryLimitsLong, EveryLimitEndsWithResultsOrASentence)
{
  // 560: no room for the library of the finite elements.
  for (const int megabytes : {560, 800, 860, 920, 1000, 3000}) {
    const Outcome outcome = with_address_space(megabytes, "run cases/two-cylinders.toml -q --fresh -o " +
                                                              scratch("tight") + " --cache " + scratch("cache"));
    const bool refused    = says(outcome.err, "out of memory") && says(outcome.err, "  change        ");
    EXPECT_TRUE(outcome.exit_code == 0 || (outcome.exit_code == 3 && refused))
        << megabytes << " MB, exit code " << outcome.exit_code << "\n"
        << outcome.err;
    if (megabytes == 3000)
      EXPECT_EQ(outcome.exit_code, 0) << "what the case needs is well below this";
  }
}
