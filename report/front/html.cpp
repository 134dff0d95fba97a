#include "report/front/html.h"
#include "report/chatter/data.h"
#include "report/cluster/figures.h"
#include "report/marks/figures.h"
#include "report/modes/model_data.h"
#include "report/page/curves.h"
#include "report/page/embedded.h"
#include "report/page/page.h"
#include "report/page/sections.h"
#include "report/plot/svg.h"
#include "report/stack/section.h"

namespace mill::report {
namespace {
// The charts of histories need dygraphs; without it only their static drawings are shown.
std::string scripts()
{
  using namespace embedded;
  const std::string name =
      std::string("<script>\n") + page_js + "</script>\n<script>\n" + reading_js + "</script>\n";
  if (!*dygraphs_js)
    return name;
  return std::string("<style>") + dygraphs_css + "</style>\n<script>\n/*\n" + dygraphs_licence + "*/\n" +
         dygraphs_js + "\n</script>\n" + name;
}

// Stays in sight: contents, how much is unfolded, light or dark.  The settings need the script and stay hidden
// without it.
std::string sidebar(const Run &run, const Page &page)
{
  const auto button = [](const std::string &setting, const std::string &value) {
    return "<button type=\"button\" data-" + setting + "=\"" + value + "\">" + value + "</button>";
  };
  std::string depths, themes;
  for (const Depth depth : {Depth::manager, Depth::engineer, Depth::expert})
    depths += button("depth", name_of(depth));
  for (const char *theme : {"light", "dark", "auto"})
    themes += button("theme", theme);
  return "<nav class=\"sidebar\">\n<p class=\"program\">millstand " + escaped(run.manifest.version) +
         "</p>\n<div class=\"settings\" hidden><fieldset><legend>depth</legend>" + depths +
         "</fieldset><fieldset><legend>page</legend>" + themes + "</fieldset></div>\n" + page.contents() +
         "</nav>\n";
}
}  // namespace

bool has_chain(const Run &run)
{
  return run.manifest.kind != KindOfCase::two_cylinders && run.manifest.kind != KindOfCase::bearing &&
         run.manifest.kind != KindOfCase::chatter && (run.find("M1") || stored_curve(run, curve::modes));
}

std::string title_element(const std::string &title)
{
  return "<title>" + escaped(title) + " - millstand report</title>";
}

std::string html_document(const std::string &title, const Run &run, const Page &page, const std::string &head)
{
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
         "style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n" +
         title_element(title) + "\n<style>\n" + embedded::page_css +
         "</style>\n</head>\n<body>\n<div class=\"layout\">\n" + sidebar(run, page) + "<main>\n" + head +
         page.body() + "</main>\n</div>\n" + scripts() + "</body>\n</html>\n";
}

std::string html_page(const Run &run)
{
  Page page(run);
  if (holds_marks(run)) {
    marks_section(page, run);
    full_results_section(page, run);
    record_section(page, run);
    return html_document(run.case_name, run, page, first_screen(run));
  }
  const ModelData models = read_models(run.directory);
  summary_section(page, run, models);
  stand_section(page, run);
  cluster_section(page, run);
  stack_section(page, run);
  schedule_section(page, run);
  contact_section(page, run);
  bite_section(page, run);
  chatter_section(page, run, read_chatter(run));
  bearing_section(page, run);
  shape_section(page, run);
  mass_section(page, models);
  model_section(page, run, models);
  mode_section(page, run);
  frequency_section(page, run);
  response_section(page, run);
  nonlinear_section(page, run);
  limits_section(page, run);
  full_results_section(page, run);
  record_section(page, run);
  return html_document(run.case_name, run, page, first_screen(run));
}

std::string html_report(const std::string &run_directory)
{
  return html_page(read_run(run_directory));
}
}  // namespace mill::report
