#include "app/stages/bearing/loaded_bearing.h"
#include "app/run/scratch_folder.h"
#include "app/stages/bearing/bearing_ratings.h"
#include "app/stages/bearing/bearing_results.h"
#include "core/case/bearing_inputs.h"
#include "core/case/kinds.h"
#include "core/model/case.h"
#include "core/records/result_names.h"
#include <cmath>

namespace mill {
namespace {
// "backup" and "work" are the bearings of these rolls; every other word is a name.
std::string name_of_bearing(const Case &the_case, const std::string &which)
{
  const auto *stand = std::get_if<FourHigh>(&the_case.spec);
  for (const auto &[word, roll] :
       {std::pair("backup", &FourHigh::backup_roll), std::pair("work", &FourHigh::work_roll)})
    if (stand && which == word)
      return (stand->*roll).bearing;
  return which;
}

RollerBearing drawn_bearing(const Case &the_case, const std::string &which)
{
  const std::string name = name_of_bearing(the_case, which);
  std::string known;
  for (const RollerBearing &bearing : all_bearings(the_case)) {
    if (bearing.name == name)
      return bearing;
    known += (known.empty() ? "" : ", ") + bearing.name;
  }
  throw InputError(the_case.path + " has no roller bearing '" + name + "'; it has " +
                   (known.empty() ? "none" : known));
}
}  // namespace

LoadedBearing::LoadedBearing(std::shared_ptr<const Case> of, const std::string &which, std::string folder,
                             const int n_threads)
    : the_case(std::move(of)), drawn(drawn_bearing(*the_case, which)), cache(std::move(folder)), threads(n_threads)
{
}

const RollerBearing &LoadedBearing::bearing() const
{
  return drawn;
}

LoadedState LoadedBearing::solve(const BearingLoading &load, const Progress &progress) const
{
  for (const double value : {load.radial, load.axial, load.tilt})
    if (!std::isfinite(value))
      throw InputError("a load of a bearing is a finite number");
  BearingQuestion question;
  question.bearing = drawn;
  question.radial  = load.radial;
  question.axial   = load.axial;
  question.tilt    = load.tilt;
  const ScratchFolder scratch("millstand-bearing", true);
  const OutputDir out(scratch.path(), *the_case, true, "bearing");
  RunContext run{*the_case, out, cache, false};
  run.threads              = threads;
  run.progress             = progress;
  const BearingParts parts = bearing_parts(run, drawn, bearing::largest_roller_load(question.bearing, question));
  const BearingStudy study = study_bearing(run, parts, question);
  const LoadForm form{load.tilt != 0, load.axial != 0};
  const KeysOfRow inputs = [&](const ResultRow &row) {
    return bearing_keys(drawn, reading_of_bearing(row), form);
  };
  add_bearing_results(run, family::bearing, study, inputs, closing_angle_keys(drawn));
  add_rating_results(run, study, inputs);
  return {study.at, std::move(run.results), drawn.name};
}
}  // namespace mill
