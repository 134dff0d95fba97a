#include "fem/contact/hertz.h"
#include "meshes/common/mesher.h"
#include "reduce/chain/line_contact.h"
#include <cstdio>

int main()  // half widths of a roll contact by two libraries, m; and whether the finite elements open
{
  const mill::Material steel{2.1e11, 0.3, 7850};
  const double load = 976e3, length = 1.4, r1 = 0.21, r2 = 0.5;
  const auto chain = mill::reduce::line_contact({2 * r1, 2 * r2, length, steel}, load);
  const auto hertz = mill::contact::hertz_line(load / length, r1 * r2 / (r1 + r2), 2.1e11 / (1 - 0.09) / 2);
  std::printf("%.9g %.9g %s\n", chain.half_width, hertz.half_width,
              mill::meshes::mesher().mesh_roll ? "open" : "");
}
