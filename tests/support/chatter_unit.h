#pragma once
#include "app/export/exported_chatter.h"
#include "core/model/case.h"
#include "reduce/bite/bite.h"
#include "tests/support/unit_client.h"

// The chatter unit of condition 2 of cases/chatter-tandem.toml, and its bite.
inline const mill::Case &tandem()
{
  static const mill::Case read = mill::read_case(MILLSTAND_SOURCE_DIR "/cases/chatter-tandem.toml");
  return read;
}

inline mill::fmu::ExportedModel unit_of(const std::string &condition)
{
  return mill::exported_chatter(std::get<mill::ChatterCase>(tandem().spec), condition, tandem());
}

inline const mill::fmu::ExportedModel &unit_2()
{
  static const mill::fmu::ExportedModel made = unit_of("2");
  return made;
}

/// The bite of condition 2 at 18.2 m/s.
inline mill::bite::RollBite tandem_bite()
{
  mill::bite::RollBite film;
  film.strip                 = std::get<mill::ChatterCase>(tandem().spec).strip;
  film.strip.width           = 1.206;
  film.strip.entry_thickness = 0.789e-3, film.strip.exit_thickness = 0.577e-3;
  film.strip.entry_tension = 180e6, film.strip.exit_tension = 189e6;
  film.roll        = std::get<mill::ChatterCase>(tandem().spec).steel;
  film.roll_radius = 0.3;
  film.roll_speed  = 18.2;
  return film;
}

/// Up to the end of initialization, without a force; 0 where all calls succeed.
inline int begin(Client2 &client, const double start_time = 0)
{
  const unsigned force = 1;
  const double zero    = 0;
  return FMI2(client, SetupExperiment)(client.c, 0, 0, start_time, 0, 0) +
         FMI2(client, EnterInitializationMode)(client.c) + FMI2(client, SetReal)(client.c, &force, 1, &zero) +
         FMI2(client, ExitInitializationMode)(client.c);
}
