// Which strip, arc and slab theory a pass is solved with, from the settings of the case and the regime of the
// pass.
#include "fem/strip/bite_answers.h"
#include "tests/support/demo_pass.h"
#include "tests/support/near.h"
#include <gtest/gtest.h>

using namespace mill;
using namespace mill::fem;

namespace {
bite::Regime elastic_regime()
{
  bite::Regime regime;
  regime.elastic_strip = true;
  return regime;
}

BiteSetup setup_of(const BiteMethod method, const SlabTheory theory, const BiteStrip strip = BiteStrip::automatic)
{
  BiteSetup setup;
  setup.method = method;
  setup.theory = theory;
  setup.strip  = strip;
  return setup;
}

// Thin hard strip on a small roll.
bite::RollBite thin_pass()
{
  bite::RollBite bite             = demo_pass();
  bite.roll_radius                = 0.0348;
  bite.strip.entry_thickness      = 0.26e-3;
  bite.strip.exit_thickness       = 0.18e-3;
  bite.strip.entry_tension        = 289e6;
  bite.strip.exit_tension         = 385e6;
  bite.strip.flow_stress.k        = 1180e6;
  bite.strip.friction.coefficient = 0.06;
  return bite;
}
}  // namespace

TEST(BiteAnswers, OnlyKarmansTheoryIsSolvedOnAFreeArc)
{
  for (const BiteMethod method : {BiteMethod::fe, BiteMethod::slab})
    for (const SlabTheory theory : every<SlabTheory>())
      for (const BiteStrip strip : every<BiteStrip>()) {
        const BiteSetup settled     = settled_setup(setup_of(method, theory, strip), elastic_regime());
        const bite::SlabModel model = slab_model(settled);
        EXPECT_NE(settled.arc, BiteArc::automatic);
        EXPECT_TRUE(model.arc != bite::Arc::elastic || model.theory == SlabTheory::karman) << word_of(theory);
        EXPECT_TRUE(method == BiteMethod::fe || model.theory == theory) << word_of(theory) << ": it gives K4";
      }
}

// A theory that is only compared with the finite elements leaves them their free arc, and the arc its slab.
TEST(BiteAnswers, TheTheoryOfTheComparisonDoesNotTakeTheFreeArcAway)
{
  BiteStudy study;
  study.question.bite = thin_pass();
  const auto slab_of  = [&](const SlabTheory theory) {
    const BiteSetup settled = settled_setup(setup_of(BiteMethod::fe, theory), elastic_regime());
    EXPECT_EQ(settled.arc, BiteArc::elastic);
    return slab_answer(study, slab_key(settled), slab_model(settled));
  };
  const BiteAnswer karman = slab_of(SlabTheory::karman);
  ASSERT_TRUE(karman.refused.empty()) << karman.refused;
  for (const SlabTheory theory : every<SlabTheory>()) {
    const BiteAnswer answer = slab_of(theory);
    EXPECT_EQ(answer.key, karman.key);
    EXPECT_TRUE(answer.refused.empty()) << word_of(theory) << ": " << answer.refused;
    EXPECT_EQ(answer.state.force, karman.state.force) << word_of(theory);
  }
}

TEST(BiteAnswers, TheOtherStripHasTheElementsOfTheCase)
{
  for (const auto &[along, through] : {std::pair{48, 12}, {24, 6}, {16, 2}}) {
    BiteSetup asked         = setup_of(BiteMethod::fe, SlabTheory::karman);
    asked.elements_along    = along;
    asked.elements_through  = through;
    const BiteSetup elastic = settled_setup(asked, elastic_regime()), rigid = settled_setup(asked, {});
    ASSERT_EQ(elastic.strip, BiteStrip::elastic_plastic);
    ASSERT_EQ(rigid.strip, BiteStrip::rigid_plastic);
    const BiteSetup after_elastic = other_strip(elastic, asked), after_rigid = other_strip(rigid, asked);
    EXPECT_EQ(after_elastic.strip, BiteStrip::rigid_plastic);
    EXPECT_EQ(after_elastic.arc, BiteArc::hitchcock);
    EXPECT_EQ(after_elastic.elements_along, rigid.elements_along);
    EXPECT_EQ(after_elastic.elements_through, rigid.elements_through);
    EXPECT_EQ(after_rigid.strip, BiteStrip::elastic_plastic);
    EXPECT_EQ(after_rigid.elements_along, elastic.elements_along);
    EXPECT_EQ(after_rigid.elements_through, elastic.elements_through);
  }
}
