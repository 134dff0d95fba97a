#include "app/stages/bite/bite_study.h"
#include "core/records/binary_archive.h"
#include <gtest/gtest.h>

using namespace mill;

namespace {
FlowAnswer some_answer()
{
  FlowAnswer a;
  a.fine.state.model    = "finite elements, \"quoted\"";
  a.fine.state.force    = 928173.25;
  a.fine.state.torque   = 1. / 3;
  a.fine.state.force_by = {1, -2, 3, not_given, 5, 6, 7, not_given, 9};
  a.fine.state.position = Eigen::VectorXd::LinSpaced(5, -1e-5, 0.025);
  a.fine.state.notes    = {{WarningId::bite_angle, "", "one", "why"}, {WarningId::bite_sticking, "", "two"}};
  a.fine.strain         = Eigen::MatrixXd::Random(3, 4);
  a.fine.roll_surface   = Eigen::Vector3d(1, not_given, 3);
  a.fine.first_contact  = 7;
  a.fine.balance.power  = -3e-14;
  a.coarse_slope        = 2.25e8;
  a.elastic             = true;
  a.outlet_stress       = Eigen::Vector2d(-1e6, 1e6);
  return a;
}
}  // namespace

TEST(StripFlowStore, AStoredFlowComesBackUnchanged)
{
  const FlowAnswer a = some_answer();
  const auto b       = record_of_bytes<FlowAnswer>(bytes_of_record(a));
  ASSERT_TRUE(b);
  EXPECT_EQ(b->fine.state.model, a.fine.state.model);
  EXPECT_EQ(b->fine.state.force, a.fine.state.force);
  EXPECT_EQ(b->fine.state.torque, a.fine.state.torque);
  EXPECT_EQ(b->fine.state.force_by[2], 3);
  EXPECT_TRUE(std::isnan(b->fine.state.force_by[3]));
  EXPECT_TRUE(b->fine.state.position == a.fine.state.position);
  ASSERT_EQ(b->fine.state.notes.size(), 2u);
  EXPECT_EQ(b->fine.state.notes[0].id, WarningId::bite_angle);
  EXPECT_EQ(b->fine.state.notes[0].detail, "why");
  EXPECT_EQ(b->fine.state.notes[1].fact, "two");
  EXPECT_TRUE(b->fine.strain == a.fine.strain);
  EXPECT_TRUE(std::isnan(b->fine.roll_surface[1]));
  EXPECT_EQ(b->fine.first_contact, 7);
  EXPECT_EQ(b->fine.balance.power, a.fine.balance.power);
  EXPECT_EQ(b->coarse_slope, a.coarse_slope);
  EXPECT_TRUE(std::isnan(b->coarse_force));
  EXPECT_TRUE(b->elastic);
  EXPECT_TRUE(b->outlet_stress == a.outlet_stress);
  EXPECT_EQ(b->fine.sxx.size(), 0);
}

TEST(StripFlowStore, ACutEntryIsNotUsed)
{
  const std::string bytes = bytes_of_record(some_answer());
  EXPECT_FALSE(record_of_bytes<FlowAnswer>(""));
  EXPECT_FALSE(record_of_bytes<FlowAnswer>(bytes.substr(0, bytes.size() / 2)));
  EXPECT_FALSE(record_of_bytes<FlowAnswer>(bytes + " "));
}
