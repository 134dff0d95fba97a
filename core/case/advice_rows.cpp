#include "core/case/advice_rows.h"

// What millstand advise may try.  Columns as in stand_rows.cpp.
namespace mill {
namespace {
// Rows of a record and of its bases: what may be asked of a stand, and what may be done to a pass, stands in two
// records each.
template <class T> class RowList {
public:
  std::vector<Field<T>> rows;
  void add(const char *key, Member<T> member, const char *form, Range range, Fallback fallback,
           const char *example, const char *meaning)
  {
    rows.push_back({key, member, form, range, fallback, example, meaning});
  }
  void bounds(const char *key, Member<T> member, const char *example, const char *meaning)
  {
    add(key, member, "1", {0.05, 20}, absent, example, meaning);
  }
  void add_stand();
  void add_limits();
  void add_process();
};

template <class T> void RowList<T>::add_stand()
{
  add("place", &T::place, "text", any, "upper_work_roll", "upper_work_roll",
      "place whose rms acceleration is to be lowered, named as the columns of response/*.csv");
  add("band", &T::band, "Hz", {0, 20000}, absent, R"(["100 Hz", "300 Hz"])",
      "of that level; from 0 to dynamics.frequency_limit (1000 Hz of a chain) when absent");
  add("springs", &T::springs, "K1 | K2 | K3 | K4 | K5 | K6 | K7", any, absent, R"(["K3", "K5"])",
      "springs of the chain that are tried stiffer and softer; all but the bite's K4 when absent");
  add("stiffness", &T::stiffness, "1", {0.05, 20}, absent, "[0.8, 1.2]",
      "factors on each of these springs; [0.8, 1.2] when absent, a factor of 1 is not tried");
  add("modal_damping", &T::modal_damping, "1", {0.05, 20}, absent, "[1, 1.5]",
      "factors on the damping ratio of all modes; when absent not tried for a level, [1, 1.5] as a what-if for a "
      "critical speed");
  add("usual_damper", &T::usual_damper, "N s/m", {0, 1e12}, 1e5, "1e5 N s/m",
      "of the dampers that are tried without [[advice.damper]]: work roll to backup roll, work roll to work "
      "roll; "
      "0: none");
  add("tuned_mass", &T::tuned_mass, "%", {0, 100}, 5, "5 %",
      "mass ratio of the tuned damper that is tried at the place without [[advice.tuned_damper]]; 0: none");
  add("rise_elsewhere", &T::rise_elsewhere, "%", {0, 1e4}, 10, "10 %",
      "most that the level of another roll may rise");
  add("softening", &T::softening, "%", {0, 100}, 10, "10 %",
      "most that the stiffness of the stand under the bite force may fall");
}

template <class T> void RowList<T>::add_limits()
{
  add("wanted_speed", &T::wanted_speed, "m/s", {0.01, 100}, absent, "18 m/s",
      "speed at which the mill shall roll at least, usually above the present one: the critical speed is judged "
      "there; the present speed when absent");
  add("force_rise", &T::force_rise, "%", {0, 1000}, 5, "5 %", "most that the rolling force may rise");
  add("torque_rise", &T::torque_rise, "%", {0, 1000}, absent, "5 %",
      "most that the rolling torque may rise; any when absent");
}

template <class T> void RowList<T>::add_process()
{
  bounds("speed", &T::speed, "[0.9, 1]", "factors on the working speed; [0.9, 1] when absent");
  bounds("entry_thickness", &T::entry_thickness, "[0.95, 1.05]",
         "factors, the exit thickness stays; [0.95, 1.05] when absent");
  bounds("entry_tension", &T::entry_tension, "[0.8, 1.2]", "factors; [0.8, 1.2] when absent");
  bounds("exit_tension", &T::exit_tension, "[0.8, 1.2]", "factors; [0.8, 1.2] when absent");
  bounds("viscosity", &T::viscosity, "[0.8, 1.2]", "factors on that of the oil; [0.8, 1.2] when absent");
}
}  // namespace

const std::vector<Field<StandAdvice>> &stand_advice_rows()
{
  static const std::vector<Field<StandAdvice>> rows = [] {
    RowList<StandAdvice> list;
    list.add_stand();
    return list.rows;
  }();
  return rows;
}

const std::vector<Field<FourHighAdvice>> &four_high_advice_rows()
{
  using T                                 = FourHighAdvice;
  static const std::vector<Field<T>> rows = [] {
    RowList<T> list;
    list.add(
        "goal", &T::goal, "choice", any, absent, "level",
        "what the advice shall improve; when absent the critical speed where the first pass has a speed and a "
        "bite and neither place, band nor a measured force is given, else the level of the place");
    list.add_stand();
    list.add("margin", &T::margin, "%", {0, 1000}, 10, "10 %",
             "wanted distance: critical speed at least (1 + margin) times the working speed");
    list.add(
        "model", &T::model, "beam | craig-bampton", any, StandModelKind::beam, "craig-bampton",
        "in which every action is repeated and which decides: rolls as beams, within seconds, or as component "
        "modes of their finite elements, within minutes");
    list.add_limits();
    list.add("nearer_chatter", &T::nearer_chatter, "%", {0, 100}, 1, "1 %",
             "most that the critical speed over the working speed may fall");
    list.add_process();
    list.bounds("friction", &T::friction, "[0.8, 1.2]",
                "factors, where friction does not follow an oil film; [0.8, 1.2] when absent");
    list.bounds("flow_stress", &T::flow_stress, "[0.95, 1.05]",
                "factors, for the critical speed; [0.95, 1.05] when absent");
    return list.rows;
  }();
  return rows;
}

const std::vector<Field<DamperProposal>> &damper_proposal_rows()
{
  using T = DamperProposal;
  static const std::vector<Field<T>> rows{
      {"name", &T::name, "text", any, absent, "both work rolls", "dampers of one name are one action"},
      {"from", &T::from, "text", any, required, "upper_work_roll", "place, as for advice.place"},
      {"to", &T::to, "text", any, required, "upper_backup_roll", "place; ground is one"},
      {"damper", &T::damper, "N s/m", {1e-3, 1e12}, required, "1e5 N s/m", "of both sides together"},
  };
  return rows;
}

const std::vector<Field<TunedDamperProposal>> &tuned_proposal_rows()
{
  using T = TunedDamperProposal;
  static const std::vector<Field<T>> rows{
      {"at", &T::at, "text", any, absent, "upper_work_roll", "place of the mass; advice.place when absent"},
      {"mass", &T::mass, "kg", {1e-3, 1e7}, absent, "100 kg", "of both sides together; by mass_ratio when absent"},
      {"mass_ratio",
       &T::mass_ratio,
       "%",
       {0.01, 200},
       5,
       "5 %",
       "over the effective mass of the leading mode at that place"},
  };
  return rows;
}

const std::vector<Field<ChatterAdvice>> &chatter_advice_rows()
{
  using T                                 = ChatterAdvice;
  static const std::vector<Field<T>> rows = [] {
    RowList<T> list;
    list.add("condition", &T::condition, "text", any, absent, "2",
             "condition to be stabilised; when absent the one whose critical speed is the smallest multiple of "
             "its speed");
    list.add("margin", &T::margin, "%", {0, 1000}, 10, "10 %",
             "wanted distance: critical speed at least (1 + margin) times the working speed");
    list.add_limits();
    list.add_process();
    list.bounds("stiffness", &T::stiffness, "[1, 1.1]",
                "factors on each spring of the stand; [1, 1.1] when absent");
    list.bounds("damping", &T::damping, "[1, 2]",
                "factors on each damper of the stand, or on its modal damping; [1, 2] when absent");
    return list.rows;
  }();
  return rows;
}

namespace {
SectionRows advice_section(const std::vector<Row> &rows)
{
  return {"advice", SectionRows::Repeat::once, false, "what millstand advise may try and must keep", rows};
}

std::vector<SectionRows> with_dampers(const std::vector<Row> &rows)
{
  using Repeat = SectionRows::Repeat;
  return {advice_section(rows),
          {"advice.damper", Repeat::list, false, "a damper between two places, tried by millstand advise",
           rows_of(damper_proposal_rows())},
          {"advice.tuned_damper", Repeat::list, false, "a tuned damper at a place, tried by millstand advise",
           rows_of(tuned_proposal_rows())}};
}
}  // namespace

std::vector<SectionRows> stand_advice_sections()
{
  return with_dampers(rows_of(stand_advice_rows()));
}

std::vector<SectionRows> four_high_advice_sections()
{
  return with_dampers(rows_of(four_high_advice_rows()));
}

SectionRows chatter_advice_section()
{
  return advice_section(rows_of(chatter_advice_rows()));
}

std::vector<TemplateNote> stand_advice_notes()
{
  return {{"advice", "", {}, {}, true},
          {"advice.damper", "", {}, {}, true},
          {"advice.tuned_damper", "", {}, {}, true}};
}

TemplateNote chatter_advice_note()
{
  return {"advice", "", {}, {}, true};
}
}  // namespace mill
