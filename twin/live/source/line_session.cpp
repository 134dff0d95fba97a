#include "twin/live/source/line_session.h"
#include "core/base/errors.h"
#include "core/base/si_unit.h"
#include "core/base/text.h"
#include "core/base/visible_text.h"
#include "twin/live/source/row_times.h"
#include "twin/records/channel_names.h"
#include "twin/records/channel_scale.h"
#include "twin/records/known_channel.h"
#include "twin/records/record_clock.h"
#include "twin/web/server/page_rules.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mill::live {
namespace {
constexpr double largest_s    = 9007199254740992.0;  // 2^53: beyond, not every number is one
constexpr double highest_rate = 1e6;                 // Hz
constexpr double lowest_rate  = 10;                  // Hz
constexpr int bad_lines       = 5;
constexpr double silent       = 5;  // s, after which another source may begin where lines have no sender

std::string one_line(const std::string &text)
{
  return visible(text, true);
}
}  // namespace

KnownChannels known_channels(const std::vector<NamedUnit> &sent, const SourceRules &rules)
{
  KnownChannels known;
  for (const NamedUnit &channel : sent) {
    const auto mapped      = rules.reading.channels.find(channel.name);
    const std::string name = mapped != rules.reading.channels.end() ? mapped->second : channel.name;
    const auto given       = rules.reading.units.find(channel.name);
    const std::string unit = given != rules.reading.units.end() ? given->second : channel.unit;
    auto column_unit       = twin::unit_of_column(unit, name);
    if (const auto scale = twin::scale_of(channel.name, column_unit, rules.reading))
      column_unit = *scale;
    const std::string spoken = unit.empty() ? "no unit" : fmt::format("the unit \"{}\"", one_line(unit));
    using twin::KnownChannel;
    const auto known_name = choice_named<KnownChannel>(name);
    const bool is_force   = known_name == KnownChannel::force || known_name == KnownChannel::load_cell;
    const bool is_speed   = known_name == KnownChannel::speed || known_name == KnownChannel::exit_speed ||
                          known_name == KnownChannel::entry_speed;
    const bool is_place = std::find(rules.places.begin(), rules.places.end(), name) != rules.places.end();
    if ((is_force && column_unit.quantity != twin::Quantity::force) ||
        (is_speed && column_unit.quantity != twin::Quantity::speed) || (is_place && !column_unit.known))
      throw InputError(fmt::format("channel \"{}\" has {}; {} is needed", one_line(name), spoken,
                                   is_force   ? "a force (N, kN, MN)"
                                   : is_speed ? "a speed (m/s, m/min)"
                                              : "an acceleration (g, m/s2) or a velocity (mm/s)"));
    for (const LiveChannel &other : known.channels)
      if (other.name == name)
        throw InputError(fmt::format("channel \"{}\" appears twice", one_line(name)));
    known.channels.push_back({name, column_unit.known ? column_unit.si : unit});
    known.factor.push_back(column_unit.known ? column_unit.factor : 1);
  }
  if (std::none_of(known.channels.begin(), known.channels.end(), [](const LiveChannel &c) {
        return twin::is_driving_force(c.name) || is_in(c.unit, SiUnit::acceleration);
      }))
    throw InputError("no channel \"force\", which drives the twin, and no acceleration; name the column of the "
                     "rolling force with --channel NAME=force, or give the unit of an acceleration with --unit "
                     "NAME=g");
  return known;
}

LineSession::LineSession(SourceRules rules) : rules_(std::move(rules)), head_(rules_.assumed) {}

LineSession::Answer LineSession::refuse(std::string reason, const std::int64_t first, const std::int64_t n)
{
  Answer answer;
  ++bad_in_a_row_;
  // A sender whose first line is not a head gets no second try: a browser sends HTTP, then data that a page chose.
  answer.close = rules_.closes && (!head_ || bad_in_a_row_ >= bad_lines);
  nlohmann::ordered_json reply;
  reply["rejected"] = reason;
  reply["line"]     = lines_;
  if (answer.close)
    reply["closed"] = head_ ? "five bad lines in a row" : "the first line has to be a head";
  answer.reply   = reply.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  answer.message = RefusedLine{fmt::format("line {}: {}", lines_, reason), first, n};
  return answer;
}

LineSession::Answer LineSession::take(const std::string_view line)
{
  ++lines_;
  if (is_blank(line))
    return {};
  LineContent content;
  std::string problem;
  if (!read_line(line, content, problem))
    return refuse(problem);
  return content.is_head ? head(content) : block(content);
}

LineSession::Answer LineSession::head(const LineContent &content)
{
  if (content.version != 1.0)
    return refuse("\"millstand\" is not 1, the only version there is");
  if (!rules_.token.empty() && !web::same_token(content.token, rules_.token))
    return refuse("\"token\" is missing or wrong");
  if (!content.rate || !(*content.rate >= lowest_rate && *content.rate <= highest_rate))
    return refuse(fmt::format("\"rate\" is {}; {:g} to {:g} samples per second are allowed",
                              content.rate ? fmt::format("{:g}", *content.rate) : "missing", lowest_rate,
                              highest_rate));
  if (!content.values.empty() || content.s)
    return refuse("a head has no samples; send them in lines of their own");
  std::vector<NamedUnit> sent;
  for (const auto &[name, unit] : content.units)
    sent.push_back({name, unit});
  SourceHead head;
  KnownChannels known;
  try {
    known = known_channels(sent, rules_);
    if (!content.start.empty()) {
      twin::RecordClock clock(rules_.reading);
      clock.seconds_of(content.start, {});
      head.start = clock.start();
      if (!head.start)
        return refuse("\"start\" has no date; write for example 2026-01-05T10:00:00Z");
    }
  } catch (const InputError &error) {
    return refuse(error.problems.front().message);
  }
  if (rules_.clock && head_ && head_->source != content.source && rules_.clock() - last_block_ < silent)
    return refuse(
        fmt::format("source \"{}\" begins while \"{}\" sends, which goes on; blocks of two sources cannot be "
                    "distinguished here: stop one of them, or give it another stand",
                    one_line(content.source), one_line(head_->source)));
  head.rate     = *content.rate;
  head.source   = content.source;
  head.channels = known.channels;
  head.factor   = known.factor;
  head_         = head;
  last_end_     = -1;
  bad_in_a_row_ = 0;
  Answer answer;
  answer.message = head;
  nlohmann::ordered_json reply{{"millstand", 1}};
  if (rules_.next)
    if (const auto next = rules_.next(head))
      reply["next"] = *next;
  answer.reply = reply.dump();
  return answer;
}

LineSession::Answer LineSession::block(const LineContent &content)
{
  if (!head_)
    return refuse("a block before the head; send {\"millstand\":1,\"rate\":..,\"units\":{..}} first");
  if (!content.s || *content.s < 0 || *content.s > largest_s || *content.s != std::floor(*content.s))
    return refuse("\"s\", the number of the first sample, is missing or no whole number from 0 to 2^53");
  const auto s  = std::int64_t(*content.s);
  std::size_t n = 0;
  for (const auto &[name, list] : content.values)
    n = std::max(n, list.size());
  if (n == 0)
    return refuse("no samples");
  const double ahead = last_end_ < 0 ? 0 : double(s - last_end_) / head_->rate;
  if (ahead >
      RowTimes::longest_jump)  // a slip of the sender: what is new is not believed, and what was lost not counted
    return refuse(fmt::format(
        "\"s\":{} is {:.0f} s ahead of the block before; send a new head to go on from there", s, ahead));
  const auto rows = std::int64_t(n);
  SourceBlock block;
  block.first = s;
  block.value = Eigen::MatrixXd::Constant(rows, Eigen::Index(head_->factor.size()),
                                          std::numeric_limits<double>::quiet_NaN());
  for (const auto &[sent, list] : content.values) {
    const auto mapped       = rules_.reading.channels.find(sent);
    const std::string &name = mapped != rules_.reading.channels.end() ? mapped->second : sent;
    const auto channel      = std::find_if(head_->channels.begin(), head_->channels.end(),
                                           [&, &its = name](const LiveChannel &c) { return c.name == its; });
    if (channel == head_->channels.end())
      return refuse(fmt::format("\"{}\" is not in the \"units\" of the head", one_line(sent)), s, rows);
    if (list.size() != n && list.size() != 1)
      return refuse(fmt::format("\"{}\" has {} samples, the longest list {}; one, or as many as the longest, are "
                                "needed",
                                one_line(sent), list.size(), n),
                    s, rows);
    const auto c = channel - head_->channels.begin();
    if (list.size() == 1)
      block.value.col(c).setConstant(list.front() * head_->factor[std::size_t(c)]);
    else
      block.value.col(c) = Eigen::Map<const Eigen::VectorXd>(list.data(), rows) * head_->factor[std::size_t(c)];
  }
  if ((block.value.array().abs() == std::numeric_limits<double>::infinity()).any())
    return refuse("a number that is not finite in SI", s, rows);
  last_end_ = s + rows;
  if (rules_.clock)
    last_block_ = rules_.clock();
  bad_in_a_row_ = 0;
  Answer answer;
  answer.message = std::move(block);
  answer.reply   = fmt::format("{{\"ack\":{}}}", s);
  return answer;
}
}  // namespace mill::live
