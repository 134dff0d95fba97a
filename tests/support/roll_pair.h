#pragma once
#include "fem/roll/contact_study.h"
#include "meshes/roll/contact_mesh_size.h"
#include <memory>
#include <string>

/// Meshed and condensed bodies for tests; files go to the test's temporary folder.
struct MeshedBody {
  mill::MeshFile mesh;
  std::shared_ptr<mill::fem::ElasticBody> body;
  mill::fem::CondensedRoll roll;
};

MeshedBody meshed_slab(const std::string &name, double diameter, double smallest_half_width,
                       double largest_half_width, int per_half_width, double thickness,
                       const mill::Material &steel, int degree = 2);
MeshedBody meshed_roll(const std::string &name, const mill::RollGeometry &geometry,
                       const mill::meshes::RollMeshSize &size, const mill::Material &steel,
                       const mill::fem::CondenseOptions &options = {});

/// Two slabs squeezed between mirrored contacts, per metre of length.
mill::fem::ContactPair slab_pair(const MeshedBody &first, const MeshedBody &second);
