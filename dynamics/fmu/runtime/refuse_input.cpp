#include "refuse_input.h"
#include <stdexcept>

// A unit has no case file whose line a message could name.
void mill::refuse_input(const std::string &message)
{
  throw std::runtime_error(message);
}
