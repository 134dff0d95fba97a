#include "modal_system.h"
#include <algorithm>
#include <cmath>

namespace mill::fmu {
namespace {
// M^-1/2 K M^-1/2
Matrix scaled_stiffness(const ModelData &model, const Tuning &tuning)
{
  const std::size_t m = tuning.mass.size();
  Matrix K(m, m);
  for (std::size_t s = 0; s < model.springs.size(); ++s) {
    const int from = model.springs[s].from, to = model.springs[s].to;
    const double k = tuning.stiffness[s];
    for (const int end : {from, to})
      if (end != fixed_end)
        K(std::size_t(end), std::size_t(end)) += k;
    if (from != fixed_end && to != fixed_end) {
      K(std::size_t(from), std::size_t(to)) -= k;
      K(std::size_t(to), std::size_t(from)) -= k;
    }
  }
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < m; ++j)
      K(i, j) /= std::sqrt(tuning.mass[i]) * std::sqrt(tuning.mass[j]);
  return K;
}

ModalSystem of_chain(const ModelData &model, const Tuning &tuning)
{
  const std::size_t m      = tuning.mass.size();
  const SymmetricEigen all = symmetric_eigen(scaled_stiffness(model, tuning));
  ModalSystem system;
  system.point           = Matrix(m, m);
  system.from_points     = Matrix(m, m);
  const SpringData &cell = model.springs[std::size_t(model.load_cell_spring)];
  const double K_cell    = tuning.stiffness[std::size_t(model.load_cell_spring)];
  for (std::size_t k = 0; k < m; ++k) {
    double bite = 0;
    for (std::size_t i = 0; i < m; ++i) {
      const double root        = std::sqrt(tuning.mass[i]);
      system.point(i, k)       = all.vector(i, k) / root;
      system.from_points(k, i) = all.vector(i, k) * root;
      bite += model.bite_row[i] * system.point(i, k);
    }
    const auto end = [&](const int mass) { return mass == fixed_end ? 0 : system.point(std::size_t(mass), k); };
    system.rad.push_back(std::sqrt(std::max(0.0, all.value[k])));
    system.bite.push_back(bite);
    system.load_cell.push_back(-K_cell * (end(cell.from) - end(cell.to)));
  }
  for (const SpringData &spring : model.springs) {
    if (!(spring.damper > 0))
      continue;
    std::vector<double> row(m);
    const auto end = [&](const int mass, const std::size_t k) {
      return mass == fixed_end ? 0 : system.point(std::size_t(mass), k);
    };
    for (std::size_t k = 0; k < m; ++k)
      row[k] = std::sqrt(spring.damper) * (end(spring.from, k) - end(spring.to, k));
    system.dampers.push_back(row);
  }
  return system;
}

ModalSystem of_modes(const ModelData &model)
{
  const std::size_t n = model.frequency.size(), m = model.points.size();
  ModalSystem system;
  system.bite        = model.bite_mode;
  system.load_cell   = model.load_cell_mode;
  system.point       = Matrix(m, n);
  system.point.entry = model.shape;
  for (const double f : model.frequency)
    system.rad.push_back(2 * 3.14159265358979323846 * f);
  for (std::size_t r = 0; r + n <= model.damper_rows.size(); r += n)
    system.dampers.emplace_back(model.damper_rows.begin() + std::ptrdiff_t(r),
                                model.damper_rows.begin() + std::ptrdiff_t(r + n));
  return system;
}
}  // namespace

ModalSystem modal_system(const ModelData &model, const Tuning &tuning)
{
  ModalSystem system     = model.kind == StandKind::chain ? of_chain(model, tuning) : of_modes(model);
  system.damping         = tuning.modal_damping;
  system.gap_damper      = tuning.gap_damper;
  system.load_cell_share = model.load_cell_share;
  if (model.share_from_statics && is_held(system)) {  // load cell . K^-1 b
    system.load_cell_share = 0;
    for (std::size_t k = 0; k < system.rad.size(); ++k)
      system.load_cell_share += system.load_cell[k] * system.bite[k] / (system.rad[k] * system.rad[k]);
  }
  return system;
}

bool same_tuning(const Tuning &a, const Tuning &b)
{
  return a.mass == b.mass && a.stiffness == b.stiffness && a.modal_damping == b.modal_damping &&
         a.gap_damper == b.gap_damper;
}

Tuning start_of(const ModelData &model)
{
  Tuning tuning;
  tuning.mass = model.mass;
  for (const SpringData &spring : model.springs)
    tuning.stiffness.push_back(spring.start);
  tuning.modal_damping = model.modal_damping;
  tuning.gap_damper    = model.gap_damper;
  return tuning;
}

bool is_held(const ModalSystem &system)
{
  // Rounding makes a zero eigenvalue some eps of the largest one.
  return !system.rad.empty() && system.rad.front() > 1e-7 * system.rad.back();
}
}  // namespace mill::fmu
