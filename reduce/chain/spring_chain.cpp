#include "reduce/chain/spring_chain.h"
#include "core/base/short_number.h"
#include "core/case/stand_rows.h"
#include <cmath>
#include <utility>
#include <vector>

namespace mill::reduce {
namespace {
struct Spring {
  const char *key;
  double stiffness;  ///< N/m; NaN: absent and rigid
};

/// 1/K = sum 1/K_i
double in_series(const std::vector<Spring> &springs)
{
  double flexibility = 0;
  for (const Spring &spring : springs) {
    if (std::isnan(spring.stiffness))
      continue;
    if (!(spring.stiffness > 0))
      throw InputError(std::string(spring.key) +
                       " must be positive: it is one of the springs in series between bite and ground");
    flexibility += 1 / spring.stiffness;
  }
  return 1 / flexibility;
}

void require_path(const PathSprings &path)
{
  for (const auto &[name, value] : {std::pair{"K_Zy of the upper backup bearings", path.K_Zy_upper},
                                    std::pair{"K_Zy of the lower backup bearings", path.K_Zy_lower},
                                    std::pair{"K_ZW of the backup roll", path.K_ZW}})
    if (!(value > 0))
      throw InputError(std::string(name) +
                       " must be positive: it is one of the springs in series between bite and ground");
}
}  // namespace

Frame with_masses_at_the_chain(Frame f, const double K1, const double K7)
{
  const double screw = 1 / f.upper_post_stiffness + 1 / f.upper_beam_stiffness,
               seat  = 1 / f.lower_post_stiffness + 1 / f.lower_beam_stiffness;
  const double upper = std::isnan(K1) ? screw + 1 / f.piston_stiffness + 1 / f.upper_packing_stiffness : 1 / K1;
  const double cell  = std::isnan(f.load_cell_stiffness) ? 0 : 1 / f.load_cell_stiffness;
  const double lower = std::isnan(K7) ? seat + 1 / f.lower_packing_stiffness + cell : 1 / K7;
  for (double *mass : {&f.upper_post_mass, &f.upper_beam_mass})
    *mass *= std::pow(screw / upper, 2);
  for (double *mass : {&f.lower_post_mass, &f.lower_beam_mass})
    *mass *= std::pow(seat / lower, 2);
  return f;
}

std::vector<FrameValue> frame_values(const Frame &frame)
{
  std::vector<FrameValue> values;
  for (const Field<Frame> &row : frame_rows()) {
    const auto member = std::get<double Frame::*>(row.member);
    const auto given  = frame.tolerance.find(row.key);
    const auto source = frame.source.find(row.key);
    if (!std::isnan(frame.*member))
      values.push_back({member, given == frame.tolerance.end() ? not_given : given->second,
                        "frame." + tolerance_key(row.key), source == frame.source.end() ? "" : source->second});
  }
  return values;
}

SeriesSprings series_springs(const Frame &f, const PathSprings &path)
{
  require_path(path);
  SeriesSprings chain;
  chain.K1 = in_series({{"frame.upper_post_stiffness", f.upper_post_stiffness},  // (4.1a)
                        {"frame.upper_beam_stiffness", f.upper_beam_stiffness},
                        {"frame.piston_stiffness", f.piston_stiffness},
                        {"frame.upper_packing_stiffness", f.upper_packing_stiffness}});
  chain.K2 = in_series({{"frame.oil_column_stiffness", f.oil_column_stiffness},  // (4.1b)
                        {"frame.cylinder_body_stiffness", f.cylinder_body_stiffness},
                        {"frame.upper_chock_stiffness", f.upper_chock_stiffness},
                        {"K_Zy", path.K_Zy_upper},
                        {"K_ZW", path.K_ZW}});
  chain.K6 = in_series({{"frame.lower_chock_stiffness", f.lower_chock_stiffness},  // (4.1c)
                        {"K_Zy", path.K_Zy_lower},
                        {"K_ZW", path.K_ZW}});
  chain.K7 = in_series({{"frame.lower_post_stiffness", f.lower_post_stiffness},  // (4.1d)
                        {"frame.lower_beam_stiffness", f.lower_beam_stiffness},
                        {"frame.lower_packing_stiffness", f.lower_packing_stiffness},
                        {"frame.load_cell_stiffness", f.load_cell_stiffness}});
  return chain;
}

namespace {
void share_the_rest(const std::string &name, const double K, const std::vector<double *> &parts, double known)
{
  std::vector<double *> open;
  for (double *part : parts)
    if (std::isnan(*part))
      open.push_back(part);
    else
      known += 1 / *part;
  if (open.empty() || std::isnan(K))
    return;
  const double rest = 1 / K - known;
  if (!(rest > 0))
    throw InputError("given." + name + " = " + short_number(K / 1e6) +
                     " kN/mm is stiffer than bearings and bending of the backup roll in it, which have " +
                     short_number(1 / known / 1e6) + " kN/mm; give a softer one, or K_Zy and K_ZW as well");
  for (double *part : open)
    *part = double(open.size()) / rest;
}
}  // namespace

Frame with_given_springs(Frame f, const PathSprings &path, const double K2, const double K6)
{
  share_the_rest("K2", K2, {&f.oil_column_stiffness, &f.cylinder_body_stiffness, &f.upper_chock_stiffness},
                 1 / path.K_Zy_upper + 1 / path.K_ZW);
  share_the_rest("K6", K6, {&f.lower_chock_stiffness}, 1 / path.K_Zy_lower + 1 / path.K_ZW);
  return f;
}

Flexibilities flexibilities(const Frame &f, const PathSprings &path, const double K1, const double K7)
{
  Flexibilities u;  // (4.2), from the ground towards the bite
  u.frame_upper   = 1 / K1;
  u.cylinder      = u.frame_upper + 1 / f.oil_column_stiffness;
  u.chock_upper   = u.cylinder + 1 / f.cylinder_body_stiffness;
  u.bearing_upper = u.chock_upper + 1 / f.upper_chock_stiffness + 1 / path.K_Zy_upper;
  u.roll_upper    = u.bearing_upper + 1 / path.K_ZW;
  u.frame_lower   = 1 / K7;
  u.bearing_lower = u.frame_lower + 1 / f.lower_chock_stiffness + 1 / path.K_Zy_lower;
  u.roll_lower    = u.bearing_lower + 1 / path.K_ZW;
  return u;
}
}  // namespace mill::reduce
