#include "log.h"
#include <cstring>

namespace mill::fmu {
const std::vector<LogCategory> &log_categories()
{
  static const std::vector<LogCategory> all{
      {"logEvents", "changes of parameters and of mode"},
      {"logStatusWarning", "calls that are carried out, with something to be noticed"},
      {"logStatusDiscard", "values and calls that are refused without harm"},
      {"logStatusError", "calls that are wrong: out of order, unknown variables, files"},
      {"logStatusFatal", "failures after which the instance can only be freed"},
      {"logAll", "all messages"}};
  return all;
}

Log::Log(const Start start) : enabled_(log_categories().size(), start != Start::nothing)
{
  enabled_.front() = start == Start::all;
  enabled_.back()  = start == Start::all;
}

Status Log::refuse(const Status status, const std::string &message) const
{
  static const char *const categories[] = {"logEvents", "logStatusWarning", "logStatusDiscard", "logStatusError",
                                           "logStatusFatal"};
  say(status, categories[int(status)], message);
  return status;
}

void Log::event(const std::string &message) const
{
  say(Status::ok, "logEvents", message);
}

void Log::say(const Status status, const char *category, const std::string &message) const
{
  const auto &all = log_categories();
  bool wanted     = enabled_.back();
  for (std::size_t i = 0; i < all.size(); ++i)
    wanted = wanted || (enabled_[i] && std::strcmp(all[i].name, category) == 0);
  if (wanted)
    send(status, category, message);
}

std::string Log::enable(const bool on, const std::vector<std::string> &categories)
{
  const auto &all           = log_categories();
  std::vector<bool> enabled = enabled_;
  for (const std::string &name : categories) {
    std::size_t i = 0;
    while (i < all.size() && name != all[i].name)
      ++i;
    if (i == all.size())
      return name;
    enabled[i] = on;
    if (i + 1 == all.size())  // logAll
      enabled.assign(all.size(), on);
  }
  if (categories.empty())
    enabled.assign(all.size(), on);
  if (!on)
    enabled.back() = false;  // one that is switched off is not sent by way of logAll
  enabled_ = enabled;
  return "";
}
}  // namespace mill::fmu
