#pragma once
#include <cstdint>
#include <string>

namespace mill::live {
/// What a browser may ask for by POST /command.
enum class PageCommandKind {
  set,          ///< {"command":"set","key":"K3","factor":1.1}: a parameter to factor times the model's own value
  reset,        ///< {"command":"reset"} or with "key": back to the model's own value(s)
  adopt,        ///< {"command":"adopt","id":3}: take the proposal with this id
  acknowledge,  ///< {"command":"acknowledge","id":7}: the alarm with this id was seen
  place,        ///< {"command":"place","place":"upper_work_roll"}: whose spectrum the page shows
  advice,       ///< {"command":"advice"}: compute what would lower the vibration
};

struct PageCommand {
  PageCommandKind kind = PageCommandKind::reset;
  std::string key;      ///< of set and reset: "K1".."K7", "damping"; empty: all
  double factor   = 1;  ///< -, of set, 0.5 .. 1.5
  std::int64_t id = 0;  ///< of adopt and acknowledge
  std::string place;    ///< of place
};

/// Reads a command; whether key, id and place exist is for the caller to say.
/// @throws InputError  no JSON object, a list or an object inside it, unknown command or member, a member of
/// another kind, a factor that is not in 0.5 .. 1.5
PageCommand page_command(const std::string &json);
}  // namespace mill::live
