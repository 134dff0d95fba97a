#include "core/model/lumped.h"
#include "app/kinds/manifest_parts.h"
#include "app/kinds/mark_sources.h"
#include "app/kinds/pipeline.h"
#include "app/review/case_review.h"
#include "app/run/run_kind.h"
#include "app/trace/closed_form_chain.h"
#include "core/model/case.h"
#include <filesystem>
#include <nlohmann/json.hpp>

namespace mill {
namespace {
std::string lumped_refusal(const Case &the_case, const Verb verb)
{
  if (verb != Verb::chatter)
    return "";
  return "a lumped model alone cannot chatter: it has no strip (" + the_case.path +
         "); write a case of kind = \"chatter\" whose [stand] has from = \"" +
         std::filesystem::path(the_case.path).filename().string() + "\"";
}
}  // namespace

const RunKind &run_kind(const Lumped &)
{
  static const RunKind kind = [] {
    RunKind k;
    k.verbs   = {Verb::run, Verb::modes, Verb::simulate};
    k.refusal = lumped_refusal;
    k.review  = review_lumped;
    k.stages  = [](const Case &) -> std::vector<std::pair<std::string, double>> { return {{"passes", 1}}; };
    k.files   = [](const Case &the_case) {
      const ModelFiles &m = std::get<Lumped>(the_case.spec).model;
      std::vector<std::string> files{m.mass, m.stiffness, m.force, m.readings, m.names};
      if (!m.connections.empty())
        files.insert(files.end(), {m.connections, m.strains});
      return files;
    };
    k.run = [](RunContext &run, const Goal goal, const std::string &force_file) {
      run_lumped(run, std::get<Lumped>(run.the_case.spec), goal, force_file);
    };
    k.driven = [](RunContext &run, const std::string &pass) {
      return driven_lumped(run, std::get<Lumped>(run.the_case.spec), pass);
    };
    k.mark_sources = [](const Case &the_case) { return mark_sources(std::get<Lumped>(the_case.spec)); };
    k.describe     = [](const Case &the_case, nlohmann::ordered_json &manifest) {
      const auto &lumped = std::get<Lumped>(the_case.spec);
      add_passes(manifest, lumped.passes, lumped.dynamics.force_meaning);
    };
    k.trace = [](const Case &the_case, ClosedFormMemory &memory, const std::map<std::string, double> &) {
      return closed_form_lumped(the_case, memory);
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
