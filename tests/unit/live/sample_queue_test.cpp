#include "twin/live/queue/sample_queue.h"
#include <chrono>
#include <gtest/gtest.h>
#include <thread>

using namespace mill::live;

namespace {
SourceBlock block(const std::int64_t first, const Eigen::Index n)
{
  return {first, Eigen::MatrixXd::Zero(n, 1)};
}
SourceHead head()
{
  return {1000, {}, "test", {{"force", "N"}}, {1}};
}
}  // namespace

TEST(SampleQueue, HoldsTwoSeconds)
{
  SampleQueue queue;
  queue.push(head());
  for (int i = 0; i < 20; ++i) {
    Message message = block(100 * i, 100);
    EXPECT_TRUE(queue.try_push(message)) << i;
  }
  Message more = block(2000, 1);
  EXPECT_FALSE(queue.try_push(more));
  EXPECT_EQ(queue.samples(), 2000);
  queue.pop(0);  // the head
  queue.pop(0);
  EXPECT_TRUE(queue.try_push(more));
}

TEST(SampleQueue, BlocksTheSenderUntilThereIsRoom)
{
  SampleQueue queue;
  queue.push(head());
  queue.push(block(0, 2000));
  bool pushed = false;
  std::thread reader([&] { pushed = queue.push(block(2000, 500)); });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(queue.samples(), 2000) << "nothing was taken beyond the limit";
  queue.pop(0);
  queue.pop(0);
  reader.join();
  EXPECT_TRUE(pushed);
  EXPECT_EQ(queue.samples(), 500);
}

TEST(SampleQueue, DroppedBlocksKeepTheirPlace)
{
  SampleQueue queue;
  queue.push(head());
  for (int i = 0; i < 30; ++i)
    queue.push_or_drop(block(100 * i, 100));
  queue.pop(0);
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(std::get<SourceBlock>(*queue.pop(0)).first, 100 * i);
  queue.push_or_drop(block(3000, 100));
  const auto dropped = std::get<DroppedBlock>(*queue.pop(0));
  EXPECT_EQ(dropped.first, 2000);
  EXPECT_EQ(dropped.n, 1000);
  EXPECT_EQ(std::get<SourceBlock>(*queue.pop(0)).first, 3000);
}

TEST(SampleQueue, ABlockLongerThanTheQueuePassesAlone)
{
  SampleQueue queue;
  queue.push(head());
  Message longer = block(0, 8192);
  EXPECT_TRUE(queue.try_push(longer));
}

TEST(SampleQueue, ClosingReleasesWhoWaits)
{
  SampleQueue queue;
  queue.push(head());
  queue.push(block(0, 2000));
  bool pushed = true;
  std::thread reader([&] { pushed = queue.push(block(2000, 1)); });
  queue.close();
  reader.join();
  EXPECT_FALSE(pushed);
}
