#include "app/stages/stand/model_files.h"
#include "core/base/files.h"
#include "core/model/case.h"
#include "core/model/dynamics_settings.h"
#include "core/records/detailed_model.h"
#include "core/records/line_vtu.h"
#include "core/records/mat_file.h"
#include "core/records/matrix_market.h"
#include "core/records/stand_place.h"
#include "dynamics/response/modal_model.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr Eigen::Index many_unknowns = 100;

bool below_limit(const reduce::StandWithModes &s, const Eigen::Index mode, const DynamicsSettings &dynamics)
{
  return s.modes.frequency[mode] <= dynamics.frequency_limit;
}

// Height of an axis or of a mass above the pass line.  m
double height_of(const FourHigh &stand, const StandPlace &place)
{
  const double work   = stand.work_roll.barrel_diameter / 2,
               backup = 2 * work + stand.backup_roll.barrel_diameter / 2;
  const double top    = backup + stand.backup_roll.barrel_diameter;
  const double side   = place.lower || (place.housing && place.seat) ? -1 : 1;
  if (place.work)
    return side * work;
  if (place.backup)
    return side * backup;
  return side * (place.cylinder ? 0.5 * (backup + top) : top);
}

// Half the distance of what a point represents: a chock on its neck, else the middle.  m
double axial_station(const FourHigh &stand, const StandPlace &place)
{
  if (!(place.chock || place.seat) || place.housing)
    return 0;
  return 0.5 * (place.work ? stand.work_roll : stand.backup_roll).bearing_span;
}

// Points of the drawing with the row of the model that moves each.
struct Drawing {
  LineField field;
  std::vector<Eigen::RowVectorXd> rows;
  void add(const double y, const double z, const Eigen::RowVectorXd &row)
  {
    places.push_back({0, y, z});
    rows.push_back(row);
  }
  void finish()
  {
    field.position.resize(Eigen::Index(places.size()), 3);
    for (std::size_t i = 0; i < places.size(); ++i)
      field.position.row(Eigen::Index(i)) << places[i][0], places[i][1], places[i][2];
  }
  Eigen::Index count() const
  {
    return Eigen::Index(places.size());
  }

private:
  std::vector<std::array<double, 3>> places;
};

// The axes of the rolls from end to end, and the masses next to them on both sides.
Drawing drawing_of(const FourHigh &stand, const StandModel &model)
{
  Drawing d;
  for (const StandLine &line : model.lines) {
    const double y = height_of(stand, stand_place(line.name));
    std::vector<Eigen::Index> cell;
    for (Eigen::Index k = line.z.size() - 1; k > 0; --k) {
      cell.push_back(d.count());
      d.add(y, -line.z[k], line.rows.row(k));
    }
    for (Eigen::Index k = 0; k < line.z.size(); ++k) {
      cell.push_back(d.count());
      d.add(y, line.z[k], line.rows.row(k));
    }
    d.field.cells.push_back(cell);
  }
  for (const StandPoint &point : model.points) {
    const StandPlace place = stand_place(point.name);
    const bool on_a_line   = std::any_of(model.lines.begin(), model.lines.end(), [&](const StandLine &line) {
      return point.name.rfind(line.name, 0) == 0 && !place.chock;
    });
    if (on_a_line)
      continue;
    const double y = height_of(stand, place), z = axial_station(stand, place);
    for (const double side : {-1., 1.})
      if (side > 0 || z != 0) {
        d.field.cells.push_back({d.count()});
        d.add(y, side * z, point.row.transpose());
      }
  }
  d.finish();
  return d;
}

std::string mode_title(const reduce::StandWithModes &s, const Eigen::Index mode)
{
  const std::string name = std::size_t(mode) < s.names.size() ? ", " + s.names[std::size_t(mode)].name : "";
  return fmt::format("mode {:02}, {:.2f} Hz{}", mode + 1, s.modes.frequency[mode], name);
}

void write_shapes_of(RunContext &run, const FourHigh &stand, const reduce::StandWithModes &s)
{
  Drawing d = drawing_of(stand, s.model);
  for (Eigen::Index mode = 0; mode < s.modes.frequency.size() && below_limit(s, mode, stand.dynamics); ++mode) {
    LineField::Vectors shape;
    shape.name  = mode_title(s, mode);
    shape.unit  = "kg^-0.5";
    shape.value = Eigen::MatrixXd::Zero(d.count(), 3);
    for (Eigen::Index i = 0; i < d.count(); ++i)
      shape.value(i, 1) = d.rows[std::size_t(i)].dot(s.modes.shape.col(mode));
    d.field.vectors.push_back(std::move(shape));
  }
  run.out.write("fields/modes-" + s.model.name + ".vtu", line_vtu(d.field));
}

// First unknown of a part; the coordinates of its component follow in their order.
Eigen::Index first_unknown(const StandModel &model, const std::string &part)
{
  const auto i    = std::find(model.parts.begin(), model.parts.end(), part) - model.parts.begin();
  const auto &all = model.part_of;
  return std::find(all.begin(), all.end(), int(i)) - all.begin();
}

struct RollInPlace {
  std::string name;       // "upper work roll"
  const Component *body;  // with its surface
  double height;          // m, of its axis
};

std::array<RollInPlace, 4> rolls_in_place(const FourHigh &stand, const Component &work, const Component &backup)
{
  std::array<RollInPlace, 4> rolls{RollInPlace{"upper backup roll", &backup, 0},
                                   {"upper work roll", &work, 0},
                                   {"lower work roll", &work, 0},
                                   {"lower backup roll", &backup, 0}};
  for (RollInPlace &roll : rolls)
    roll.height = height_of(stand, stand_place(roll.name));
  return rolls;
}

// Points and faces of both halves about y = 0 of each roll; x and z >= 0 are drawn.
LineField drawn_surfaces(const std::array<RollInPlace, 4> &rolls)
{
  LineField field;
  field.filled   = true;
  field.digits   = 5;  // of a picture
  Eigen::Index n = 0;
  for (const RollInPlace &roll : rolls)
    n += 2 * roll.body->surface.position.rows();
  field.position.resize(n, 3);
  Eigen::Index first = 0;
  for (const RollInPlace &roll : rolls)
    for (const double side : {1., -1.}) {
      const ComponentSurface &s = roll.body->surface;
      for (Eigen::Index i = 0; i < s.position.rows(); ++i)
        field.position.row(first + i) << s.position(i, 0), roll.height + side * s.position(i, 1), s.position(i, 2);
      for (Eigen::Index f = 0; f < s.faces.rows(); ++f) {
        std::vector<Eigen::Index> cell;
        for (int c = 0; c < 4; ++c)
          cell.push_back(first + Eigen::Index(s.faces(f, c)));
        field.cells.push_back(cell);
      }
      first += s.position.rows();
    }
  return field;
}

// Displacement (n, 3) and stress (n, 9) of one half of a roll by the coordinates of its component.
std::pair<Eigen::MatrixXd, Eigen::MatrixXd> half_of(const ComponentSurface &surface, const Eigen::VectorXd &moved,
                                                    const double side)
{
  const Eigen::Index n    = surface.position.rows();
  const Eigen::VectorXd u = surface.displacement * moved, s = surface.stress * moved;
  Eigen::MatrixXd displacement(n, 3), stress(n, 9);
  for (Eigen::Index i = 0; i < n; ++i) {
    displacement.row(i) << side * u[3 * i], u[3 * i + 1], side * u[3 * i + 2];
    const auto six  = s.segment<6>(6 * i);
    const double xx = side * six[0], yy = side * six[1], zz = side * six[2], xy = six[3], xz = side * six[4],
                 yz = six[5];
    stress.row(i) << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  }
  return {displacement, stress};
}

LineField roll_surfaces(const FourHigh &stand, const reduce::StandWithModes &s, const Component &work,
                        const Component &backup)
{
  const auto rolls     = rolls_in_place(stand, work, backup);
  LineField field      = drawn_surfaces(rolls);
  const Eigen::Index n = field.position.rows();
  for (Eigen::Index mode = 0; mode < s.modes.frequency.size() && below_limit(s, mode, stand.dynamics); ++mode) {
    Eigen::MatrixXd displacement(n, 3), stress(n, 9);
    Eigen::Index first = 0;
    for (const RollInPlace &roll : rolls) {
      const Eigen::VectorXd moved =
          s.modes.shape.col(mode).segment(first_unknown(s.model, roll.name), roll.body->M.rows());
      for (const double side : {1., -1.}) {
        const auto half                                   = half_of(roll.body->surface, moved, side);
        displacement.middleRows(first, half.first.rows()) = half.first;
        stress.middleRows(first, half.second.rows())      = half.second;
        first += half.first.rows();
      }
    }
    field.vectors.push_back({mode_title(s, mode) + ", displacement", "kg^-0.5", std::move(displacement)});
    field.vectors.push_back({mode_title(s, mode) + ", stress", "Pa/(kg^0.5 m)", std::move(stress)});
  }
  return field;
}

std::vector<std::string> names_of(const StandModel &model)
{
  std::vector<std::string> names;
  for (std::size_t i = 0; i < model.unknowns.size(); ++i) {
    const StandUnknown &u = model.unknowns[i];
    names.push_back(model.parts[std::size_t(model.part_of[i])] + ", " + u.what +
                    (std::isnan(u.position) ? "" : fmt::format(" at {:.6g} m", u.position)) + ", y [" + u.unit +
                    "]");
  }
  return names;
}

std::string mat_of(const reduce::StandWithModes &s, const Eigen::MatrixXd &M, const Eigen::MatrixXd &K,
                   const Eigen::MatrixXd &C)
{
  std::vector<std::string> readings, modes;
  for (const StandPoint &point : s.model.points)
    readings.push_back(point.name + ", y [m]");
  readings.emplace_back("load cell, change of force [N]");
  for (const reduce::ModeName &mode : s.names)
    modes.push_back(mode.name);
  std::vector<MatVariable> variables{{"M", M, {}},
                                     {"K", K, {}},
                                     {"C", C, {}},
                                     {"b", s.model.b, {}},
                                     {"readings", readings_of(s.model), {}},
                                     {"frequency", s.modes.frequency, {}},
                                     {"shape", s.modes.shape, {}},
                                     {"unknown_names", {}, names_of(s.model)},
                                     {"reading_names", {}, std::move(readings)}};
  if (!modes.empty())
    variables.push_back({"mode_names", {}, std::move(modes)});
  return mat_file(variables);
}

}  // namespace

ModelFiles model_case_files(const reduce::StandWithModes &s, const double frequency_limit, const double gap_damper)
{
  ModelFiles files = named_files(s.model, "models");
  if (gap_damper > 0)
    files.gap_damper = gap_damper;
  files.frequency_limit = frequency_limit;
  for (Eigen::Index i = 0; i < s.modes.frequency.size() && s.modes.frequency[i] <= frequency_limit; ++i)
    files.modes.push_back({double(i + 1), s.modes.frequency[i]});
  if (files.modes.size() == 1)
    files.modes.clear();  // one pair does not make a table
  return files;
}

void write_model_matrices(RunContext &run, const DynamicsSettings &dynamics, const reduce::StandWithModes &s,
                          const double gap_damper)
{
  const ModelFiles files  = model_case_files(s, dynamics.frequency_limit, gap_damper);
  const std::string &name = s.model.name;
  for (const auto &[path, text] : texts_of(s.model, files))
    run.out.write(path, text);
  if (s.model.M.rows() <= many_unknowns || dynamics.model_files == ModelFileSet::all) {
    const auto kept =
        std::upper_bound(s.modes.frequency.begin(), s.modes.frequency.end(), 2 * dynamics.frequency_limit) -
        s.modes.frequency.begin();
    const bool all          = s.model.name == word_of(StandModelKind::six_mass);
    const Eigen::Index n    = all ? s.modes.frequency.size() : kept;
    const Eigen::MatrixXd C = dynamics::damping_matrix(
        s.model, s.modes.frequency.head(n), s.modes.shape.leftCols(n), dynamics.modal_damping, gap_damper);
    run.out.write("models/" + name + "-damping.mtx",
                  matrix_market_text(C, "damping matrix of model " + name + ", whole stand, N s/m"));
    run.out.write("models/" + name + ".mat",
                  mat_of(s, symmetric_part(s.model.M), symmetric_part(stiffness_of(s.model)), C));
  }
  if (name != word_of(StandModelKind::six_mass))
    run.out.write("lumped_model-" + name + ".toml", detailed_model_toml(files, run.the_case, run.out.path()));
}

void write_model_files(RunContext &run, const FourHigh &stand, const reduce::StandWithModes &s,
                       const LumpedModel &chain)
{
  const bool none = stand.dynamics.force_meaning == ForceMeaning::measured || std::isnan(chain.C.value);
  write_model_matrices(run, stand.dynamics, s, none ? 0 : chain.C.value);
  if (!s.model.lines.empty())
    write_shapes_of(run, stand, s);
}

void write_roll_shapes(RunContext &run, const FourHigh &stand, const reduce::StandWithModes &s,
                       const Component &work_roll, const Component &backup_roll)
{
  run.out.write("fields/modes-" + s.model.name + "-rolls.vtu",
                line_vtu(roll_surfaces(stand, s, work_roll, backup_roll)));
}
}  // namespace mill
