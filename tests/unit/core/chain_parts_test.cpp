// Numbers of the six-mass chain: where they are in the model, and which of them a mode follows.
#include "core/case/provenance.h"
#include "core/records/number_in_chain.h"
#include <gtest/gtest.h>

using namespace mill;

namespace {
using Numbers     = std::vector<ChainNumber>;
constexpr auto M1 = ChainNumber::M1, M2 = ChainNumber::M2, M3 = ChainNumber::M3, M4 = ChainNumber::M4,
               M5 = ChainNumber::M5, M6 = ChainNumber::M6, K1 = ChainNumber::K1, K2 = ChainNumber::K2,
               K3 = ChainNumber::K3, K4 = ChainNumber::K4, K5 = ChainNumber::K5, K6 = ChainNumber::K6,
               K7 = ChainNumber::K7;

DynamicsSettings settings(const ForceMeaning force, const FrameForm frame)
{
  DynamicsSettings dynamics;
  dynamics.force_meaning = force;
  dynamics.frame         = frame;
  return dynamics;
}
}  // namespace

TEST(ChainParts, EachNumberHasItsMemberOfTheModel)
{
  LumpedModel model;
  for (std::size_t i = 0; i < model.M.size(); ++i)
    EXPECT_EQ(number_in_chain(model, ChainNumber(int(M1) + int(i))), &model.M[i]);
  for (std::size_t i = 0; i < model.K.size(); ++i)
    EXPECT_EQ(number_in_chain(model, ChainNumber(int(K1) + int(i))), &model.K[i]);
  for (const ChainNumber other : {ChainNumber::K_Zy, ChainNumber::K_ZW, ChainNumber::Kzc1, ChainNumber::Kzc4})
    EXPECT_EQ(number_in_chain(model, other), nullptr) << word_of(other);
  const LumpedModel &read = model;
  EXPECT_EQ(number_in_chain(read, K7), &read.K[6]);
}

// The bite joins both halves; with the measured force it has no spring, and a closed frame still joins them.
TEST(ChainParts, AreThoseThatTheStateOfTheStandJoins)
{
  const Numbers all{M1, M2, M3, M4, M5, M6, K1, K2, K3, K4, K5, K6, K7};
  const Numbers without_bite{M1, M2, M3, M4, M5, M6, K1, K2, K3, K5, K6, K7};
  for (const Half half : {Half::upper, Half::lower}) {
    EXPECT_EQ(chain_parts(settings(ForceMeaning::disturbance, FrameForm::open), half), all);
    EXPECT_EQ(chain_parts(settings(ForceMeaning::measured, FrameForm::closed), half), without_bite);
  }
  const DynamicsSettings apart = settings(ForceMeaning::measured, FrameForm::open);
  EXPECT_EQ(chain_parts(apart, Half::upper), (Numbers{M1, M2, M3, K1, K2, K3}));
  EXPECT_EQ(chain_parts(apart, Half::lower), (Numbers{M4, M5, M6, K5, K6, K7}));
}
