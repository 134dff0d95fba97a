#include "core/case/advice_rows.h"
#include "core/case/chain_curves.h"
#include "core/case/kinds.h"
#include "core/case/monitoring.h"
#include "core/case/plant.h"
#include "core/case/stand_reader.h"
#include "core/case/stand_sections.h"

namespace mill {
const std::vector<Field<ModelFiles>> &model_file_rows()
{
  using T = ModelFiles;
  static const std::vector<Field<T>> rows{
      {"name", &T::name, "text", {}, "detailed", "craig-bampton", "what the model is called"},
      {"mass",
       &T::mass,
       "path",
       {},
       required,
       "models/craig-bampton-mass.mtx",
       "mass matrix, Matrix Market, kg; symmetric and positive definite"},
      {"stiffness",
       &T::stiffness,
       "path",
       {},
       required,
       "models/craig-bampton-stiffness.mtx",
       "stiffness matrix, Matrix Market, N/m; symmetric"},
      {"force",
       &T::force,
       "path",
       {},
       required,
       "models/craig-bampton-force.mtx",
       "force on each unknown per unit of bite force, one column"},
      {"readings",
       &T::readings,
       "path",
       {},
       required,
       "models/craig-bampton-readings.mtx",
       "displacement of each named place, one row each, then the change of the load-cell force in N/m"},
      {"names",
       &T::names,
       "path",
       {},
       required,
       "models/craig-bampton-names.csv",
       "what the unknowns and the readings are"},
      {"connections",
       &T::connections,
       "path",
       {},
       absent,
       "models/craig-bampton-connections.csv",
       "springs between the parts, which the stiffness matrix holds: what calibrate may move"},
      {"strains",
       &T::strains,
       "path",
       {},
       absent,
       "models/craig-bampton-strains.mtx",
       "strain of each spring of connections per displacement, one row each"},
      {"gap_damper", &T::gap_damper, "N s/m", {0, 1e12}, absent, "1.9e5 N s/m", "damper between the work rolls"},
      {"frequency_limit",
       &T::frequency_limit,
       "Hz",
       {20, 20000},
       1000,
       "1000 Hz",
       "up to which the modes of the model are right"},
      {"modes",
       &T::modes,
       "1, Hz",
       {0.01, 1e6},
       absent,
       "[[1, \"37.8 Hz\"], [2, \"52.5 Hz\"]]",
       "number and frequency of modes; a run refuses matrices that have other modes"},
  };
  return rows;
}

Lumped read_lumped(const Node &root, Reading &reading)
{
  Lumped lumped;
  const Section model = section_at(root, "model", reading);
  lumped.detailed     = model.node != nullptr;
  if (lumped.detailed) {
    read_and_echo(model, model.header(), model_file_rows(), lumped.model, reading);
    lumped.model.place = model.node->place;
    if (lumped.model.connections.empty() != lumped.model.strains.empty())
      reading.add(model.node->place, "model.connections and model.strains belong together; give both or none");
    if (const Section given = section_at(root, "given", reading); given.node)
      reading.add(given.node->place,
                  "[given] holds the masses and springs of a chain, and [model] another model of the stand; leave "
                  "one of the two out",
                  {model.node->place});
  } else
    lumped.given = read_given(root, "given", "lumped", reading);
  lumped.curves = read_chain_curves(root, reading);
  lumped.passes = read_passes(root, pass_rows(), reading);
  check_passes(lumped.passes, reading);
  lumped.dynamics           = read_dynamics(root, chain_dynamics_rows(), reading);
  lumped.frequency_response = read_frequency_response(root, reading);
  lumped.campbell           = read_campbell(root, chain_campbell_rows(), reading);
  lumped.drive              = read_drive_orders(root, reading);
  lumped.advice             = read_stand_advice(root, reading);
  read_plant(root, reading);
  read_monitoring(root, reading);  // checked here, used by those who read records
  check_turning_shafts(lumped.campbell, lumped.drive, reading);
  if (!lumped.detailed)
    check_published_force(lumped.dynamics, lumped.given, reading);
  check_contact_curves(lumped, reading);
  return lumped;
}

const CaseKind &case_kind(const Lumped *)
{
  static const CaseKind kind = [] {
    CaseKind k;
    k.name     = word_of(KindOfCase::lumped);
    k.title    = "lumped model";
    k.read     = [](const Node &root, Reading &reading) -> CaseSpec { return read_lumped(root, reading); };
    k.sections = {head_section(),
                  given_section(lumped_given_rows(), false),
                  {"model", SectionRows::Repeat::once, false,
                   "a stand of any number of unknowns in files, in place of [given]", rows_of(model_file_rows())},
                  {"curve", SectionRows::Repeat::once, false,
                   "force over compression of springs of the chain, for dynamics.contact = \"curve\"",
                   rows_of(chain_curve_rows())},
                  pass_section(false),
                  dynamics_section(chain_dynamics_rows()),
                  frequency_response_section(),
                  campbell_section(chain_campbell_rows()),
                  drive_order_section(),
                  monitoring_section(),
                  ball_bearing_section(),
                  plant_section()};
    for (const SectionRows &section : stand_advice_sections())
      k.sections.push_back(section);
    k.notes = {drive_order_note(),
               monitoring_note(),
               ball_bearing_note(),
               plant_note(),
               {"model", "", {}, {}, true},  // [given] says it
               {"curve", "", {}, {}, true},  // numbers say it
               {"pass", "", {{"synthetic", "true"}}, {"synthetic_range"}},
               {"pass",
                "",
                {{"name", "\"pass 2\""},
                 {"synthetic", "true"},
                 {"synthetic_range", "[\"733.705 kN\", \"742.280 kN\"]"},
                 {"synthetic_seed", "2"}},
                {}}};
    for (const TemplateNote &note : stand_advice_notes())
      k.notes.push_back(note);
    k.given = k.published = lumped_given_rows();
    k.repeated            = [](const CaseSpec &spec, const std::string &section) {
      const auto &the_case = std::get<Lumped>(spec);
      if (section == "drive.order")
        return numbers_to(the_case.drive.size());
      if (section == "advice.damper")
        return numbers_to(the_case.advice.dampers.size());
      if (section == "advice.tuned_damper")
        return numbers_to(the_case.advice.tuned.size());
      return section == "pass" ? numbers_to(the_case.passes.size()) : std::vector<std::string>();
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
