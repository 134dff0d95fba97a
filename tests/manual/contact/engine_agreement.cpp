#include "tests/manual/contact/engine_agreement.h"
#include "core/base/parameter.h"
#include "fem/roll/contact_study.h"
#include "fem/roll/fourier_contact.h"
#include "meshes/bearing/meridian.h"
#include "meshes/roll/contact_mesh_size.h"
#include "reduce/chain/line_contact.h"
#include "tests/manual/contact/roll_models.h"
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace mill::verify {
namespace {
fem::FourierRoll fourier_model(const std::string &name, const RollGeometry &geometry, const double half_width,
                               const Material &material, const Eigen::VectorXd &edge = {})
{
  const auto file =
      std::filesystem::temp_directory_path() / fmt::format("millstand-verify-{}-{}.msh", ::getpid(), name);
  const auto mesh = meshes::mesh_meridian(name, geometry, meshes::meridian_size(half_width), file.string());
  const fem::SectionBody body(mesh, material, 2, fem::Section::axisymmetric);
  std::filesystem::remove(file);
  fem::FourierOptions options;
  options.half_width = half_width;
  return fem::fourier_roll(body, geometry, material, edge.size() > 0 ? edge : fem::stations_of(body), options);
}

// (n) N/m, means over the stations of the series of the line load of quadratic elements: parabolas through the
// nodes of each, integrated.
Eigen::VectorXd station_means(const BarrelProfile &profile, const fem::FourierPair &series)
{
  const Eigen::VectorXd &z = profile.z, &q = profile.line_load;
  // N, from mid-length to `at`
  const auto force = [&](const double position) {
    double sum = 0;
    for (Eigen::Index i = 0; i + 2 < z.size() && z[i] < position; i += 2) {
      const double h = z[i + 2] - z[i], t = std::min(1., (position - z[i]) / h);
      const double slope = -3 * q[i] + 4 * q[i + 1] - q[i + 2], bend = 2 * q[i] - 4 * q[i + 1] + 2 * q[i + 2];
      sum += h * t * (q[i] + t * (slope / 2 + t * bend / 3));
    }
    return sum;
  };
  Eigen::VectorXd mean(series.z.size());
  for (Eigen::Index k = 0; k < mean.size(); ++k) {
    const double half = 0.5 * series.length[k];
    mean[k]           = (force(series.z[k] + half) - force(series.z[k] - half)) / series.length[k];
  }
  return mean;
}
// What is compared, and how far the line load at the barrel end was apart when that was recorded.
struct Compared {
  std::string how;
  fem::ContactPair solid;
  fem::FourierPair series;
  double at_the_end;
};

// The unknowns of the series are means over its stations: means of the same stretches of the hexahedra.
void compare_line_loads(std::vector<Check> &checks, const Compared &c, const BarrelProfile &solid,
                        const fem::FourierPoint &series)
{
  const Eigen::VectorXd mean = station_means(solid, c.series);
  const Eigen::VectorXd off  = (series.line_load.array() / mean.array() - 1).abs();
  const Eigen::Index most    = off.size() - 2;
  const double end           = c.series.z[most] - 0.5 * c.series.length[most];
  const auto difference      = [&](const std::string &where, const double worst) {
    return Check{c.how + ": line load, largest difference " + where, "-", worst, 0, 0.01, Judged::absolute};
  };
  checks.push_back(
      difference(fmt::format("of {} stations up to {:.1f} mm", most, 1e3 * end), off.head(most).maxCoeff()));
  checks.push_back(
      known_deviation(difference("of the last two, up to 700 mm", off.tail(2).maxCoeff()),
                      {c.at_the_end, 0.01,
                       "the last two stations lie within 1.4 half widths of the sharp end, where the line load "
                       "falls to two thirds "
                       "inside one of them; the series has an even load along a station and Hertz's semi-ellipse "
                       "across it. Layers "
                       "of hexahedra a quarter as thick make it 0.071 and 0.063: their mesh is not the reason",
                       "shorter stations at the end and a pressure of its own shape across them, in the series"}));
}

void compare(std::vector<Check> &checks, const Compared &c, const double F)
{
  // Tangents as slopes over loads so far apart that single nodes do not count.
  const auto slope = [&](const auto &pair) {
    return F * (1.6 - 1 / 1.6) /
           (fem::solve_load(pair, 1.6 * F).approach - fem::solve_load(pair, F / 1.6).approach);
  };
  const auto one = fem::solve_load(c.solid, F);
  const auto two = fem::solve_load(c.series, F);
  checks.push_back({c.how + ": approach", "m", one.approach, two.approach, 0.005});
  checks.push_back({c.how + ": tangent", "N/m", slope(c.solid), slope(c.series), 0.01});
  compare_line_loads(checks, c, fem::barrel_profile(c.solid, one), two);
}
}  // namespace

std::vector<Check> engine_agreement()
{
  const Material material{2.1e11, 0.28, 7700};
  const RollGeometry backup{0.725, 0.7, 0.475, 0.95, 1.225, 0}, work{0.210, 0.7, 0.13335, 0.46, 1.0, 0};
  const double F     = 976217.5;
  const double b     = reduce::line_contact({0.42, 1.45, 1.4, material}, F).half_width;
  auto size          = meshes::roll_contact_size(1.5 * b, 6, 1.25);
  size.largest_layer = 0.07;
  const auto A       = roll_model("backup", backup, size, material, {}),
             B       = roll_model("work", work, size, material, {});
  const auto C       = fourier_model("backup", backup, b, material),
             D       = fourier_model("work", work, b, material, C.edge);
  std::vector<Check> checks;
  const Eigen::VectorXd straight = Eigen::VectorXd::Zero(A.roll.grid.n_z),
                        plain    = Eigen::VectorXd::Zero(C.edge.size() - 1);
  compare(
      checks,
      {"squeezed between mirrored contacts",
       fem::make_pair("upper", A.roll, fem::held_by_mirror(A.roll), B.roll, fem::held_by_mirror(B.roll), straight),
       fem::fourier_pair("upper", C, {}, D, {}, plain), 0.0668},
      F);
  compare(checks,
          {"on necks and a strip of 1000 mm",
           fem::make_pair("upper", A.roll, fem::held_by_necks(A.roll), B.roll, fem::held_by_strip(B.roll, 1),
                          straight),
           fem::fourier_pair("upper", C, {fem::RollSupport::necks, 0}, D, {fem::RollSupport::strip, 1}, plain),
           0.0579},
          F);
  return checks;
}
}  // namespace mill::verify
