#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/run_results.h"
#include <algorithm>
#include <filesystem>

// The drawn bearing with the finite elements of roller, rings, neck and chock, half a minute: ctest -C long.  In
// every run of the suite stand its parts: the roller in bearing_command_test, rings and chock in the manual's
// group Ring.
namespace fs = std::filesystem;

// Softer than between rigid rings; how the chock is held, left open by the case, is part of the error.
TEST(BearingByElements, ElasticRingsMakeItSofterAndTheSupportCounts)
{
  const auto outcome = millstand("stiffness cases/bearing-266.toml -q -o " + scratch("elastic") + " --cache " +
                                 shared_cache() + " --set load.samples=5");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto values    = results_of("elastic").at("values");
  const double tangent = of(values, "Kzc.tangent");
  const double rigid   = check_of(values, "Kzc.tangent", "contact FEM of one roller, rigid rings"),
               iso     = check_of(values, "Kzc.tangent", "ISO/TS 16281, rigid rings");
  EXPECT_GT(rigid / iso, 1.05) << "a roller on rigid backing is 5 to 25 % stiffer than the standard's";
  EXPECT_LT(rigid / iso, 1.25);
  EXPECT_LT(tangent, 0.9 * iso);
  EXPECT_GT(tangent, 0.3 * iso);
  int supports  = 0;
  double widest = 0;
  for (const auto &check : values.at("Kzc.tangent").at("checks"))
    if (check.at("name").get<std::string>().rfind("chock on ", 0) == 0) {
      ++supports;
      widest = std::max(widest, std::abs(check.at("value").get<double>() / tangent - 1));
    }
  EXPECT_EQ(supports, 2) << "the whole face, its middle";
  EXPECT_GT(widest, 0.02);
  EXPECT_GE(of(values, "Kzc.tangent", "error_estimate"), widest);
  double shares = 0;
  for (int row = 1; row <= 4; ++row)
    shares += of(values, "Kzc.row" + std::to_string(row) + "_share");
  EXPECT_TRUE(near(shares, 1, within(1e-9, "equilibrium")));
  for (const char *file : {"bearing-trb.csv", "bearing-trb-rows.csv", "bearing-trb-law.csv"})
    EXPECT_GT(fs::file_size(scratch("elastic") + "/curves/" + file), 0u) << file;
}
