#include "core/model/roller_bearing.h"
#include <algorithm>
#include <map>

// How the rows of a bearing are arranged.  A row of hand + presses its cup towards +z: its contact lines run
// outwards in that direction and its big ends lie on the other side.  "+-" diverges towards the axis: back to
// back.
namespace mill {
namespace {
std::string cut_to(const std::string &arrangement, const int rows)
{
  std::string hands;
  for (int r = 0; r < rows && !arrangement.empty(); ++r)
    hands += arrangement[std::size_t(r) % arrangement.size()];
  return hands;
}
}  // namespace

bool counts_its_chock(const RollerBearing &b)
{
  return b.rings == RingBodies::elastic && b.chock != ChockForm::rigid;
}

std::vector<std::string> usual_arrangements(const int rows)
{
  std::vector<std::string> out;
  for (const char *hands : {"-+-+", "+-+-", "++--", "--++"})
    if (const std::string cut = cut_to(hands, rows); cut.find('+') != std::string::npos &&
                                                     cut.find('-') != std::string::npos &&
                                                     std::find(out.begin(), out.end(), cut) == out.end())
      out.push_back(cut);
  return out;
}

std::string arrangement_name(const std::string &arrangement, const int rows)
{
  static const std::map<std::string, std::string> names{
      {"+-", "back to back (TDO)"},
      {"-+", "face to face (TDI)"},
      {"+-+-", "pairs back to back: two double cups (TQI)"},
      {"-+-+", "pairs face to face: two double cones (TQO)"},
      {"++--", "two tandem pairs back to back"},
      {"--++", "two tandem pairs face to face"},
  };
  const std::string hands = cut_to(arrangement, rows);
  const auto name         = names.find(hands);
  if (name != names.end())
    return hands + ", " + name->second;
  const bool one = hands.find_first_not_of(hands[0]) == std::string::npos;
  return hands + (one && rows > 1 ? ", tandem" : "");
}
}  // namespace mill
