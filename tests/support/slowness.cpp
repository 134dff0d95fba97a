#include "tests/support/slowness.h"

int slowness()
{
  return MILLSTAND_SLOWER;
}
