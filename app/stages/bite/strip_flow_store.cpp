#include "app/stages/bite/strip_flow_store.h"
#include "app/stages/bite/kept_remarks.h"
#include <nlohmann/json.hpp>

namespace mill {
namespace {
// One list of members serves both directions.  `io(name, member)` writes or reads.
template <class Io> void each_member(Io &&io, bite::BiteState &s)
{
  io("model", s.model);
  io("force", s.force);
  io("torque", s.torque);
  io("friction", s.friction);
  io("film_thickness", s.film_thickness);
  io("flattened_radius", s.flattened_radius);
  io("arc_length", s.arc_length);
  io("exit_position", s.exit_position);
  io("bite_angle", s.bite_angle);
  io("neutral_position", s.neutral_position);
  io("neutral_thickness", s.neutral_thickness);
  io("sticking_length", s.sticking_length);
  io("entry_speed", s.entry_speed);
  io("exit_speed", s.exit_speed);
  io("forward_slip", s.forward_slip);
  io("peak_pressure", s.peak_pressure);
  io("entry_flow_stress", s.entry_flow_stress);
  io("exit_flow_stress", s.exit_flow_stress);
  io("largest_shear", s.largest_shear);
  io("iterations", s.iterations);
  io("force_by", s.force_by);
  io("torque_by", s.torque_by);
  io("force_by_exit_following", s.force_by_exit_following);
  io("position", s.position);
  io("thickness", s.thickness);
  io("pressure", s.pressure);
  io("shear", s.shear);
  io("slip", s.slip);
  io("notes", s.notes);
  io("remarks", s.remarks);
}

template <class Io> void each_member(Io &&io, fem::StripFlow &f)
{
  io("flux", f.balance.flux);
  io("force_x", f.balance.force_x);
  io("power", f.balance.power);
  io("n_unknowns", f.n_unknowns);
  io("seconds", f.seconds);
  io("entry_position", f.entry_position);
  io("strip_exit_thickness", f.exit_thickness);
  io("exit_tension", f.exit_tension);
  io("second_peak", f.second_peak);
  io("slip_changes", f.slip_changes);
  io("negative_length", f.negative_length);
  io("x", f.x);
  io("y", f.y);
  io("vx", f.vx);
  io("vy", f.vy);
  io("mean_pressure", f.pressure);
  io("strain", f.strain);
  io("rate", f.rate);
  io("sxx", f.sxx);
  io("syy", f.syy);
  io("sxy", f.sxy);
  io("first_contact", f.first_contact);
  io("last_contact", f.last_contact);
  io("nodal_force", f.nodal_force);
  io("roll_surface", f.roll_surface);
  io("flattening", f.flattening);
}

template <class Io> void each_member(Io &&io, FlowAnswer &a)
{
  io("coarse_force", a.coarse_force);
  io("coarse_slope", a.coarse_slope);
  io("coarse_torque", a.coarse_torque);
  io("coarse_slip", a.coarse_slip);
  io("elastic", a.elastic);
  io("smallest_thickness", a.smallest_thickness);
  io("elastic_entry", a.elastic_entry);
  io("elastic_exit", a.elastic_exit);
  io("elastic_power", a.elastic_power);
  io("outlet_height", a.outlet_height);
  io("outlet_stress", a.outlet_stress);
}

// JSON knows no nan: it is written as null.
nlohmann::json number(const double value)
{
  return std::isnan(value) ? nlohmann::json() : nlohmann::json(value);
}
double number(const nlohmann::json &value)
{
  return value.is_null() ? not_given : value.get<double>();
}

struct Writer {
  nlohmann::json &out;
  template <class T> void operator()(const char *name, const T &value)
  {
    if constexpr (std::is_same_v<T, double>)
      out[name] = number(value);
    else if constexpr (std::is_same_v<T, bite::Gradient>)
      for (const double one : value)
        out[name].push_back(number(one));
    else if constexpr (std::is_same_v<T, Eigen::VectorXd> || std::is_same_v<T, Eigen::MatrixXd>) {
      nlohmann::json numbers = nlohmann::json::array();
      for (Eigen::Index i = 0; i < value.size(); ++i)
        numbers.push_back(number(value.data()[i]));
      out[name] = {{"rows", value.rows()}, {"numbers", numbers}};
    } else if constexpr (std::is_same_v<T, std::vector<Warning>>)
      out[name] = text_of_remarks(value);
    else
      out[name] = value;
  }
};

struct Reader {
  const nlohmann::json &in;
  template <class T> void operator()(const char *name, T &value)
  {
    const nlohmann::json &entry = in.at(name);
    if constexpr (std::is_same_v<T, double>)
      value = number(entry);
    else if constexpr (std::is_same_v<T, bite::Gradient>)
      for (std::size_t i = 0; i < value.size(); ++i)
        value[i] = number(entry.at(i));
    else if constexpr (std::is_same_v<T, Eigen::VectorXd> || std::is_same_v<T, Eigen::MatrixXd>) {
      const nlohmann::json &numbers = entry.at("numbers");
      const auto rows               = entry.at("rows").get<Eigen::Index>();
      const auto size               = Eigen::Index(numbers.size());
      value.resize(rows, rows == 0 ? 0 : size / rows);
      if (value.size() != size)
        throw std::out_of_range(name);
      for (Eigen::Index i = 0; i < size; ++i)
        value.data()[i] = number(numbers[std::size_t(i)]);
    } else if constexpr (std::is_same_v<T, std::vector<Warning>>)
      value = remarks_of_text(entry.get<std::string>());
    else
      entry.get_to(value);
  }
};
}  // namespace

std::string stored_flow(const FlowAnswer &answer)
{
  FlowAnswer a = answer;  // the list of members is not const
  nlohmann::json body;
  each_member(Writer{body["state"]}, a.fine.state);
  each_member(Writer{body["flow"]}, a.fine);
  each_member(Writer{body["answer"]}, a);
  return body.dump();
}

std::optional<FlowAnswer> restored_flow(const std::string &text)
{
  try {
    const nlohmann::json body = nlohmann::json::parse(text);
    FlowAnswer a;
    each_member(Reader{body.at("state")}, a.fine.state);
    each_member(Reader{body.at("flow")}, a.fine);
    each_member(Reader{body.at("answer")}, a);
    return a;
  } catch (const std::exception &) {
    return std::nullopt;  // another version's
  }
}
}  // namespace mill
