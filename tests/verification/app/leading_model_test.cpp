// The model of a drawing that export and analyse take: the detailed one, six masses on request and with a warning.
#include "app/twin/analyse/analysed_stand.h"
#include "core/base/files.h"
#include "core/model/case.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

namespace {
const std::string stand = std::string(MILLSTAND_SOURCE_DIR) + "/cases/cold-tandem-2030.toml";
// Quick to condense: coarse contacts, bearings by the standard.
const std::string quick =
    " --cache " + shared_cache() +
    " --set contact.upper.elements_per_half_width=2 --set contact.lower.elements_per_half_width=2 "
    "--set contact.upper.samples=7 --set contact.lower.samples=7 --set bearing.work.roller_law=iso --set "
    "bearing.work.rings=rigid --set bearing.backup.roller_law=iso --set bearing.backup.rings=rigid ";

Outcome exported(const std::string &folder, const std::string &more)
{
  return millstand("export statespace " + stand + quick + more, folder);
}

Eigen::Index rows_of(const std::string &csv)
{
  const std::string text = mill::read_text(csv);
  return std::count(text.begin(), text.end(), '\n');  // a matrix has no head
}
}  // namespace

TEST(LeadingModelLong, OfADrawingIsExportedWithTheStaticRest)
{
  const std::string folder = scratch("leading-export");
  const Outcome run        = exported(folder, "-o detailed");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::smatch match;
  const std::regex sentence(
      "rolls as reduced finite elements in ([0-9]+) modes up to ([0-9]+) Hz and the static rest "
      "of the ([0-9]+) others, ([0-9]+) states; the gap responds within ([0-9.e-]+) % ");
  ASSERT_TRUE(std::regex_search(run.out, match, sentence)) << run.out;
  EXPECT_LE(std::stoi(match[2]), 2000) << "twice the frequency limit";
  EXPECT_EQ(std::stoi(match[4]), 2 * (std::stoi(match[1]) + 1));
  EXPECT_LT(std::stod(match[5]), 0.1);
  EXPECT_EQ(rows_of(folder + "/detailed/A.csv"), std::stoi(match[4]));
  EXPECT_EQ(run.err.find("six masses put"), std::string::npos) << run.err;
}

TEST(LeadingModel, SixMassesAreExportedOnRequestAndTheirErrorIsStated)
{
  const std::string folder = scratch("leading-six");
  const Outcome run        = exported(folder, "--model six-mass -o six");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(rows_of(folder + "/six/A.csv"), 12);
  std::smatch match;
  const std::regex sentence("warning: six masses put a mode of the gap at ([0-9.]+) Hz, rolls as reduced finite "
                            "elements at ([0-9.]+) Hz: \\+([0-9.]+) %");
  ASSERT_TRUE(std::regex_search(run.err, match, sentence)) << run.err;
  EXPECT_TRUE(near(100 * (std::stod(match[1]) / std::stod(match[2]) - 1), std::stod(match[3]),
                   within_absolute(0.25, "frequencies near 55 Hz are printed to 0.1 Hz")));
  EXPECT_GT(std::stod(match[3]), 5);
  const Outcome by_case = exported(folder, "--set dynamics.model=six-mass -o by-case");
  ASSERT_EQ(by_case.exit_code, 0) << by_case.err;
  EXPECT_EQ(rows_of(folder + "/by-case/A.csv"), 12) << "a case that names its model keeps it";
}

TEST(LeadingModel, OfALumpedCaseIsNotChosen)
{
  const Outcome run = millstand("export statespace " + std::string(MILLSTAND_SOURCE_DIR) +
                                    "/cases/published-1400.toml --model beam -o out",
                                scratch("leading-lumped"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("--model beam: kind = \"lumped\""), std::string::npos) << run.err;
}

TEST(LeadingModel, ARecordIsComparedWithBeamsAndTheirChocks)
{
  const mill::Case the_case = mill::read_case(stand);
  const auto beams = mill::analysed_stand(the_case, false), six = mill::analysed_stand(the_case, true);
  EXPECT_EQ(six.frequency.size(), 6);
  EXPECT_GT(beams.frequency.size(), 6);
  EXPECT_NE(std::find(beams.places.begin(), beams.places.end(), "upper_work_roll_chock"), beams.places.end());
  EXPECT_EQ(beams.source.find("rolls as beams"), 0u);
  ASSERT_EQ(beams.shape.rows(), Eigen::Index(beams.places.size()));
  ASSERT_EQ(beams.strain_share.cols(), Eigen::Index(beams.springs.size()));
  ASSERT_EQ(beams.spring_error.size(), beams.strain_share.cols());
  ASSERT_EQ(beams.kinetic_share.cols(), Eigen::Index(beams.bodies.size()));
  for (Eigen::Index i = 0; i < beams.frequency.size(); ++i) {
    EXPECT_TRUE(near(beams.strain_share.row(i).sum(), 1, within(1e-6, "springs and bodies hold all energy")));
    EXPECT_TRUE(near(beams.kinetic_share.row(i).sum(), 1, within(1e-6, "bodies hold all energy")));
  }
  const auto warned = [](const mill::twin::CaseModel &model) {
    return std::any_of(model.notes.begin(), model.notes.end(),
                       [](const mill::Note &note) { return note.parts.id == mill::WarningId::six_mass_gap_mode; });
  };
  EXPECT_TRUE(warned(six));
  EXPECT_FALSE(warned(beams));
}
