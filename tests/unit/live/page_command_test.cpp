#include "tests/support/refusal.h"
#include "twin/live/page/page_command.h"
#include <gtest/gtest.h>

namespace live = mill::live;

namespace {
std::string refused(const std::string &json)
{
  return refusal([&] { live::page_command(json); });
}
}  // namespace

TEST(PageCommand, EachIsRead)
{
  const auto set = live::page_command(R"( {"command":"set","key":"K3","factor":1.1} )");
  EXPECT_EQ(set.kind, live::PageCommandKind::set);
  EXPECT_EQ(set.key, "K3");
  EXPECT_EQ(set.factor, 1.1);
  EXPECT_EQ(live::page_command(R"({"command":"reset"})").key, "");
  EXPECT_EQ(live::page_command(R"({"command":"reset","key":"damping"})").key, "damping");
  EXPECT_EQ(live::page_command(R"({"command":"adopt","id":3})").id, 3);
  EXPECT_EQ(live::page_command(R"({"id":7,"command":"acknowledge"})").id, 7);
  EXPECT_EQ(live::page_command(R"({"command":"place","place":"upper_work_roll"})").place, "upper_work_roll");
  EXPECT_EQ(live::page_command(R"({"command":"advice"})").kind, live::PageCommandKind::advice);
}

TEST(PageCommand, RefusesOtherCommandsWithAReason)
{
  const std::string factor = "command: \"factor\" is a number from 0.5 to 1.5, times the model's own value";
  const std::string flat   = "command: a JSON object without lists or objects inside is needed";
  EXPECT_EQ(refused(""), "command: this is not JSON");
  EXPECT_EQ(refused("{\"command\":\"set\""), "command: this is not JSON");
  EXPECT_EQ(refused("{\"command\":\"set\",\"key\":\"K3\",\"factor\":1e999}"), "command: this is not JSON");
  EXPECT_EQ(refused("7"),
            "command: a JSON object is needed, such as {\"command\":\"set\",\"key\":\"K3\",\"factor\":1.1}");
  EXPECT_EQ(refused("[]"), flat);
  EXPECT_EQ(refused(R"({"command":"set","key":{"a":{"b":1}},"factor":1})"), flat);
  EXPECT_EQ(refused(std::string(60000, '[')), flat);
  EXPECT_EQ(refused("{}"), "command: \"command\" is missing");
  EXPECT_EQ(refused(R"({"command":3})"), "command: \"command\" is a text of at most 64 characters");
  EXPECT_EQ(refused(R"({"command":"stop"})"),
            "command: unknown; there are set, reset, adopt, acknowledge, place, advice");
  EXPECT_EQ(refused(R"({"command":"set","key":"K3"})"), "command: \"factor\" is missing");
  EXPECT_EQ(refused(R"({"command":"set","factor":1})"), "command: \"key\" is missing");
  EXPECT_EQ(refused(R"({"command":"set","key":"K3","factor":"1.1"})"), factor);
  EXPECT_EQ(refused(R"({"command":"set","key":"K3","factor":1.51})"), factor);
  EXPECT_EQ(refused(R"({"command":"set","key":"K3","factor":0})"), factor);
  EXPECT_EQ(refused(R"({"command":"set","key":"K3","factor":null})"), factor);
  EXPECT_EQ(refused(R"({"command":"set","key":"K3","factor":1,"file":"/etc/passwd"})"),
            "command: set has no such member; it takes factor, key");
  EXPECT_EQ(refused(R"({"command":"advice","id":1})"), "command: advice has no such member; it takes none");
  EXPECT_EQ(refused(R"({"command":"adopt","id":"1"})"), "command: \"id\" is a whole number");
  EXPECT_EQ(refused(R"({"command":"adopt","id":1.5})"), "command: \"id\" is a whole number");
  EXPECT_EQ(refused(R"({"command":"adopt","id":18446744073709551615})"), "command: \"id\" is a whole number");
}
