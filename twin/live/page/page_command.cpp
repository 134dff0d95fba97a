#include "twin/live/page/page_command.h"
#include "core/base/errors.h"
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mill::live {
namespace {
using Json = nlohmann::json;

constexpr double least_factor = 0.5, largest_factor = 1.5;

// One row for each command: its name and the member it needs.
struct CommandRow {
  const char *name;
  PageCommandKind kind;
  const char *needs;     // "" : nothing
  const char *may_have;  // ""
};
constexpr std::array<CommandRow, 6> command_rows{{{"set", PageCommandKind::set, "factor", "key"},
                                                  {"reset", PageCommandKind::reset, "", "key"},
                                                  {"adopt", PageCommandKind::adopt, "id", ""},
                                                  {"acknowledge", PageCommandKind::acknowledge, "id", ""},
                                                  {"place", PageCommandKind::place, "place", ""},
                                                  {"advice", PageCommandKind::advice, "", ""}}};

[[noreturn]] void refuse_command(const std::string &why)
{
  throw InputError("command: " + why);
}

// A command is one object without objects or lists inside: what is nested deeper is not even built.
Json flat_object(const std::string &text)
{
  const auto no_depth = [](const int depth, const Json::parse_event_t event, Json &) {
    if (event == Json::parse_event_t::array_start || (event == Json::parse_event_t::object_start && depth > 0))
      refuse_command("a JSON object without lists or objects inside is needed");
    return true;
  };
  try {
    const Json parsed = Json::parse(text, no_depth);
    if (!parsed.is_object())
      refuse_command("a JSON object is needed, such as {\"command\":\"set\",\"key\":\"K3\",\"factor\":1.1}");
    return parsed;
  } catch (const Json::exception &) {
    refuse_command("this is not JSON");
  }
}

std::string text_of(const Json &object, const char *member)
{
  const auto entry = object.find(member);
  if (entry == object.end())
    refuse_command(fmt::format("\"{}\" is missing", member));
  if (!entry->is_string() || entry->get_ref<const std::string &>().size() > 64)
    refuse_command(fmt::format("\"{}\" is a text of at most 64 characters", member));
  return entry->get<std::string>();
}

std::int64_t id_of(const Json &object)
{
  const auto id = object.find("id");
  if (id == object.end())
    refuse_command("\"id\" is missing");
  if (!id->is_number_integer() || (id->is_number_unsigned() && id->get<std::uint64_t>() > INT64_MAX))
    refuse_command("\"id\" is a whole number");
  return id->get<std::int64_t>();
}

double factor_of(const Json &object)
{
  const auto factor_member = object.find("factor");
  if (factor_member == object.end())
    refuse_command("\"factor\" is missing");
  const double factor = factor_member->is_number() ? factor_member->get<double>() : NAN;
  if (!(factor >= least_factor && factor <= largest_factor))
    refuse_command(fmt::format("\"factor\" is a number from {} to {}, times the model's own value", least_factor,
                               largest_factor));
  return factor;
}

const CommandRow &row_of(const std::string &name)
{
  for (const CommandRow &row : command_rows)
    if (name == row.name)
      return row;
  refuse_command("unknown; there are set, reset, adopt, acknowledge, place, advice");
}
}  // namespace

PageCommand page_command(const std::string &json)
{
  constexpr const char *name_of_command = "command";
  const Json object                     = flat_object(json);
  const CommandRow &row                 = row_of(text_of(object, name_of_command));
  for (const auto &member : object.items())
    if (member.key() != name_of_command && member.key() != row.needs && member.key() != row.may_have)
      refuse_command(fmt::format("{} has no such member; it takes {}{}{}", row.name,
                                 *row.needs || *row.may_have ? row.needs : "none",
                                 *row.needs && *row.may_have ? ", " : "", row.may_have));
  PageCommand command;
  command.kind = row.kind;
  switch (row.kind) {
  case PageCommandKind::set:
    command.key    = text_of(object, "key");
    command.factor = factor_of(object);
    break;
  case PageCommandKind::reset:
    if (object.contains("key"))
      command.key = text_of(object, "key");
    break;
  case PageCommandKind::adopt:
  case PageCommandKind::acknowledge:
    command.id = id_of(object);
    break;
  case PageCommandKind::place:
    command.place = text_of(object, "place");
    break;
  case PageCommandKind::advice:
    break;
  }
  return command;
}
}  // namespace mill::live
