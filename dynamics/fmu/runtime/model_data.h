#pragma once
#include "chatter_data.h"
#include "curve_data.h"
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

// What resources/model.json holds.
namespace mill::fmu {
/// Version of the runtime and of the layout of its files; part of every identity (theory.md 35.6).
constexpr const char *runtime_version = "4";

constexpr int fixed_end = -1;  ///< the end of a spring on the ground

/// One spring of a chain, between two masses or between a mass and the ground.
struct SpringData {
  std::string name;       ///< "K3"
  int from      = -1;     ///< mass, or fixed_end
  int to        = -1;     ///< mass, or fixed_end
  double start  = 0;      ///< N/m
  bool may_rest = false;  ///< may be zero: K4, which a measured force leaves out
  double damper = 0;      ///< N s/m, in parallel with it: an oil film
};

enum class StandKind { chain, modal, curves, chatter };
const char *name_of(StandKind kind);
/// @throws std::runtime_error  no kind has this name
StandKind stand_kind(const std::string &name);

/// A linear stand driven by its bite force, as a chain of masses whose springs may be tuned or in modes that are
/// kept as they are, with springs on curves or without; or a stand whose bite is part of the model.
struct ModelData {
  std::string runtime;  ///< runtime_version of the program that wrote it
  std::string guid;     ///< identity of model, variables and runtime
  StandKind kind = StandKind::chain;
  std::vector<std::string> points;  ///< (m) what moves, "upper_work_roll"
  double modal_damping    = 0;      ///< -, ratio of critical of every mode
  double gap_damper       = 0;      ///< N s/m, between the work rolls
  double mean_force       = 0;      ///< N, displacements count from the state under it
  bool has_series         = false;  ///< resources/force.csv travels along
  bool share_from_statics = false;  ///< the load cell shows what the springs leave it, else the whole mean force
  double load_cell_share  = 1;      ///< -, part of the mean force that the load cell shows, where it is given

  // kind "chain": m masses
  std::vector<double> mass;         ///< (m) kg
  std::vector<SpringData> springs;  ///< in the order K1..
  std::vector<double> bite_row;     ///< (m) -, force on each mass per unit of bite force
  int load_cell_spring = 0;         ///< place in the list of the spring with the load cell

  // kinds "modal" and "curves": n modes
  std::vector<double> frequency;       ///< (n) Hz, ascending, above zero
  std::vector<double> shape;           ///< (m * n, by rows) kg^-1/2, displacement of each point in each mode
  std::vector<double> bite_mode;       ///< (n) kg^-1/2, bite force on each mode
  std::vector<double> load_cell_mode;  ///< (n) N/m kg^-1/2
  std::vector<double> damper_rows;     ///< (r * n, by rows) (N s/m)^1/2 kg^-1/2, dampers of oil films

  CurveData curves;     ///< kind "curves" alone
  ChatterData chatter;  ///< kind "chatter" alone; the members above except the points are empty then

  std::size_t n_modes() const
  {
    return kind == StandKind::chain     ? mass.size()
           : kind == StandKind::chatter ? chatter.gap_row.size()
                                        : frequency.size();
  }
};

/// The members in the order of the file: the reader below, the writer and the identity of the exporter come from
/// these lists.
template <class IO, class S> void each_member(IO &io, S &spring, const SpringData *)
{
  io("name", spring.name);
  io("from", spring.from);
  io("to", spring.to);
  io("start", spring.start);
  io("damper", spring.damper);
  io("may_rest", spring.may_rest);
}
template <class IO, class M> void each_member(IO &io, M &model, const ModelData *)
{
  io("runtime", model.runtime);
  io("guid", model.guid);
  std::string kind = name_of(model.kind);
  io("kind", kind);
  if constexpr (!std::is_const_v<M>)
    model.kind = stand_kind(kind);
  io("points", model.points);
  io("modal_damping", model.modal_damping);
  io("gap_damper", model.gap_damper);
  io("mean_force", model.mean_force);
  io("has_series", model.has_series);
  io("share_from_statics", model.share_from_statics);
  io("load_cell_share", model.load_cell_share);
  io("mass", model.mass);
  io("springs", model.springs);
  io("bite_row", model.bite_row);
  io("load_cell_spring", model.load_cell_spring);
  io("frequency", model.frequency);
  io("shape", model.shape);
  io("bite_mode", model.bite_mode);
  io("load_cell_mode", model.load_cell_mode);
  io("damper_rows", model.damper_rows);
  if (model.kind == StandKind::curves)
    io("curves", model.curves);
  if (model.kind == StandKind::chatter)
    io("chatter", model.chatter);
}

/// @throws std::runtime_error  no model of this runtime: what is missing or of the wrong size
ModelData read_model(const std::string &json);
}  // namespace mill::fmu
