// Catalogues of bearings: what a designation finds, and each way in which a table of one's own is wrong.
#include "core/case/bearing_catalogue.h"
#include "tests/support/near.h"
#include <cmath>
#include <random>
#include <set>

using namespace mill;

namespace {
const std::string catalogue_header = "designation,type,d [mm],D [mm],B [mm],rows,C [kN],C0 [kN],source\n";

/// "line:column: message" of everything that is refused, a line each.
std::string refused_catalogue(const std::string &text)
{
  try {
    catalogue_of("own.csv", text);
  } catch (const InputError &error) {
    std::string out;
    for (const Problem &p : error.problems) {
      EXPECT_EQ(p.place.file, "own.csv");
      out += (out.empty() ? "" : "\n") + std::to_string(p.place.line) + ":" + std::to_string(p.place.column) +
             ": " + p.message;
    }
    return out;
  }
  return "accepted";
}

std::string refused_line(const std::string &line)
{
  return refused_catalogue(catalogue_header + line + "\n");
}
}  // namespace

TEST(BearingCatalogue, TheShippedTableIsComplete)
{
  const auto &all = shipped_catalogue();
  EXPECT_GE(all.size(), 20u);
  std::set<std::optional<BearingType>> types;
  for (const CatalogueBearing &b : all) {
    types.insert(b.type);
    EXPECT_EQ(b.rows, 4) << b.designation;
    if (std::isfinite(b.dynamic_rating)) {
      EXPECT_GT(b.static_rating / b.dynamic_rating, 2) << b.designation;
    }
    EXPECT_LT(b.width, b.outside_diameter) << b.designation;
    EXPECT_FALSE(b.source.empty());
    EXPECT_EQ(find_bearing(all, b.designation), &b);
  }
  EXPECT_EQ(types.size(), 2u);
}

TEST(BearingCatalogue, ADesignationIsFoundWithoutItsSigns)
{
  const auto &all = shipped_catalogue();
  const auto *one = find_bearing(all, "LM761649D/LM761610/LM761610D");
  ASSERT_NE(one, nullptr);
  EXPECT_EQ(one->bore, 0.343052);
  EXPECT_EQ(one->dynamic_rating, 2370e3);
  EXPECT_EQ(find_bearing(all, "lm761649d - lm761610 - lm761610d"), one);
  EXPECT_EQ(find_bearing(all, "LM761649D"), one);  // the cone alone
  EXPECT_EQ(find_bearing(all, "LM761649"), nullptr);
  EXPECT_EQ(find_bearing(all, ""), nullptr);
  EXPECT_EQ(nearest_designations(all, "LM761694D").at(0), "LM761649D/LM761610/LM761610D");
  EXPECT_EQ(nearest_designations(all, "4R10740", 1), std::vector<std::string>{"4R10704"});
  const auto twins = catalogue_of("own.csv", catalogue_header + "A1/B,four-row tapered,100,200,50,4,,,me\n" +
                                                 "A1/C,four-row tapered,100,200,60,4,,,me\n");
  EXPECT_EQ(find_bearing(twins, "A1"), nullptr);  // two begin so
  EXPECT_NE(find_bearing(twins, "A1/C"), nullptr);
}

TEST(BearingCatalogue, ValuesAreInTheUnitsOfTheHeader)
{
  const auto rows = catalogue_of("own.csv", "source;e;designation;type;rows;d [m];D [m];B [m];C [MN];C0 [N]\n"
                                            "drawing 12;0,4;X 1;four-row tapered;4;0,2;0,3;0,15;1,2;3400000\n");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].designation, "X 1");
  EXPECT_EQ(rows[0].bore, 0.2);
  EXPECT_EQ(rows[0].dynamic_rating, 1.2e6);
  EXPECT_EQ(rows[0].static_rating, 3.4e6);
  EXPECT_EQ(rows[0].e, 0.4);
  EXPECT_EQ(rows[0].source, "drawing 12");
}

TEST(BearingCatalogue, WrongColumnsAndUnitsAreRefusedInOneGo)
{
  EXPECT_EQ(
      refused_catalogue(""),
      "1:1: the file is empty; a header such as \"designation, type, d [mm], D [mm], B [mm], rows, C [kN], C0 "
      "[kN], source\" and data are needed");
  EXPECT_EQ(
      refused_catalogue("designation,type,d [mm],D [kN],B,rows,C [kN],source,colour\n"),
      "1:1: no column 'C0' in the header, which has 'designation', 'type', 'd', 'D', 'B', 'rows', 'C', 'source', "
      "'colour'; write for example \"C0 [kN]\"\n"
      "1:25: column 'D' has the unit 'kN', a force; a length is needed, for example \"D [mm]\"\n"
      "1:32: column 'B' has no unit; a length is needed, for example \"B [mm]\"\n"
      "1:53: column 'colour' is unknown; a catalogue has designation, type, d [mm], D [mm], B [mm], rows, C [kN], "
      "C0 [kN], source, and e");
  EXPECT_EQ(
      refused_catalogue("designation,type,d [mm],D [mm],B [mm],rows [mm],C [kN],C0 [furlong],source,source\n"),
      "1:39: column 'rows' has the unit 'mm'; it has none\n"
      "1:56: column 'C0' has the unknown unit 'furlong'; a force is needed, for example \"C0 [kN]\"\n"
      "1:76: column 'source' stands twice");
  EXPECT_EQ(
      refused_catalogue("type,d [mm],D [mm],B [mm],rows,C [kN],C0 [kN],source\n"),
      "1:1: no column 'designation' in the header, which has 'type', 'd', 'D', 'B', 'rows', 'C', 'C0', 'source'; "
      "write for example \"designation\"");
}

TEST(BearingCatalogue, WrongCellsAreRefusedWithTheirPlace)
{
  EXPECT_EQ(refused_line("X,four-row tapered,200,300,150,4,1200,3400,me"), "accepted");
  EXPECT_EQ(refused_line("X,four-row tapered,200,300,150,4,,,me"), "accepted");
  EXPECT_EQ(refused_line("X,four-row taperd,200,300,150,4,1200,3400,me"),
            "2:3: type 'four-row taperd' is unknown; did you mean 'four-row tapered'?");
  EXPECT_EQ(refused_line(",four-row tapered,200,300,150,4,1200,3400,"),
            "2:1: the cell of column 'designation' is empty; a line without a designation cannot be looked up\n"
            "2:43: the cell of column 'source' is empty; say where the figures of this line come from");
  EXPECT_EQ(refused_line("X,four-row tapered,300,200,150,4,1200,3400,me"),
            "2:24: the outside diameter 200 is not larger than the bore 300");
  EXPECT_EQ(refused_line("X,four-row tapered,0.2,300,150,4.5,1200,3400,me"),
            "2:20: d = 0.2 is outside 20 mm .. 2500 mm\n2:32: rows = 4.5 is not a whole number");
  EXPECT_EQ(refused_line("X,four-row tapered,200,300,150,4,1200,,me"),
            "2:39: one of the ratings C and C0 is missing; give both or neither");
  EXPECT_EQ(refused_line("X,four-row tapered,200,300,wide,4,1200,3400,me"),
            "2:28: 'wide' in column 'B' is not a finite number");
  EXPECT_EQ(refused_line("X,four-row tapered,200,300,150,4,1200,3400"),
            "2:1: this line has 8 cells, the header has 9; a decimal comma needs ';' or tab between the columns");
  EXPECT_EQ(refused_line("X 1,four-row tapered,200,300,150,4,,,me\nx-1,four-row tapered,200,300,150,4,,,me"),
            "3:1: designation 'x-1' appears twice; keep one of the two lines");
}

// Whatever the table is, what comes out is a bearing, and what is refused has a place in the file.
TEST(BearingCatalogue, AMutilatedTableIsEitherReadOrRefused)
{
  std::mt19937 random(20);
  const std::string whole = catalogue_header + "X 1,four-row tapered,200,300,150,4,1200,3400,\"me, too\"\n"
                                               "X 2,four-row cylindrical,260.5,360,220,4,,,\"said \"\"so\"\"\"\n";
  const std::string signs = ",;\t\"\n\r[]#-.eE0129 kNmX\xC3\xBC";
  for (int i = 0; i < 4000; ++i) {
    std::string text = whole;
    for (int n = 1 + int(random() % 4); n > 0 && !text.empty(); --n) {
      const auto position = random() % text.size();
      switch (random() % 4) {
      case 0:
        text.erase(position, 1 + random() % 6);
        break;
      case 1:
        text.insert(position, 1, signs[random() % signs.size()]);
        break;
      case 2:
        text[position] = char(random() % 256);
        break;
      default:
        text = text.substr(0, position) + text.substr(random() % text.size());
      }
    }
    try {
      for (const CatalogueBearing &b : catalogue_of("own.csv", text)) {
        EXPECT_GT(b.outside_diameter, b.bore);
        EXPECT_GE(b.bore, 0.02);
        EXPECT_GE(b.rows, 1);
        EXPECT_FALSE(b.designation.empty() || b.source.empty());
        EXPECT_EQ(std::isnan(b.dynamic_rating), std::isnan(b.static_rating));
      }
    } catch (const InputError &error) {
      for (const Problem &p : error.problems) {
        EXPECT_EQ(p.place.file, "own.csv");
        EXPECT_GE(p.place.line, 1);
        EXPECT_GE(p.place.column, 1);
        EXPECT_FALSE(p.message.empty());
      }
    }
  }
}

// Any separator, any unit: the same bearings come back.
TEST(BearingCatalogue, RandomTablesAreReadAsWritten)
{
  std::mt19937 random(21);
  const auto between = [&](const double low, const double high) {
    return low + (high - low) * double(random() % 100000) / 1e5;
  };
  for (int i = 0; i < 200; ++i) {
    const char separator = ",;\t"[random() % 3];
    const bool metres    = random() % 2;
    std::string text;
    for (const char *name : {"designation", "type", "d", "D", "B", "rows", "C", "C0"})
      text += std::string(name) +
              (std::string("dDB").find(name) != std::string::npos ? metres ? " [m]" : " [mm]"
               : name[0] == 'C'                                   ? " [MN]"
                                                                  : "") +
              separator;
    text += "source\n";
    std::vector<CatalogueBearing> wanted;
    for (int n = 0; n < 5; ++n) {
      CatalogueBearing b;
      b.designation      = "B " + std::to_string(1000 * i + n);
      b.bore             = between(0.1, 0.5);
      b.outside_diameter = b.bore + between(0.05, 0.3);
      b.width            = between(0.1, 0.5);
      b.dynamic_rating   = between(1e6, 9e6);
      b.static_rating    = 3 * b.dynamic_rating;
      char line[400];
      const double scale = metres ? 1 : 1e3;
      std::snprintf(line, sizeof line, "%s|four-row tapered|%.9g|%.9g|%.9g|4|%.9g|%.9g|me\n",
                    b.designation.c_str(), scale * b.bore, scale * b.outside_diameter, scale * b.width,
                    1e-6 * b.dynamic_rating, 1e-6 * b.static_rating);
      for (const char c : std::string(line))
        text += c == '|' ? separator : c;
      wanted.push_back(b);
    }
    const auto rows = catalogue_of("own.csv", text);
    ASSERT_EQ(rows.size(), wanted.size());
    for (std::size_t n = 0; n < rows.size(); ++n) {
      const auto digits = within(1e-8, "written with nine digits");
      EXPECT_EQ(rows[n].designation, wanted[n].designation);
      EXPECT_TRUE(near(rows[n].bore, wanted[n].bore, digits));
      EXPECT_TRUE(near(rows[n].outside_diameter, wanted[n].outside_diameter, digits));
      EXPECT_TRUE(near(rows[n].width, wanted[n].width, digits));
      EXPECT_TRUE(near(rows[n].dynamic_rating, wanted[n].dynamic_rating, digits));
      EXPECT_TRUE(near(rows[n].static_rating, wanted[n].static_rating, digits));
    }
  }
}
