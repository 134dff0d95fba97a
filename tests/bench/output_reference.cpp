#include "report/results/output_reference.h"
#include <cstdio>

// Prints docs/output.md; called by tests/bench/output-reference.
int main()
{
  std::fputs(mill::report::output_reference().c_str(), stdout);
}
