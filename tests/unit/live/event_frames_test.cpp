#include "twin/live/page/event_text.h"
#include "twin/live/page/page_server.h"
#include <gtest/gtest.h>

namespace live = mill::live;
namespace web  = mill::web;

namespace {
std::vector<std::string> texts(const std::vector<web::FramePointer> &frames)
{
  std::vector<std::string> out;
  for (const auto &frame : frames)
    out.push_back(frame->text);
  return out;
}
}  // namespace

TEST(EventFrames, AFrameHasAnIdAndOneLineOfData)
{
  web::FrameStore store(live::event_kinds());
  EXPECT_EQ(store.add("numbers", R"({"s":1})")->text, "id: 1\nevent: numbers\ndata: {\"s\":1}\n\n");
  EXPECT_EQ(store.add("alarm", "{\n\"id\":\r\n1}")->text, "id: 2\nevent: alarm\ndata: { \"id\":  1}\n\n");
}

TEST(EventFrames, KeepsTwoFramesOfEachKindAndAllAlarms)
{
  web::FrameStore store(live::event_kinds());
  web::FrameQueue queue;
  for (int k = 1; k <= 5; ++k) {
    queue.push(store.add("numbers", std::to_string(k)));
    queue.push(store.add("spectrum", std::to_string(10 * k)));
    queue.push(store.add("alarm", std::to_string(100 * k)));
  }
  EXPECT_EQ(queue.dropped(), 6);
  const auto left = texts(queue.take());
  ASSERT_EQ(left.size(), 9u);
  int alarms = 0;
  for (const auto &text : left)
    alarms += text.find("event: alarm") != std::string::npos;
  EXPECT_EQ(alarms, 5);
  EXPECT_NE(left[left.size() - 3].find("data: 5\n"), std::string::npos);  // the latest of each kind is among them
  EXPECT_NE(left[left.size() - 2].find("data: 50\n"), std::string::npos);
  EXPECT_TRUE(queue.empty());
}

TEST(EventFrames, DisconnectsABrowserWithHundredsOfWaitingAlarms)
{
  web::FrameStore store(live::event_kinds());
  web::FrameQueue queue;
  for (int k = 0; k < 400; ++k)
    queue.push(store.add("alarm", "{}"));
  EXPECT_FALSE(queue.overfull());
  queue.push(store.add("alarm", "{}"));
  EXPECT_TRUE(queue.overfull());
  EXPECT_EQ(queue.dropped(), 0);
}

TEST(EventFrames, ThePresentStateIsTheLatestOfEachKindInOrder)
{
  web::FrameStore store(live::event_kinds());
  for (const char *event : {"numbers", "alarm", "modes", "numbers", "alarm", "parameters", "numbers"})
    store.add(event, "{}");
  std::string ids;
  for (const auto &frame : store.present_state())
    ids += frame->text.substr(4, 1) + frame->event.substr(0, 2) + " ";
  EXPECT_EQ(ids, "2al 3mo 5al 6pa 7nu ");
  for (int k = 0; k < 300; ++k)
    store.add("proposal", "{}");
  EXPECT_EQ(store.present_state().size(), 205u) << "200 proposals, 2 alarms, 3 others";
}

// A gap that grows is one alarm: it pushes out neither other alarms nor a proposal, and no browser.
TEST(EventFrames, OfOneAlarmTheLatestIsKept)
{
  web::FrameStore store(live::event_kinds());
  web::FrameQueue queue;
  queue.push(store.add("proposal", R"({"id":7,"state":"open"})"));
  queue.push(store.add("alarm", R"({"id":3,"kind":"chatter"})"));
  for (int k = 0; k < 1000; ++k)
    queue.push(store.add("alarm", R"({"id":1000000,"kind":"gap","text":")" + std::to_string(k) + "\"}"));
  EXPECT_FALSE(queue.overfull());
  const auto shown = texts(store.present_state()), waiting = texts(queue.take());
  ASSERT_EQ(shown.size(), 3u);
  EXPECT_NE(shown[0].find(R"({"id":7,"state":"open"})"), std::string::npos);
  EXPECT_NE(shown[1].find(R"({"id":3,"kind":"chatter"})"), std::string::npos);
  EXPECT_NE(shown[2].find("\"text\":\"999\""), std::string::npos);
  EXPECT_EQ(waiting, shown);
  store.add("proposal", R"({"id":3,"state":"open"})");
  EXPECT_EQ(store.present_state().size(), 4u) << "the same number of another kind is another thing";
}

// By hand: 200 are kept of 251, the open one among them, so that 51 that are over go.
TEST(EventFrames, AnOpenAlarmIsNotPushedOutByThoseThatAreOver)
{
  web::FrameStore store(live::event_kinds());
  live::PageAlarm alarm;
  alarm.id = 1;
  store.add(live::event_names::alarm, live::alarm_text(alarm));
  alarm.over = true;
  for (alarm.id = 2; alarm.id <= 251; ++alarm.id)
    store.add(live::event_names::alarm, live::alarm_text(alarm));
  auto shown = texts(store.present_state());
  ASSERT_EQ(shown.size(), 200u);
  EXPECT_NE(shown[0].find("\"id\":1,"), std::string::npos) << shown[0];
  EXPECT_NE(shown[1].find("\"id\":53,"), std::string::npos) << shown[1];
  EXPECT_EQ(store.forgotten(), 51);

  // open ones alone may be more, up to a number that bounds the memory
  web::FrameStore open(live::event_kinds());
  alarm.over = false;
  for (alarm.id = 1; alarm.id <= 1000; ++alarm.id)
    open.add(live::event_names::alarm, live::alarm_text(alarm));
  EXPECT_EQ(open.present_state().size(), 1000u);
  EXPECT_EQ(open.forgotten(), 0);
  open.add(live::event_names::alarm, live::alarm_text(alarm));
  shown = texts(open.present_state());
  ASSERT_EQ(shown.size(), 1000u);
  EXPECT_NE(shown[0].find("\"id\":2,"), std::string::npos) << shown[0];
  EXPECT_EQ(open.forgotten(), 1);

  // and so an open proposal
  web::FrameStore proposals(live::event_kinds());
  live::PageProposal proposal;
  proposal.id    = 1;
  proposal.state = "open";
  proposals.add(live::event_names::proposal, live::proposal_text(proposal));
  proposal.state = "out of date";
  for (proposal.id = 2; proposal.id <= 201; ++proposal.id)
    proposals.add(live::event_names::proposal, live::proposal_text(proposal));
  shown = texts(proposals.present_state());
  ASSERT_EQ(shown.size(), 200u);
  EXPECT_NE(shown[0].find("\"id\":1,"), std::string::npos) << shown[0];
}
