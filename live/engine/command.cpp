#include "live/engine/command.h"
#include "core/case/errors.h"
#include "core/case/visible_text.h"
#include "live/engine/twin_model.h"
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace mill::live {
namespace {
using Json = nlohmann::json;

constexpr std::size_t most_commands = 1000;

void require_members(const Json &json, const std::vector<std::string> &names)
{
  for (const auto &[name, value] : json.items())
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError(fmt::format("the command \"{}\" has no member \"{}\"", json["command"].get<std::string>(),
                                   visible(name, true)));
}

Command set_of(const Json &json)
{
  require_members(json, {"command", "key", "factor"});
  Command command{Command::Kind::set, "", 1, ""};
  if (!json.contains("key") || !json["key"].is_string())
    throw InputError("\"set\" needs \"key\": K1 to K7 or damping");
  command.key = json["key"].get<std::string>();
  const bool spring =
      command.key.size() == 2 && command.key[0] == 'K' && command.key[1] >= '1' && command.key[1] <= '7';
  if (!spring && command.key != "damping")
    throw InputError(
        fmt::format("there is no key \"{}\"; K1 to K7 and damping can be set", visible(command.key, true)));
  if (!json.contains("factor") || !json["factor"].is_number())
    throw InputError("\"set\" needs \"factor\", a number");
  command.factor = json["factor"].get<double>();
  if (!(command.factor >= smallest_factor && command.factor <= largest_factor))
    throw InputError(fmt::format("the factor {:g} of {} is outside {:g} .. {:g}", command.factor, command.key,
                                 smallest_factor, largest_factor));
  return command;
}

std::string text_of(const Json &json, const char *name)
{
  if (json.contains(name) && json[name].is_string())
    return json[name].get<std::string>();
  if (json.contains(name) && json[name].is_number_integer())
    return json[name].dump();
  throw InputError(fmt::format("\"{}\" needs \"{}\"", json["command"].get<std::string>(), name));
}
}  // namespace

Command command_of(const std::string &text)
{
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("command") || !json["command"].is_string())
    throw InputError("a command is an object with \"command\": set, reset, adopt or acknowledge");
  const auto name = json["command"].get<std::string>();
  if (name == "set")
    return set_of(json);
  if (name == "reset") {
    require_members(json, {"command"});
    return {Command::Kind::reset, "", 1, ""};
  }
  if (name == "adopt") {
    require_members(json, {"command", "proposal"});
    return {Command::Kind::adopt, "", 1, text_of(json, "proposal")};
  }
  if (name == "acknowledge") {
    require_members(json, {"command", "alarm"});
    return {Command::Kind::acknowledge, "", 1, text_of(json, "alarm")};
  }
  throw InputError(
      fmt::format("there is no command \"{}\"; set, reset, adopt and acknowledge are known", visible(name, true)));
}

void CommandQueue::push(const std::string &json)
{
  Command command = command_of(json);
  const std::lock_guard lock(mutex_);
  if (commands_.size() == most_commands)
    throw InputError("too many commands wait");
  commands_.push_back(std::move(command));
}

std::vector<Command> CommandQueue::take()
{
  const std::lock_guard lock(mutex_);
  return std::exchange(commands_, {});
}
}  // namespace mill::live
