#include "tests/support/sample_results.h"
#include "tests/support/sample_bearing.h"
#include "tests/support/sample_line_contact.h"
#include "tests/support/sample_values.h"
#include <array>
#include <cmath>
#include <vector>

// clang-format off: lists of lists of different lengths crash clang-format 14 with AlignArrayOfStructures
namespace {
using namespace sample;
using nlohmann::ordered_json;

ordered_json chain_results(const SampleChain &chain)
{
  ordered_json v;
  constexpr double F = working_load;
  const std::vector<std::string> rolls{"work_roll.barrel_diameter", "backup_roll.barrel_diameter",
                                       "steel.youngs_modulus"};
  const double published[] = {6.3086e9, 1.0233e10, 7.53399e11, 1.91141e11, 6.58293e11, 2.9301e10, 6.8789e9};
  for (int i = 1; i <= 7; ++i) {
    const std::string name = "K" + std::to_string(i);
    if (i == 3 || i == 5) {
      const double K = hertz_tangent(F) / softer;
      v[name + ".tangent"] =
          value(K, "N/m", "computed: contact FEM", mill::at_force(976.2e3), 0.004, rolls,
                {{"Hertz line contact, axis to axis", "plane strain; the barrel ends are not in it"},
                 {"published", "no line contact of solid rolls reaches it"}},
                {hertz_tangent(F), published[i - 1]});
      v[name + ".secant"] =
          value(hertz_secant(F) / softer, "N/m", "computed: contact FEM", mill::at_force(976.2e3), 0.004, rolls,
                {{"F\u00f6ppl", ""}, {"half space", ""}}, {foeppl_secant(F), half_space_secant(F)});
    } else if (i == 4) {
      v["K4.plastic_slope"] =
          value(2.1e8, "N/m", "computed: slab model", mill::at_force(976.2e3), 0.02, {"strip.flow_stress"});
      v["K4"] = value(0, "N/m", "assumed: measured force holds the reaction of K4", mill::at_force(976.2e3));
    } else
      v[name] = value(chain.K[i - 1], "N/m", "computed: series springs", mill::at_force(976.2e3), NAN,
                      {"frame.upper_post_stiffness"}, {{"published", ""}}, {published[i - 1]});
  }
  for (int i = 1; i <= 4; ++i) {
    const bool work = i == 2 || i == 3;
    v["Kzc" + std::to_string(i) + ".tangent"] =
        value(work ? 1.669e10 : 5.114e10, "N/m", "computed: roller law, rigid rings",
              mill::operating_point_of(work ? "48.81 kN" : "488.1 kN"), 0.03,
              {work ? "bearing.trb.rollers_per_row" : "bearing.crb.rollers_per_row"},
              {{"Palmgren", "3.3 % apart at fixed load"}}, {work ? 1.72e10 : 5.28e10});
  }
  v["Kzc2.row1_share"] =
      value(0.27, "1", "computed: roller law, rigid rings", mill::operating_point_of("48.81 kN"));
  const double masses[] = {9321.943, 59716.884, 1888.705, 3094.684, 42200.563, 4663.29};
  for (int i = 0; i < 6; ++i)
    v["M" + std::to_string(i + 1)] = value(chain.M[i], "kg", "computed: shape integrals", mill::at_force(976.2e3),
                                           0.002, {"work_roll.neck_diameter"}, {{"published", ""}}, {masses[i]});
  for (int i = 0; i < 6; ++i)
    v["f" + std::to_string(i + 1)] =
        value(chain.frequency[i], "Hz", "computed: eigenvalues", mill::at_force(976.2e3), 0.03);
  return v;
}

void add_peaks(ordered_json &v)
{
  const double peaks[2][2] = {{1.23, 0.66}, {1.58, 0.85}}, model[2][2] = {{1.40, 0.75}, {1.60, 1.30}},
               measured[2][2] = {{1.20, 0.60}, {1.50, 0.90}};
  for (int pass = 0; pass < 2; ++pass)
    for (int roll = 0; roll < 2; ++roll) {
      const std::string end  = roll ? "lower_work_roll" : "upper_work_roll",
                        name = "pass " + std::to_string(pass + 1);
      v[name + ".peak_g." + end] =
          value(9.80665 * peaks[pass][roll], "m/s2", "computed: exact first-order hold", "", NAN,
                {"dynamics.modal_damping"}, {{"published model", ""}, {"measured", "one pass"}},
                {9.80665 * model[pass][roll], 9.80665 * measured[pass][roll]});
      v[name + ".rms_g." + end] =
          value(9.80665 * peaks[pass][roll] / 3.6, "m/s2", "computed: exact first-order hold");
    }
}

ordered_json two_cylinder_results()
{
  ordered_json v;
  constexpr double F = working_load;
  v["contact.line.half_width"] =
      value(half_width(F), "m", "computed: contact FEM", mill::operating_point_of("697.298 N/mm"), 0.004,
            {"upper.diameter"}, {{"Hertz", ""}}, {half_width(F)});
  v["contact.line.peak_pressure"] =
      value(peak_pressure(F), "Pa", "computed: contact FEM", mill::operating_point_of("697.298 N/mm"), 0.004,
            {"upper.diameter"}, {{"Hertz", ""}}, {peak_pressure(F)});
  v["contact.line.approach"] =
      value(softer * approach(F), "m", "computed: contact FEM", mill::operating_point_of("697.298 N/mm"), 0.004,
            {"upper.diameter"}, {{"Johnson", ""}}, {approach(F)});
  v["contact.line.tangent"] = value(hertz_tangent(F) / (softer * L), "N/m2", "computed: contact FEM",
                                    mill::operating_point_of("697.298 N/mm"), 0.004, {"upper.diameter"});
  v["contact.line.secant"]  = value(hertz_secant(F) / (softer * L), "N/m2", "computed: contact FEM",
                                    mill::operating_point_of("697.298 N/mm"), 0.004, {"upper.diameter"});
  return v;
}

}  // namespace

ordered_json sample_manifest(const SampleRun &sample, const std::string &name)
{
  ordered_json run{{"program", "millstand"},
                   {"version", "0.1.0"},
                   {"case", name},
                   {"case_path", "cases/" + name + ".toml"},
                   {"kind", sample.kind},
                   {"title", sample.title},
                   {"run_id", "7c41d09e"},
                   {"date", "2024-05-14 09:32"},
                   {"hostname", "mill-office"},
                   {"blas", "OpenBLAS 0.3.21, openmp"},
                   {"threads", 2},
                   {"peak_memory", 3.2e9}};
  run["versions"] = {{"Eigen", "3.4.0"}, {"deal.II", "9.4.1"}, {"Gmsh", "4.8.4"}};
  run["timings"]  = {{{"stage", "contact upper"}, {"seconds", 21.4}, {"cached", false}},
                     {{"stage", "contact lower"}, {"seconds", 0.1}, {"cached", true}},
                     {{"stage", "response"}, {"seconds", 0.16}, {"cached", false}}};
  if (sample.kind == "four-high")
    run["geometry"] = {
        {"work_roll_diameter", 0.42},  {"work_roll_length", 1.4},      {"work_neck_diameter", 0.2667},
        {"work_total_length", 2.32},   {"work_bearing_span", 2.0},     {"backup_diameter", 1.45},
        {"backup_length", 1.4},        {"backup_neck_diameter", 0.95}, {"backup_neck_length", 0.95},
        {"backup_bearing_span", 2.45}, {"strip_width", 1.0},           {"entry_thickness", 8e-3},
        {"exit_thickness", 5e-3}};
  run["passes"] = ordered_json::array();
  if (sample.kind == "bearing")
    run["bearings"] = sample_bearing_dimensions();
  if (sample.kind == "four-high" || sample.kind == "lumped")
    for (int i = 1; i <= 2; ++i)
      run["passes"].push_back({{"name", "pass " + std::to_string(i)},
                               {"slug", "pass-" + std::to_string(i)},
                               {"load", i == 1 ? ordered_json(976217.5) : ordered_json(nullptr)},
                               {"synthetic", true},
                               {"force_meaning", "measured"}});
  return run;
}

std::string sample_name(const SampleRun &sample)
{
  return sample.kind == "four-high" ? "four-high-1400"
         : sample.kind == "lumped"  ? "published-1400"
         : sample.kind == "bearing" ? "bearing-266"
                                    : "two-cylinders";
}

ordered_json sample_results(const SampleRun &sample, const SampleChain &chain)
{
  ordered_json results{{"schema", 1}, {"case", sample_name(sample)}, {"status", "ok"}};
  if (sample.kind == "two-cylinders")
    results["values"] = two_cylinder_results();
  else if (sample.kind == "bearing")
    results["values"] = sample_bearing_results();
  else {
    results["values"] = chain_results(chain);
    add_peaks(results["values"]);
  }
  results["warnings"] = results["warning_records"] = ordered_json::array();
  if (sample.warnings)
    results["warning_records"].push_back(
        {{"id", "force-band"}, {"subject", "pass 1"}, {"fact", "the force record ends at 1000 Hz"}});
  results["assumptions"] = {"work-roll bearings carry F/20 each", "every mode has 1 % of critical damping"};
  return results;
}
// clang-format on
