#include "refuse_input.h"
#include <stdexcept>

// In a unit there is no case file to point at.
void mill::refuse_input(const std::string &message)
{
  throw std::runtime_error(message);
}
