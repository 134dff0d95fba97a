#include "core/records/stand_place.h"

namespace mill {
StandPlace stand_place(const std::string &name)
{
  const auto says = [&](const char *word) { return name.find(word) != std::string::npos; };
  StandPlace place;
  place.lower    = name.rfind("lower", 0) == 0;
  place.work     = says("work");
  place.backup   = says("backup");
  place.roll     = says("roll");
  place.chock    = says("chock");
  place.seat     = says("seat");
  place.end      = says(" end");
  place.frame    = says("frame");
  place.housing  = says("housing");
  place.cylinder = says("cylinder");
  return place;
}

bool has_spring(const std::string &connection, const SeatSpring spring)
{
  return (series_mark + connection + series_mark).find(std::string(series_mark) + word_of(spring) + series_mark) !=
         std::string::npos;
}
}  // namespace mill
