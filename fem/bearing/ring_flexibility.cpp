#include "fem/bearing/ring_flexibility.h"
#include "core/process/parallel.h"
#include "fem/bearing/chock_flexibility.h"
#include "fem/body/harmonic_body.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <sstream>

namespace mill::fem {
namespace {
// (3 N, rows modes): unit loads on all contact lines.
Eigen::MatrixXd line_loads(const SectionBody &body, const RingSection &section, const int modes)
{
  const int rows = int(section.raceways.size());
  Eigen::MatrixXd out(3 * body.nodes().rows(), rows * modes);
  for (int r = 0; r < rows; ++r)
    out.middleCols(r * modes, modes) =
        raceway_loads(body, "raceway." + std::to_string(r), section.raceways[std::size_t(r)], section.length,
                      modes, section.inner ? -1 : 1);
  return out;
}

// Raceway of hand +1 at mid-bearing.
RingSection one_raceway(RingSection section)
{
  RacewayLine line = section.raceways[0];
  line.middle[1]   = 0;
  line.normal[1]   = std::abs(line.normal[1]);
  line.along       = {-line.normal[1], line.normal[0]};
  line.hand        = 1;
  section.raceways = {line};
  return section;
}

// A body of revolution under unit loads on its contact lines.
class LoadedSection {
public:
  LoadedSection(const RingSection &section, const MeshFile &mesh, const Material &material, const int modes)
      : body(mesh, material, 2, Section::axisymmetric), harmonic(body), loads(line_loads(body, section, modes))
  {
  }
  Eigen::MatrixXd flexibility(const int m) const
  {
    return harmonic.flexibility(m, loads);
  }
  int n_unknowns() const
  {
    return harmonic.n_unknowns();
  }

private:
  SectionBody body;
  HarmonicBody harmonic;
  Eigen::MatrixXd loads;
};

// One ring harmonic by harmonic, and the raceway whose deformation is part of the law of one roller.
class Ring {
public:
  Ring(const RingSection &ring, const MeshFile &whole_mesh, const MeshFile &raceway_mesh, const Material &material,
       const int n_modes)
      : section(ring), body(ring, whole_mesh, material, n_modes),
        raceway(one_raceway(ring), raceway_mesh, material, n_modes), modes(n_modes)
  {
  }
  Eigen::MatrixXd whole(const int m) const
  {
    return body.flexibility(m);
  }
  // (rows modes)^2, block diagonal: a row of the other hand is the mirror image, x and with it P_1, P_3 .. turned.
  Eigen::MatrixXd on_rigid_back(const int m) const
  {
    const Eigen::MatrixXd one = raceway.flexibility(m);
    const int rows            = int(section.raceways.size());
    Eigen::MatrixXd out       = Eigen::MatrixXd::Zero(rows * modes, rows * modes);
    for (int r = 0; r < rows; ++r)
      for (int a = 0; a < modes; ++a)
        for (int b = 0; b < modes; ++b)
          out(r * modes + a, r * modes + b) =
              one(a, b) * (section.raceways[std::size_t(r)].hand < 0 && (a + b) % 2 == 1 ? -1 : 1);
    return out;
  }
  int n_unknowns() const
  {
    return body.n_unknowns();
  }

private:
  const RingSection &section;
  LoadedSection body, raceway;
  int modes;
};

// Harmonics until several in a row are below the share; returns the largest of those against the sum.
double series(const Ring &ring, const RingOptions &options, std::vector<Eigen::MatrixXd> &out,
              const std::function<void(int)> &done)
{
  double sum = 0, recent = 0;
  int small = 0;
  for (int m = 0; m <= options.last_harmonic && small < 3; ++m) {
    out.push_back(ring.whole(m) - ring.on_rigid_back(m));
    const double size = out.back().cwiseAbs().maxCoeff();
    sum += size;
    small  = size < options.share * sum ? small + 1 : 0;
    recent = size / sum;
    done(m);
  }
  return recent;
}
}  // namespace

double stribeck_flexibility(const bearing::RingFlexibility &rings, const int Z)
{
  Eigen::VectorXd q(Z), psi(Z);
  for (int j = 0; j < Z; ++j) {
    psi[j] = 2 * M_PI * j / Z;
    q[j]   = std::pow(std::max(0., std::cos(psi[j])), 10. / 9);
  }
  const double force = rings.rows * q.dot(psi.array().cos().matrix());
  const auto wave    = [&](const int m) { return q.dot((m * psi).array().cos().matrix()); };
  const int rows = rings.rows, modes = rings.modes;
  double work = 0;
  for (const auto *side : {&rings.inner, &rings.outer})
    for (std::size_t m = 0; m < side->size(); ++m)
      for (int r = 0; r < rows; ++r)
        for (int s = 0; s < rows; ++s)
          work += (*side)[m](r * modes, s * modes) * std::pow(wave(int(m)), 2);
  for (int m = 0; m < rings.chock_harmonics; ++m)
    for (int n = 0; n < rings.chock_harmonics; ++n)
      for (int r = 0; r < rows; ++r)
        for (int s = 0; s < rows; ++s)
          work += rings.chock_cosine((m * rows + r) * modes, (n * rows + s) * modes) * wave(m) * wave(n);
  return work / (force * force);
}

namespace {
struct Computed {
  bearing::RingFlexibility rings;
  double truncated = 0, chock_difference = 0;
  int n_section_unknowns = 0, n_chock_unknowns = 0;
};

// The block in the place of the round housing.  Only what it is more flexible by comes from its own, coarse mesh:
// the round housing on the same mesh lines is taken off again, and with it what the coarse lines get wrong at the
// rollers.
void put_chock(Computed &c, const RingSections &sections, const RingMeshes &meshes, const RingOptions &options,
               const ChockFlexibility &of_block)
{
  const int n = std::min<int>(options.chock_harmonics, int(c.rings.outer.size()));
  const LoadedSection lines(sections.cup, meshes.chock_section, sections.material, options.modes);
  const Eigen::Index size = c.rings.rows * c.rings.modes;
  // The orders are side by side, so that fewer of them are a corner of all.
  Eigen::MatrixXd block_cosine = of_block.cosine.topLeftCorner(n * size, n * size),
                  block_sine   = of_block.sine.topLeftCorner((n - 1) * size, (n - 1) * size);
  for (int m = 0; m < n; ++m) {
    auto cosine                 = block_cosine.block(m * size, m * size, size, size);
    const Eigen::MatrixXd round = lines.flexibility(m);
    if (m == n - 1)
      c.chock_difference = (cosine - round).norm() / round.norm();
    const Eigen::MatrixXd rest = c.rings.outer[std::size_t(m)] - round;
    cosine += rest;
    if (m > 0)
      block_sine.block((m - 1) * size, (m - 1) * size, size, size) += rest;
    c.rings.outer[std::size_t(m)].setZero();
  }
  c.rings.chock_harmonics = n;
  c.rings.chock_cosine    = block_cosine;
  c.rings.chock_sine      = block_sine;
  c.n_chock_unknowns      = of_block.n_unknowns;
}

Computed compute(const RingSections &sections, const RingMeshes &meshes, const RingOptions &options,
                 const int threads, const std::function<void(double)> &done)
{
  Computed c;
  c.rings.rows     = int(sections.cone.raceways.size());
  c.rings.modes    = options.modes;
  const bool block = !meshes.chock.path.empty();
  double cone_left = 0, cup_left = 0;
  int cone_unknowns = 0, cup_unknowns = 0;
  ChockFlexibility chock;
  std::atomic<double> part{0};
  const auto advance   = [&](const double by) { done(part = part + by); };
  const auto series_of = [&](const RingSection &ring, const MeshFile &whole, const MeshFile &raceway,
                             std::vector<Eigen::MatrixXd> &out, int &n_unknowns) {
    const Ring body(ring, whole, raceway, sections.material, options.modes);
    n_unknowns = body.n_unknowns();
    // How many harmonics it will be is not known: some 60.
    return series(body, options, out, [&](const int m) { advance(m < 60 ? 0.35 / 60 : 0); });
  };
  share_tasks(3, threads, [&](const long i) {
    if (i == 0 && block)
      chock = chock_flexibility(sections.cup, meshes.chock, meshes.chock_halved, sections.material,
                                options.chock_harmonics, options.modes, threads);
    if (i == 1)
      cone_left = series_of(sections.cone, meshes.cone, meshes.cone_raceway, c.rings.inner, cone_unknowns);
    if (i == 2)
      cup_left = series_of(sections.cup, meshes.cup, meshes.cup_raceway, c.rings.outer, cup_unknowns);
  });
  c.truncated          = std::max(cone_left, cup_left);
  c.n_section_unknowns = cone_unknowns + cup_unknowns;
  if (block)
    put_chock(c, sections, meshes, options, chock);
  done(1);
  return c;
}

// Most negative eigenvalue of any harmonic against the largest of all.
double most_negative(const bearing::RingFlexibility &rings)
{
  double low = 0, high = 0;
  const auto look = [&](const Eigen::MatrixXd &A) {
    if (A.size() == 0)
      return;
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
    low  = std::min(low, values[0]);
    high = std::max(high, values[values.size() - 1]);
  };
  for (const auto *side : {&rings.inner, &rings.outer})
    for (const auto &A : *side)
      look(A);
  look(rings.chock_cosine);
  look(rings.chock_sine);
  return low / high;
}
std::vector<std::string> notes(const RingSections &sections, const RingResult &r)
{
  std::vector<std::string> out;
  const auto add = [&](const auto &...parts) {
    std::ostringstream text;
    text.precision(2);
    (text << ... << parts);
    out.push_back(text.str());
  };
  add("The cone and a solid neck of the bearing's width are one body; the inner ring's motion is the mean motion "
      "of "
      "both.");
  if (sections.housing.kind == ChockForm::rigid)
    add("The cup is held on its outside diameter.");
  else
    add("The cup and what surrounds it are one body of one steel: a fit without clearance.");
  if (sections.housing.kind == ChockForm::block)
    add("The block is held on the face towards the load and free on all others; harmonics from ",
        r.flexibility.chock_harmonics, " on are those of a round housing, from which the block differs by ",
        100 * r.chock_difference, " % in its last harmonic.");
  if (r.error_estimate > 0)
    add("A coarser mesh changes the flexibility under a radial load by ", 100 * r.error_estimate, " %.");
  return out;
}
}  // namespace

RingResult ring_flexibility(const RingSections &sections, const RingMeshes &meshes, const RingMeshes *coarse,
                            const RingOptions &options, const Progress &progress, const int threads)
{
  const double share = coarse ? 0.7 : 1;  // of the time
  const Computed c =
      compute(sections, meshes, options, threads, [&](const double f) { progress.at("rings", share * f); });
  RingResult out;
  out.flexibility        = c.rings;
  out.truncated          = c.truncated;
  out.chock_difference   = c.chock_difference;
  out.n_section_unknowns = c.n_section_unknowns;
  out.n_chock_unknowns   = c.n_chock_unknowns;
  out.indefinite         = most_negative(c.rings);
  if (coarse) {
    RingOptions same   = options;
    same.last_harmonic = int(std::max(c.rings.inner.size(), c.rings.outer.size())) - 1;
    out.companion      = compute(sections, *coarse, same, threads, [&](const double f) {
                      progress.at("rings", share + (1 - share) * f);
                    }).rings;
    const int Z        = 36;  // any number of rollers tells two meshes apart
    const double fine  = stribeck_flexibility(c.rings, Z);
    out.error_estimate = std::abs(stribeck_flexibility(out.companion, Z) / fine - 1);
  }
  out.notes = notes(sections, out);
  return out;
}
}  // namespace mill::fem
