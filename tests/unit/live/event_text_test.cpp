#include "twin/live/page/event_text.h"
#include "twin/web/server/json_writer.h"
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace live = mill::live;
using nlohmann::json;

TEST(EventText, TracesHoldTheExtremesOfEveryPiece)
{
  std::vector<double> samples(1000);
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i] = std::sin(2 * M_PI * 746 * double(i) / 20000);  // 23 samples a period, 31 a piece
  const auto trace = live::trace(samples.data(), 1000);
  ASSERT_EQ(trace.low.size(), 32u);
  for (std::size_t k = 0; k < 32; ++k) {
    EXPECT_LT(trace.low[k], -0.96);
    EXPECT_GT(trace.high[k], 0.96);
  }
  const double some[] = {NAN, 2, NAN, NAN, -1};
  const auto few      = live::trace(some, 5, 3);  // pieces {NaN}, {2, NaN}, {NaN, -1}
  ASSERT_EQ(few.low.size(), 3u);
  EXPECT_TRUE(std::isnan(few.low[0]) && std::isnan(few.high[0]));
  EXPECT_EQ(few.low[1], 2);
  EXPECT_EQ(few.high[2], -1);
  EXPECT_TRUE(live::trace(some, 0).low.empty());
}

TEST(EventText, FloatsAreLittleEndianBase64)
{
  // 1.0f is 00 00 80 3f; base64 of RFC 4648.
  EXPECT_EQ(mill::web::base64_floats({1.0f}), "AACAPw==");
  EXPECT_EQ(mill::web::base64_floats({1.0f, -2.0f}), "AACAPwAAAMA=");
  EXPECT_EQ(mill::web::base64_floats({1.0f, -2.0f, 0.0f}), "AACAPwAAAMAAAAAA");
  EXPECT_EQ(mill::web::base64_floats({}), "");
}

TEST(EventText, UnknownNumbersAreNullAndTextsAreEscaped)
{
  live::PageStand stand;
  stand.name      = "M\xc3\xbchle \"3\"\n\xff";
  stand.places    = {{"upper_work_roll", "upper work roll", 1889, live::unknown, INFINITY, true}};
  const json text = json::parse(live::stand_text(stand));
  EXPECT_EQ(text.at("name"), "M\xc3\xbchle \"3\"\n\xef\xbf\xbd");
  EXPECT_TRUE(text.at("places").at(0).at("diameter").is_null());
  EXPECT_TRUE(text.at("places").at(0).at("length").is_null());
  EXPECT_EQ(text.at("places").at(0).at("mass"), 1889);
}

TEST(EventText, NumbersAreReadAgain)
{
  live::PageNumbers numbers;
  numbers.s            = 123456789012;
  numbers.utc          = 1767600000.125;
  numbers.state        = "running";
  numbers.displacement = {1.5e-6, -2.5e-7};
  numbers.measured     = {{{-1, NAN}, {2, NAN}}, {}};
  const json text      = json::parse(live::numbers_text(numbers));
  EXPECT_EQ(text.at("s"), 123456789012);
  EXPECT_EQ(text.at("utc"), 1767600000.125);
  EXPECT_TRUE(text.at("force").is_null());
  EXPECT_EQ(text.at("displacement"), json({1.5e-6, -2.5e-7}));
  EXPECT_EQ(text.at("measured"), json::parse("[[-1,2,null,null],[]]"));
}

// Every other text is JSON of the members that docs/live-page.md names, in its table of events.
TEST(EventText, EveryEventIsAnObjectWithItsMembers)
{
  live::PageAccount account;
  account.channels = {{"force", 10, 4, 3, 2, 1}};
  live::PageLevels levels;
  levels.places               = {{"upper_work_roll"}};
  levels.places[0].incoherent = {{125, 0.25}};
  live::PageModes modes;
  modes.modes = {{"third octave", 218.3}};
  live::PageChatter chatter;
  chatter.bands = {{"third octave", 218.3}};
  live::PageProposal proposal;
  proposal.values = {{"K3", "N/m", 4e10, 3.9e10}};
  live::PageParameters parameters;
  parameters.sliders = {{"K3", 1.1}};
  live::PageAdvice advice;
  advice.rows        = {{"oil x 0.8", -0.12}};
  const auto members = [](const std::string &text) {
    std::string names;
    const json object = json::parse(text);
    for (const auto &member : object.items())
      names += member.key() + " ";
    return names;
  };
  EXPECT_EQ(members(live::levels_text(levels)), "places seconds utc ");
  EXPECT_EQ(json::parse(live::levels_text(levels)).at("places").at(0).at("incoherent"),
            json::parse("[[125,0.25]]"));
  EXPECT_EQ(members(live::spectrum_text({})),
            "df enbw latest measured place segments simulated utc wave_measured wave_simulated wave_step window ");
  EXPECT_EQ(members(live::account_text(account)),
            "channels connected forgotten load queue queue_limit recorded recording source trouble utc ");
  EXPECT_EQ(json::parse(live::account_text(account)).at("channels").at(0).at("overrun"), 1);
  EXPECT_EQ(members(live::modes_text(modes)), "modes utc ");
  EXPECT_EQ(json::parse(live::modes_text(modes)).at("modes").at(0).at("twin"), 218.3);
  EXPECT_EQ(members(live::chatter_text(chatter)),
            "alarm_ratio bands because critical distance growth growth_limit high low speed utc ");
  EXPECT_EQ(members(live::alarm_text({})), "acknowledged id kind level over text utc ");
  EXPECT_EQ(members(live::proposal_text(proposal)), "file id state text utc values ");
  EXPECT_EQ(json::parse(live::proposal_text(proposal)).at("values").at(0).at("to"), 3.9e10);
  EXPECT_EQ(members(live::parameters_text(parameters)), "frequencies origin place sliders ");
  EXPECT_EQ(members(live::motion_text({})), "displacement step utc ");
  EXPECT_EQ(members(live::advice_text(advice)), "goal rows state text utc ");
}
