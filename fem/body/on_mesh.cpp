#include "fem/body/on_mesh.h"
#include "core/base/errors.h"
#include <atomic>
#include <fstream>
#include <map>

namespace mill::fem {
namespace {
std::atomic<int> threads_wanted{0};  // 0: deal.II's own choice
std::atomic<bool> is_open{false};
}  // namespace

std::string library_version()
{
  return MILLSTAND_DEALII_VERSION;
}

const OnMesh &on_mesh()
{
  static const OnMesh &opened = []() -> const OnMesh & {
    const OnMesh &bodies = found_on_mesh();
    if (threads_wanted > 0)
      bodies.use_threads(threads_wanted);
    is_open = true;
    return bodies;
  }();
  return opened;
}

void set_assembly_threads(const int n)
{
  threads_wanted = n;
  if (is_open)
    on_mesh().use_threads(n);
}

void require_readable(const MeshFile &mesh)
{
  if (!std::ifstream(mesh.path, std::ios::binary))
    throw InputError({mesh.path, 0, 0}, "the mesh cannot be read");
}

Surface surface_of(const Eigen::MatrixXd &nodes, const std::vector<int> &of_group, const Eigen::MatrixXi &faces)
{
  Surface out;
  out.node = of_group;
  out.points.resize(Eigen::Index(of_group.size()), nodes.cols());
  std::map<int, int> place;
  for (std::size_t i = 0; i < of_group.size(); ++i) {
    out.points.row(Eigen::Index(i)) = nodes.row(of_group[i]);
    place[of_group[i]]              = int(i);
  }
  out.faces = faces.unaryExpr([&](const int node) { return place.at(node); });
  return out;
}
}  // namespace mill::fem
