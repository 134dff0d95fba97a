#pragma once
#include "core/model/material.h"
#include "core/model/roller_bearing.h"
#include <array>
#include <string>
#include <vector>

namespace mill {
/// Oil-film bearing: a turning sleeve in a bush of full circumference, one film.
struct OilFilmBearing {
  std::string name;                              ///< the * of [bearing.*]
  BearingType type = BearingType::oil_film;      ///< its only one
  double diameter  = 0;                          ///< m, of the sleeve
  double length    = 0;                          ///< m, of the film
  double clearance = 0;                          ///< m, radial: radius of the bush less that of the sleeve
  std::vector<std::array<double, 2>> viscosity;  ///< (K, Pa s), one point: the same at every temperature; or two
  double inlet_temperature  = 313.15;            ///< K
  double oil_density        = 880;               ///< kg/m3
  double oil_heat           = 2000;              ///< J/(kg K), specific heat
  double heat_share         = 1;                 ///< -, of the friction heat that leaves with the oil
  double warming_share      = 0.5;               ///< -, of the oil's whole warming that the film's temperature has
  double pressure_viscosity = 0;                 ///< 1/Pa, Barus' exponent
  double roughness          = 1e-6;              ///< m, rms of both surfaces together
  double bush_thickness     = not_given;         ///< m, of the layer that is pressed; absent: rigid
  double bush_modulus       = 52e9;              ///< Pa, babbitt
  double bush_poisson       = 0.35;              ///< -
  double sleeve_thickness   = not_given;         ///< m; absent: rigid
  double sleeve_modulus     = 210e9;             ///< Pa
  double sleeve_poisson     = 0.3;               ///< -
  int grooves               = 0;                 ///< none, one, or two opposite each other
  double groove_angle       = -1.5707963267948966;  ///< rad, of the first from the load, with the rotation
  double groove_width       = 0.5235987755982988;   ///< rad
  double groove_length      = 0.8;                  ///< -, of the film's length
  double feed_pressure      = 1e5;                  ///< Pa, in the grooves
};

// All of it but its name, which is for messages, and its type, which is its only one.
template <class Io> void each_member(Io &&io, const OilFilmBearing &record)
{
  const auto &[name, type, diameter, length, clearance, viscosity, inlet_temperature, oil_density, oil_heat,
               heat_share, warming_share, pressure_viscosity, roughness, bush_thickness, bush_modulus,
               bush_poisson, sleeve_thickness, sleeve_modulus, sleeve_poisson, grooves, groove_angle, groove_width,
               groove_length, feed_pressure] = record;
  io("diameter", diameter);
  io("length", length);
  io("clearance", clearance);
  io("viscosity", viscosity);
  io("inlet_temperature", inlet_temperature);
  io("oil_density", oil_density);
  io("oil_heat", oil_heat);
  io("heat_share", heat_share);
  io("warming_share", warming_share);
  io("pressure_viscosity", pressure_viscosity);
  io("roughness", roughness);
  io("bush_thickness", bush_thickness);
  io("bush_modulus", bush_modulus);
  io("bush_poisson", bush_poisson);
  io("sleeve_thickness", sleeve_thickness);
  io("sleeve_modulus", sleeve_modulus);
  io("sleeve_poisson", sleeve_poisson);
  io("grooves", grooves);
  io("groove_angle", groove_angle);
  io("groove_width", groove_width);
  io("groove_length", groove_length);
  io("feed_pressure", feed_pressure);
}
}  // namespace mill
