// A program of others that is linked with the installed libraries: docs/examples/consumer.
#include "tests/support/near.h"
#include "tests/support/program.h"
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <sstream>

namespace fs = std::filesystem;

TEST(Consumer, TenLinesFindTheLibrariesAndOpenTheFiniteElements)
{
  const std::string build = fs::path(MILLSTAND_PROGRAM).parent_path().string(), root = scratch("consumer");
  for (const char *component : {"dev", "fem"})
    ASSERT_EQ(
        shell("cmake --install '" + build + "' --prefix '" + root + "' --component " + component, root).exit_code,
        0);
  const Outcome made =
      shell("cmake -S '" MILLSTAND_SOURCE_DIR
            "/docs/examples/consumer' -B consumer -G Ninja -DCMAKE_CXX_COMPILER='" CXX_COMPILER "' "
            "-DCMAKE_PREFIX_PATH='" +
                root + "' && cmake --build consumer",
            root);
  ASSERT_EQ(made.exit_code, 0) << made.out << made.err;
  const Outcome run = shell("consumer/consumer", root);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  double chain = 0, hertz = 0;
  std::string finite_elements;
  std::istringstream(run.out) >> chain >> hertz >> finite_elements;
  EXPECT_EQ(finite_elements, "open");
  // Half width of two steel cylinders, a^2 = 8 q R (1 - nu^2) / (pi E), R = R1 R2 / (R1 + R2).  theory 3.2
  const double q = 976e3 / 1.4, radius = 0.21 * 0.5 / 0.71;
  const double expected = std::sqrt(8 * q * radius * (1 - 0.09) / (3.14159265358979 * 2.1e11));
  EXPECT_TRUE(near(chain, expected, within(1e-8, "nine digits are printed")));
  EXPECT_TRUE(near(hertz, expected, within(1e-8, "nine digits are printed")));
}
