#include "app/stages/bite/bite_study.h"
#include "core/base/errors.h"
#include "core/model/case.h"
#include "tests/support/demo_pass.h"
#include "tests/support/near.h"
#include <filesystem>
#include <gtest/gtest.h>

// What the study of a bite takes for an answer of the bite, and what not.
namespace {
using namespace mill;

struct Study {
  std::string folder = testing::TempDir() + "bite-study-" + std::to_string(::getpid());
  Case the_case;
  OutputDir out{folder, named(the_case), true, "id"};
  RunContext run{the_case, out, folder};

  ~Study()
  {
    std::filesystem::remove_all(folder);
  }
  static const Case &named(Case &which)
  {
    which.name = "bite study";
    return which;
  }
};

// Strip of 2 mm by a fifth on a roll of 420 mm, by a slab theory on the free arc.
BiteQuestion cold_pass()
{
  BiteQuestion q;
  q.pass                            = "1";
  q.curves                          = false;
  q.setup.method                    = BiteMethod::slab;
  q.setup.arc                       = BiteArc::elastic;
  q.bite.roll_radius                = 0.21;
  q.bite.roll                       = {210e9, 0.3};
  q.bite.roll_speed                 = 5;
  q.bite.strip.width                = 1;
  q.bite.strip.entry_thickness      = 2e-3;
  q.bite.strip.exit_thickness       = 1.6e-3;
  q.bite.strip.flow_stress.k        = 500e6;
  q.bite.strip.friction.coefficient = 0.05;
  q.bite.strip.entry_tension        = 50e6;
  q.bite.strip.exit_tension         = 50e6;
  q.bite.strip.youngs_modulus       = 210e9;
  q.bite.strip.poisson_ratio        = 0.3;
  return q;
}
}  // namespace

TEST(BiteStudy, AFullDiskIsNotAnsweredByAHalfPlane)
{
  Study study;
  std::filesystem::remove_all(study.out.staging());  // where the mesh of the section is written
  std::string message;
  try {
    study_bite(study.run, cold_pass());
  } catch (const SystemError &e) {
    message = e.what();
  }
  EXPECT_NE(message.find("the mesh cannot be written"), std::string::npos) << message;
  EXPECT_TRUE(study.run.results.assumptions.empty());
}

TEST(BiteStudy, AnArcTooLongForASectionUsesAHalfPlane)
{
  Study study;
  BiteQuestion q                    = cold_pass();
  q.bite.strip.entry_thickness      = 0.2;
  q.bite.strip.exit_thickness       = 0.16;
  q.bite.strip.flow_stress.k        = 50e6;
  q.bite.strip.entry_tension        = 0;
  q.bite.strip.exit_tension         = 0;
  q.bite.strip.friction.coefficient = 0.5;
  try {
    study_bite(study.run, q);
  } catch (const InputError &) {  // the slab theories may refuse it as well
  } catch (const SolverError &) {
  }
  ASSERT_EQ(study.run.results.assumptions.size(), 1u);
  EXPECT_EQ(study.run.results.assumptions[0].find(
                "bite of 1: the roll's surface is that of a half plane: roll in the bite: points up to "),
            0u)
      << study.run.results.assumptions[0];
}

// The mesh needs multiples of four along the arc: 12 elements have 8 as their coarser mesh, and not 6.
TEST(BiteStudy, TheCoarserMeshIsAsFarAwayAsItsElementsAre)
{
  Study study;
  BiteQuestion q;
  q.pass           = "1";
  q.curves         = false;
  q.bite           = demo_pass();
  q.setup.arc      = BiteArc::rigid;
  q.setup.strip    = BiteStrip::rigid_plastic;
  const auto ratio = [&](const int along, const int through) {
    q.setup.elements_along   = along;
    q.setup.elements_through = through;
    const auto answer        = study_bite(study.run, q);
    return answer.flow ? answer.flow->coarsening : not_given;
  };
  EXPECT_TRUE(near(ratio(12, 4), 12. / 8, within(1e-12, "12 x 4 and 8 x 2 elements")));
  EXPECT_TRUE(near(ratio(16, 3), 3. / 2, within(1e-12, "16 x 3 and 8 x 2 elements")));
  EXPECT_TRUE(near(ratio(16, 4), 2, within(1e-12, "16 x 4 and 8 x 2 elements")));
}
