#pragma once
#include "core/model/mesh_file.h"
#include "core/model/surface.h"
#include "core/numerics/sparse.h"
#include <Eigen/Core>
#include <functional>
#include <map>
#include <string>
#include <vector>

// All that the finite elements ask of deal.II.  Behind it stands fem/dealii/, which the program opens with the
// first body (core/process/own_library.h); so nothing of deal.II is in these types, and no error of ours is thrown
// on its side.  Matrices are what they are in elastic_body.h and section_body.h, where everybody else reads them.
namespace mill::fem {
std::string library_version();  ///< of deal.II, "9.4.1"; known without opening it

/// A quadrature point of a cell of n nodes.
struct SolidPoint {
  Eigen::Matrix<double, 3, Eigen::Dynamic> gradient;  ///< (3, n) 1/m, of the nodes' shape functions
  Eigen::VectorXd value;                              ///< (n) -, of the nodes' shape functions
  double weight;                                      ///< m3
};
using VisitSolid = std::function<void(const std::vector<int> &nodes, const std::vector<SolidPoint> &points)>;

struct UnitStiffness {
  SymmetricSparse matrix;  ///< (3N, 3N) upper triangle, of modulus one on the mesh as it is on disk
  double volume = 0;       ///< m3
};

/// A body of hexahedra, read.  Its functions compute again with each call.
struct SolidOnMesh {
  Eigen::Matrix<double, Eigen::Dynamic, 3> nodes;  ///< (N, 3) m
  std::map<std::string, std::vector<int>> groups;  ///< nodes of the boundary groups, ascending
  std::function<UnitStiffness()> unit_stiffness;
  std::function<SymmetricSparse()> mass;  ///< (N, N) kg
  /// (f, m) nodes of the faces of a group, outward, first parameter fastest
  std::function<Eigen::MatrixXi(const std::string &group)> faces;
  std::function<Eigen::VectorXd(const std::string &group, const std::function<double(double z)> &weight)>
      face_integral;
  std::function<Eigen::VectorXd(const std::function<double(const Eigen::Vector3d &)> &weight)> volume_load;
  std::function<void(const VisitSolid &visit)> each_cell;
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd &displacement)> nodal_stress;
  /// Text of a VTU file.
  std::function<std::string(const Eigen::VectorXd &displacement, const Eigen::VectorXd &pressure)> vtu;
};

enum class Section {
  plane_strain,  ///< mesh coordinates x, y; everything per metre of thickness
  axisymmetric   ///< mesh coordinates r, z; everything over the whole circumference
};

/// Boundary group of a section that lies on a circle: the mesh gives its corners, the circle the rest.
struct Circle {
  std::string group;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< m
  double radius          = 0;                        ///< m, corners of the group are moved onto it
};

/// A quadrature point of a cell of n nodes.
struct CellPoint {
  Eigen::Matrix<double, Eigen::Dynamic, 2> gradient;  ///< (n, 2) 1/m, of the nodes' shape functions
  double weight;  ///< m2; m3 on the whole circumference of a body of revolution
};
using VisitSection = std::function<void(const std::vector<int> &nodes, const std::vector<CellPoint> &points)>;

/// A plane or meridian section of quadrilaterals, read.  Its functions compute again with each call.
struct SectionOnMesh {
  bool readable = false;                           ///< the file has quadrilaterals in a plane, and nothing else
  Eigen::Matrix<double, Eigen::Dynamic, 2> nodes;  ///< (N, 2) m
  std::map<std::string, std::vector<int>> groups;  ///< nodes of the boundary groups, ascending
  std::function<SymmetricSparse()> stiffness;      ///< (2N, 2N)
  /// (3N, 3N) coefficients of 1, m, m^2 in the stiffness of harmonic m, for the integral of cos^2 = 1; one pattern
  std::function<std::vector<SymmetricSparse>()> harmonics;
  /// (f, m) nodes of the faces of a group, the body on their left
  std::function<Eigen::MatrixXi(const std::string &group)> faces;
  std::function<void(const VisitSection &visit)> each_cell;
  std::function<double()> measure;  ///< m2 or m3
};

struct OnMesh {
  void (*use_threads)(int n);  ///< for assembly
  SolidOnMesh (*solid)(const MeshFile &mesh, const Material &material, int degree);
  SectionOnMesh (*section)(const MeshFile &mesh, const Material &material, int degree, Section section,
                           const std::vector<Circle> &circles);
};

/// Opened at the first call.
/// @throws SystemError  the library is not in the folder of the program
const OnMesh &on_mesh();
/// The same, as a program finds it: linked in (fem/dealii) or opened (opened_on_mesh.cpp).
const OnMesh &found_on_mesh();

/// Threads that assembly may use; opens nothing.
void set_assembly_threads(int n);

/// @throws InputError  the file cannot be opened
void require_readable(const MeshFile &mesh);

/// A boundary group as a surface of its own.
/// @param nodes     (N, d) m, of the body
/// @param of_group  its nodes, ascending
/// @param faces     (f, m) nodes of the body
Surface surface_of(const Eigen::MatrixXd &nodes, const std::vector<int> &of_group, const Eigen::MatrixXi &faces);
}  // namespace mill::fem
