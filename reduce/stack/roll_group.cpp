#include "reduce/stack/roll_group.h"
#include "core/base/errors.h"
#include "reduce/chain/beam_shapes.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace mill::reduce {
using Eigen::Index;
using Eigen::VectorXd;

namespace {
double diameter_at(const StackRoll &roll, const double z)
{
  for (const StackSection &section : roll.sections)
    if (z - roll.shift >= section.from && z - roll.shift <= section.to)
      return section.diameter;
  throw InputError(fmt::format("roll {}: its sections leave a gap at z = {:.0f} mm", roll.name, 1e3 * z));
}

BeamElement element_of(const StackRoll &roll, const double z, const double length)
{
  const double d            = diameter_at(roll, z + length / 2);
  const BeamSection section = round_section(d, roll.material);
  const double mass         = roll.material.density * M_PI * d * d / 4;
  return {length, section.bending, 12 * section.bending / (section.shear * length * length), mass,
          mass * d * d / 16};
}
}  // namespace

void UnknownRow::add(const Index i, const double f)
{
  unknown.push_back(i);
  factor.push_back(f);
}

double UnknownRow::dot(const VectorXd &u) const
{
  double sum = 0;
  for (std::size_t i = 0; i < unknown.size(); ++i)
    sum += factor[i] * u[unknown[i]];
  return sum;
}

void UnknownRow::add_to(Eigen::Ref<VectorXd> f, const double times) const
{
  for (std::size_t i = 0; i < unknown.size(); ++i)
    f[unknown[i]] += times * factor[i];
}

RollGroup::RollGroup(const Stack &s, const Stations &places, std::vector<std::size_t> rolls,
                     const bool both_planes)
    : stiffness({0}), stack(s), stations(places),
      axes(both_planes ? std::vector<std::size_t>{1, 0} : std::vector<std::size_t>{1})
{
  for (const std::size_t roll : rolls) {
    double from = INFINITY, to = -INFINITY;
    for (const StackSection &section : stack.rolls[roll].sections) {
      from = std::min(from, section.from);
      to   = std::max(to, section.to);
    }
    beams.push_back({roll,
                     stations.place(from + stack.rolls[roll].shift),
                     stations.place(to + stack.rolls[roll].shift),
                     {},
                     {}});
  }
  stiffness = BlockTridiagonal(number_unknowns());
  u = forces = VectorXd::Zero(stiffness.size());
  make_beams();
  make_contacts();
}

// Station by station, so that the matrix is a narrow band.
std::vector<Index> RollGroup::number_unknowns()
{
  std::vector<Index> first{0};
  Index n = 0;
  for (int s = 0; s < int(stations.z.size()); ++s) {
    for (Beam &beam : beams)
      if (s >= beam.first && s <= beam.last) {
        beam.unknown.push_back(n);
        n += Index(2 * axes.size());
      }
    if (n > first.back())
      first.push_back(n);
  }
  return first;
}

std::size_t RollGroup::local(const std::size_t roll) const
{
  for (std::size_t b = 0; b < beams.size(); ++b)
    if (beams[b].roll == roll)
      return b;
  throw std::logic_error("roll group: not one of its rolls");
}

bool RollGroup::holds(const std::size_t roll) const
{
  return std::any_of(beams.begin(), beams.end(), [&](const Beam &beam) { return beam.roll == roll; });
}

Index RollGroup::unknown_of(const Beam &beam, const int station, const std::size_t axis) const
{
  if (station < beam.first || station > beam.last)
    throw std::logic_error("roll group: a place beyond the end of roll " + stack.rolls[beam.roll].name);
  return beam.unknown[std::size_t(station - beam.first)] + (axis == axes.front() ? 0 : 2);
}

void RollGroup::make_beams()
{
  std::vector<Eigen::Triplet<double>> entries;
  for (Beam &beam : beams) {
    const StackRoll &roll = stack.rolls[beam.roll];
    for (int s = beam.first; s < beam.last; ++s) {
      beam.elements.push_back(element_of(roll, stations.z[std::size_t(s)], stations.length(s)));
      const Eigen::Matrix4d K = beam.elements.back().stiffness();
      for (const std::size_t axis : axes)
        for (int i = 0; i < 4; ++i)
          for (int j = 0; j < 4; ++j)
            entries.emplace_back(unknown_of(beam, s + i / 2, axis) + i % 2,
                                 unknown_of(beam, s + j / 2, axis) + j % 2, K(i, j));
    }
    for (const StackSupport &support : roll.supports)
      for (const std::size_t axis : axes) {
        const Index i = unknown_of(beam, stations.place(support.z + roll.shift), axis);
        entries.emplace_back(i, i, support.stiffness[axis]);
        forces[i] += support.stiffness[axis] * support.motion[axis];
      }
    for (const StackLoad &load : roll.loads)
      forces += force_at(load, beam.roll);
  }
  beams_alone.resize(size(), size());
  beams_alone.setFromTriplets(entries.begin(), entries.end());
}

VectorXd RollGroup::force_at(const StackLoad &load, const std::size_t roll) const
{
  VectorXd f       = VectorXd::Zero(size());
  const Beam &beam = beams[local(roll)];
  for (const std::size_t axis : axes)
    f[unknown_of(beam, stations.place(load.z + stack.rolls[roll].shift), axis)] += load.force[axis];
  return f;
}

void RollGroup::make_contacts()
{
  for (std::size_t c = 0; c < stack.contacts.size(); ++c) {
    const StackContact &contact = stack.contacts[c];
    const StackRoll &a = stack.rolls[contact.a], &b = stack.rolls[contact.b];
    laws.push_back(line_law(a.diameter / 2, a.material, b.diameter / 2, b.material, contact.ring_stiffness));
    if (!holds(contact.a))
      continue;
    const auto direction = direction_of(stack, contact);
    const Beam *pair[2]  = {&beams[local(contact.a)], &beams[local(contact.b)]};
    for (const auto &[from, to] : contact_zones(stack, contact))
      for (int s = stations.place(from); s < stations.place(to); ++s) {
        ContactElement e;
        e.contact = c;
        e.row.resize(Index(8 * axes.size()), UnitGauss::n);
        Index k = 0;
        for (int side = 0; side < 2; ++side)
          for (const std::size_t axis : axes) {
            const BeamElement &element = pair[side]->elements.at(std::size_t(s - pair[side]->first));
            for (int g = 0; g < UnitGauss::n; ++g)
              e.row.block<4, 1>(k, g) =
                  (side == 0 ? 1 : -1) * direction[axis] * element.shape(UnitGauss::place[g]);
            for (int i = 0; i < 4; ++i)
              e.unknown.push_back(unknown_of(*pair[side], s + i / 2, axis) + i % 2);
            k += 4;
          }
        for (int g = 0; g < UnitGauss::n; ++g) {
          e.z[g]      = stations.z[std::size_t(s)] + stations.length(s) * UnitGauss::place[g];
          e.weight[g] = stations.length(s) * UnitGauss::weight[g];
          e.gap[g]    = -(radius_departure(a, e.z[g]) + radius_departure(b, e.z[g]));
        }
        contacts.push_back(std::move(e));
      }
  }
}

UnknownRow RollGroup::integral(const std::size_t roll, const double z1, const double z2, const double factor) const
{
  UnknownRow row;
  const Beam &beam = beams[local(roll)];
  for (int s = beam.first; s < beam.last; ++s) {
    const double start = stations.z[std::size_t(s)], L = stations.length(s);
    const double from = std::max(z1, start), to = std::min(z2, start + L);
    if (to - from < 1e-12)
      continue;
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (int g = 0; g < UnitGauss::n; ++g)
      sum +=
          factor * UnitGauss::weight[g] * (to - from) *
          beam.elements[std::size_t(s - beam.first)].shape((from + (to - from) * UnitGauss::place[g] - start) / L);
    for (int i = 0; i < 4; ++i)
      row.add(unknown_of(beam, s + i / 2, 1) + i % 2, sum[i]);
  }
  return row;
}

VectorXd RollGroup::deflection(const std::size_t roll, const std::size_t axis) const
{
  const Beam &beam = beams[local(roll)];
  VectorXd d       = VectorXd::Zero(Index(beam.unknown.size()));
  if (axis == 1 || axes.size() == 2)
    for (int s = beam.first; s <= beam.last; ++s)
      d[s - beam.first] = u[unknown_of(beam, s, axis)];
  return d;
}

VectorXd RollGroup::force_of_radius(const std::size_t roll, const std::function<double(double)> &departure) const
{
  VectorXd f = VectorXd::Zero(size());
  for (const ContactElement &e : contacts)
    if (stack.contacts[e.contact].a == roll || stack.contacts[e.contact].b == roll) {
      Eigen::Array<double, UnitGauss::n, 1> r;
      for (int g = 0; g < UnitGauss::n; ++g)
        r[g] = departure(e.z[g]);
      const VectorXd pushed = e.row * (e.weight * e.tangent * r).matrix();
      for (std::size_t i = 0; i < e.unknown.size(); ++i)
        f[e.unknown[i]] -= pushed[Index(i)];
    }
  return f;
}

VectorXd RollGroup::places(const std::size_t roll) const
{
  const Beam &beam = beams[local(roll)];
  return Eigen::Map<const VectorXd>(stations.z.data() + beam.first, beam.last - beam.first + 1);
}

void RollGroup::update()
{
  for (ContactElement &e : contacts) {
    Eigen::VectorXd local(Index(e.unknown.size()));
    for (std::size_t i = 0; i < e.unknown.size(); ++i)
      local[Index(i)] = u[e.unknown[i]];
    e.approach = (e.row.transpose() * local).array() - e.gap;
    for (int g = 0; g < UnitGauss::n; ++g) {
      const LineLoad line = line_load(laws[e.contact], e.approach[g]);
      e.load[g]           = line.load;
      e.tangent[g]        = line.tangent;
    }
  }
}

VectorXd RollGroup::out_of_balance() const
{
  VectorXd r = forces - beams_alone * u;
  for (const ContactElement &e : contacts) {
    const VectorXd f = e.row * (e.weight * e.load).matrix();
    for (std::size_t i = 0; i < e.unknown.size(); ++i)
      r[e.unknown[i]] -= f[Index(i)];
  }
  return r;
}

void RollGroup::assemble()
{
  stiffness.set_zero();
  for (Index k = 0; k < beams_alone.outerSize(); ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(beams_alone, k); entry; ++entry)
      if (entry.row() >= entry.col())
        stiffness.add(entry.row(), entry.col(), entry.value());
  for (const ContactElement &e : contacts) {
    const Eigen::MatrixXd K = e.row * (e.weight * e.tangent).matrix().asDiagonal() * e.row.transpose();
    for (std::size_t i = 0; i < e.unknown.size(); ++i)
      for (std::size_t j = 0; j < e.unknown.size(); ++j)
        if (e.unknown[i] >= e.unknown[j])
          stiffness.add(e.unknown[i], e.unknown[j], K(Index(i), Index(j)));
  }
}

bool RollGroup::factorise(const double least_tangent)
{
  for (ContactElement &e : contacts)
    e.tangent = e.tangent.max(least_tangent);
  assemble();
  return stiffness.factorise();
}

bool RollGroup::factorise_touching(const double line_load)
{
  for (ContactElement &e : contacts)
    e.tangent = 1 / compliance_of(laws[e.contact], line_load);
  assemble();
  return stiffness.factorise();
}

double RollGroup::largest_force(const VectorXd &residual) const
{
  double most = 0;
  for (Index i = 0; i < residual.size(); i += 2)
    most = std::max(most, std::abs(residual[i]));
  return most;
}

double RollGroup::rounding() const
{
  double most = 0;
  for (Index i = 0; i < u.size(); i += 2)
    most = std::max(most, beams_alone.coeff(i, i) * std::abs(u[i]));
  return 8 * std::numeric_limits<double>::epsilon() * most;
}

Eigen::SparseMatrix<double> RollGroup::mass_matrix() const
{
  std::vector<Eigen::Triplet<double>> entries;
  for (const Beam &beam : beams) {
    for (int s = beam.first; s < beam.last; ++s) {
      const Eigen::Matrix4d M = beam.elements[std::size_t(s - beam.first)].mass_matrix();
      for (const std::size_t axis : axes)
        for (int i = 0; i < 4; ++i)
          for (int j = 0; j < 4; ++j)
            entries.emplace_back(unknown_of(beam, s + i / 2, axis) + i % 2,
                                 unknown_of(beam, s + j / 2, axis) + j % 2, M(i, j));
    }
    const StackRoll &roll = stack.rolls[beam.roll];
    for (const StackLump &lump : roll.lumps)
      for (const std::size_t axis : axes) {
        const Index i = unknown_of(beam, stations.place(lump.z + roll.shift), axis);
        entries.emplace_back(i, i, lump.mass);
      }
  }
  Eigen::SparseMatrix<double> M(size(), size());
  M.setFromTriplets(entries.begin(), entries.end());
  return M;
}

UnknownRow RollGroup::deflection_at(const std::size_t roll, const double z, const std::size_t axis) const
{
  UnknownRow row;
  if (std::find(axes.begin(), axes.end(), axis) == axes.end())
    return row;
  const Beam &beam = beams[local(roll)];
  int s            = beam.first;
  while (s + 1 < beam.last && stations.z[std::size_t(s) + 1] < z)
    ++s;
  const double t              = (z - stations.z[std::size_t(s)]) / stations.length(s);
  const Eigen::Vector4d shape = beam.elements[std::size_t(s - beam.first)].shape(std::clamp(t, 0., 1.));
  for (int i = 0; i < 4; ++i)
    row.add(unknown_of(beam, s + i / 2, axis) + i % 2, shape[i]);
  return row;
}

RollGroup::FreeBeam RollGroup::free_beam(const std::size_t roll) const
{
  const Beam &beam = beams[local(roll)];
  const Index n    = 2 * Index(beam.unknown.size());
  FreeBeam free{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  for (std::size_t e = 0; e < beam.elements.size(); ++e) {
    free.stiffness.block<4, 4>(2 * Index(e), 2 * Index(e)) += beam.elements[e].stiffness();
    free.mass.block<4, 4>(2 * Index(e), 2 * Index(e)) += beam.elements[e].mass_matrix();
  }
  for (const StackLump &lump : stack.rolls[roll].lumps) {
    const Index i = 2 * (stations.place(lump.z + stack.rolls[roll].shift) - beam.first);
    free.mass(i, i) += lump.mass;
  }
  return free;
}

std::vector<Index> RollGroup::unknowns(const std::size_t roll, const std::size_t axis) const
{
  const Beam &beam = beams[local(roll)];
  std::vector<Index> all;
  for (int s = beam.first; s <= beam.last; ++s)
    for (int i = 0; i < 2; ++i)
      all.push_back(unknown_of(beam, s, axis) + i);
  return all;
}
}  // namespace mill::reduce
