#include "fem/body/section_body.h"
#include "core/base/errors.h"
#include <stdexcept>

namespace mill::fem {
struct SectionBody::Implementation {
  int degree;
  Section section;
  SectionOnMesh body;
  SymmetricSparse stiffness;              // empty until asked for, as the next
  std::vector<SymmetricSparse> harmonic;  // coefficients of 1, m, m^2
};

SectionBody::SectionBody(const MeshFile &mesh, const Material &material, const int degree, const Section section,
                         const std::vector<Circle> &circles)
{
  require_readable(mesh);
  self = std::make_unique<Implementation>(
      Implementation{degree, section, on_mesh().section(mesh, material, degree, section, circles), {}, {}});
  if (!self->body.readable)
    throw InputError({mesh.path, 0, 0}, "the mesh is not one of quadrilaterals in a plane");
}
SectionBody::~SectionBody()                       = default;
SectionBody::SectionBody(SectionBody &&) noexcept = default;

const SymmetricSparse &SectionBody::stiffness() const
{
  if (self->stiffness.rows() == 0)
    self->stiffness = self->body.stiffness();
  return self->stiffness;
}

SymmetricSparse SectionBody::harmonic_stiffness(const int m) const
{
  if (self->section != Section::axisymmetric)
    throw std::logic_error("harmonics belong to a body of revolution");
  if (self->harmonic.empty())
    self->harmonic = self->body.harmonics();
  // The three share one pattern.  The measure carries 2 pi; the integral of cos^2 and of sin^2 is half of it.
  SymmetricSparse K    = self->harmonic[0];
  const auto values    = [](SymmetricSparse &A) { return Eigen::Map<Eigen::ArrayXd>(A.valuePtr(), A.nonZeros()); };
  const double squares = m == 0 ? 1 : 0.5;
  values(K) =
      squares * (values(self->harmonic[0]) + m * values(self->harmonic[1]) + m * m * values(self->harmonic[2]));
  return K;
}

const Eigen::Matrix<double, Eigen::Dynamic, 2> &SectionBody::nodes() const
{
  return self->body.nodes;
}
const std::vector<int> &SectionBody::group(const std::string &name) const
{
  return self->body.groups.at(name);
}
int SectionBody::degree() const
{
  return self->degree;
}
Section SectionBody::section() const
{
  return self->section;
}

Surface SectionBody::surface(const std::string &group) const
{
  Surface out      = surface_of(nodes(), self->body.groups.at(group), self->body.faces(group));
  out.axisymmetric = self->section == Section::axisymmetric;
  return out;
}

void SectionBody::each_cell(const VisitSection &visit) const
{
  self->body.each_cell(visit);
}

double SectionBody::measure() const
{
  return self->body.measure();
}
}  // namespace mill::fem
