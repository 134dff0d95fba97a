// Numbers of the six-mass chain: where they are in the model, and which of them a mode follows.
#include "core/case/provenance.h"
#include "core/records/number_in_chain.h"
#include <gtest/gtest.h>

using namespace mill;

namespace {
std::string parts_in_words(const ForceMeaning force, const FrameForm frame, const Half half)
{
  DynamicsSettings dynamics;
  dynamics.force_meaning = force;
  dynamics.frame         = frame;
  std::string text;
  for (const ChainNumber part : chain_parts(dynamics, half))
    text += (text.empty() ? "" : " ") + std::string(word_of(part));
  return text;
}
}  // namespace

TEST(ChainParts, EachNumberHasItsMemberOfTheModel)
{
  LumpedModel model;
  for (std::size_t i = 0; i < model.M.size(); ++i)
    EXPECT_EQ(number_in_chain(model, *choice_named<ChainNumber>("M" + std::to_string(i + 1))), &model.M[i]);
  for (std::size_t i = 0; i < model.K.size(); ++i)
    EXPECT_EQ(number_in_chain(model, *choice_named<ChainNumber>("K" + std::to_string(i + 1))), &model.K[i]);
  for (const ChainNumber other : {ChainNumber::K_Zy, ChainNumber::K_ZW, ChainNumber::Kzc1, ChainNumber::Kzc4})
    EXPECT_EQ(number_in_chain(model, other), nullptr) << word_of(other);
  const LumpedModel &read = model;
  EXPECT_EQ(number_in_chain(read, ChainNumber::K7), &read.K[6]);
}

// The bite joins both halves; with the measured force it has no spring, and a closed frame still joins them.
TEST(ChainParts, AreThoseThatTheStateOfTheStandJoins)
{
  for (const Half half : {Half::upper, Half::lower}) {
    EXPECT_EQ(parts_in_words(ForceMeaning::disturbance, FrameForm::open, half),
              "M1 M2 M3 M4 M5 M6 K1 K2 K3 K4 K5 K6 K7");
    EXPECT_EQ(parts_in_words(ForceMeaning::measured, FrameForm::closed, half),
              "M1 M2 M3 M4 M5 M6 K1 K2 K3 K5 K6 K7");
  }
  EXPECT_EQ(parts_in_words(ForceMeaning::measured, FrameForm::open, Half::upper), "M1 M2 M3 K1 K2 K3");
  EXPECT_EQ(parts_in_words(ForceMeaning::measured, FrameForm::open, Half::lower), "M4 M5 M6 K5 K6 K7");
}
