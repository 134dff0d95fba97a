#include "app/kinds/kind_inputs.h"
namespace mill {
bool begins(const std::string &name, const std::string &prefix)
{
  return name.rfind(prefix, 0) == 0;
}

bool ends(const std::string &name, const std::string &ending)
{
  return name.size() >= ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

std::optional<KeyList> bite_inputs(MovingKeys &keys, const std::size_t p, const BiteSetup &setup,
                                   const std::string &name, const std::string &pass)
{
  BiteReading reading;
  reading.path_trim        = name == "K4.path_plateau";
  const std::string prefix = "bite." + pass + ".";
  if (begins(name, "K4."))
    return bite_keys(keys, p, reading);
  if (begins(name, "bite.fit.") && !setup.fit.empty())
    return bite_keys(keys, p);
  if (!begins(name, prefix))
    return {};
  const std::string quantity = name.substr(prefix.size());
  if (quantity.find('.') != std::string::npos && !begins(quantity, "fe."))
    reading.by = BiteAnswers::compared;
  reading.whole_width = follows_width(quantity.substr(quantity.rfind('.') + 1));
  reading.speed       = ends(quantity, "_speed");
  return bite_keys(keys, p, reading);
}
}  // namespace mill
