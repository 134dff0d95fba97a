#include "report/page/curves.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill;
using namespace mill::report;

TEST(Curves, FactorsOfEveryDimension)
{
  const struct {
    const char *from, *to;
    double factor;
  } rows[] = {
      {"N/m", "kN/mm", 1e-6},
      {"N/m", "N/mm", 1e-3},
      {"N/m2", "kN/mm per m", 1e-6},
      {"N", "kN", 1e-3},
      {"Pa", "MPa", 1e-6},
      {"m", "\u00b5m", 1e6},
      {"m/N", "\u00b5m/MN", 1e12},
      {"m/s2", "g", 1 / 9.80665},
      {"", "%", 100},
      {"N/sqrt(Hz)", "N/\u221aHz", 1},
      {"kN/sqrt(Hz)", "N/\u221aHz", 1000},
  };
  for (const auto &row : rows)
    EXPECT_TRUE(near(factor_between(row.from, row.to), row.factor, within(1e-15, "one division"))) << row.from;
  EXPECT_TRUE(std::isnan(factor_between("N", "mm")));
  EXPECT_TRUE(std::isnan(factor_between("furlong", "mm")));
}

TEST(Curves, QuantityOfAnOperatingPoint)
{
  const auto in = [](const mill::OperatingPoint &operating_point, const char *unit) {
    Result result;
    result.at_values = operating_point.values();
    return quantity_at(result, unit);
  };
  EXPECT_EQ(in(mill::at_force(976.2e3), "N"), 976.2e3);
  EXPECT_TRUE(near(in({"{} on one bearing", {{48.8e3, "kN"}}}, "kN"), 48.8, within(1e-15, "one division")));
  EXPECT_TRUE(near(in({"{}, {}", {{8e-3, "mm"}, {1.2e6, "MN"}}}, "kN"), 1200, within(1e-15, "one division")))
      << "the thickness before it is not a load";
  EXPECT_TRUE(near(in({"{}", {{1e6, "N/mm"}}}, "N/m"), 1e6, within(1e-15, "one division")));
  EXPECT_TRUE(std::isnan(in({"{}", {{1e6, "N/mm"}}}, "kN"))) << "a line load is not a load";
  EXPECT_TRUE(std::isnan(in("rest", "kN")));
}

// A column in another unit of the same dimension is converted, one of another dimension is not drawn.
TEST(Curves, TheHeaderDecidesAboutTheUnit)
{
  Table table;
  table.names   = {"force", "way"};
  table.units   = {"N", "mm"};
  table.columns = {Eigen::Vector2d(1000, 2000), Eigen::Vector2d(1, 3)};
  EXPECT_TRUE(near(values_of(table, {"force", "kN"}), Eigen::Vector2d(1, 2), within(1e-15, "one multiplication")));
  EXPECT_TRUE(near(values_of(table, {"way", "\u00b5m"}), Eigen::Vector2d(1000, 3000),
                   within(1e-15, "one multiplication")));
  EXPECT_EQ(values_of(table, {"force", "mm"}).size(), 0);
  EXPECT_EQ(values_of(table, {"absent", "mm"}).size(), 0);
  Plot plot;
  EXPECT_TRUE(add_line(plot, table, {"way", "mm"}, {"force", "kN"}, "", Pen::dark));
  EXPECT_FALSE(add_line(plot, table, {"way", "mm"}, {"force", "MPa"}, "", Pen::dark));
  EXPECT_EQ(plot.lines.size(), 1u);
}

TEST(Curves, InterpolationIsExactOverTheLogarithm)
{
  const Eigen::Vector3d x(1, 10, 1000), y(0, 1, 3);  // y = log10 x
  EXPECT_TRUE(near(interpolated(x, y, 100), 2, within(1e-15, "straight over ln x")));
  EXPECT_TRUE(near(interpolated(x, y, 10), 1, within(0, "a sample")));
  EXPECT_TRUE(std::isnan(interpolated(x, y, 0.5))) << "a curve is never extrapolated";
  EXPECT_TRUE(std::isnan(interpolated(x, y, 1001)));
}

// What a line of the table of curves is worth without any code of the report.
TEST(Curves, APlainFigureDrawsEveryColumnByItsUnit)
{
  Table table;
  table.add("z", "m", Eigen::Vector2d(0, 0.7)).add("line_load", "N/m", Eigen::Vector2d(1e6, 2e6));
  table.add("peak_pressure", "Pa", Eigen::Vector2d(1e9, 5e8))
      .add("mean_pressure", "Pa", Eigen::Vector2d(1e8, 2e8));
  const CurveKind kind{"contact", true, "anything", "a plain curve", Figure::own, {}, true};
  const auto drawings = plain_drawings(kind, table);
  ASSERT_EQ(drawings.size(), 2u) << "one for each unit";
  EXPECT_NE(drawings[0].find("line load [kN/m"), std::string::npos) << drawings[0].substr(0, 3000);
  EXPECT_NE(drawings[1].find("peak pressure"), std::string::npos);
  EXPECT_NE(drawings[1].find("mean pressure"), std::string::npos);
  EXPECT_NE(drawings[1].find("[MPa]"), std::string::npos);
  EXPECT_NE(drawings[1].find("z [mm]"), std::string::npos);
}
