#include "report/results/output_reference.h"
#include <cstdio>

// Prints docs/output.md from the folders of finished runs; called by tests/bench/output-reference.
int main(int count, char **folders)
{
  std::vector<mill::report::Run> runs;
  for (int i = 1; i < count; ++i)
    runs.push_back(mill::report::read_run(folders[i]));
  std::fputs(mill::report::output_reference(runs).c_str(), stdout);
}
