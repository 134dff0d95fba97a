#include "report/page/html.h"
#include "report/models/data.h"
#include "report/page/curves.h"
#include "report/page/embedded.h"
#include "report/page/page.h"
#include "report/page/sections.h"
#include "report/plot/svg.h"

namespace mill::report {
namespace {
// The charts of histories need dygraphs; where the build had none, their static drawings stand alone.
std::string scripts()
{
  using namespace embedded;
  const std::string own = std::string("<script>\n") + page_js + "</script>\n";
  if (!*dygraphs_js)
    return own;
  return std::string("<style>") + dygraphs_css + "</style>\n<script>\n/*\n" + dygraphs_licence + "*/\n" +
         dygraphs_js + "\n</script>\n" + own;
}
}  // namespace

bool has_chain(const Run &run)
{
  return run.manifest.kind != "two-cylinders" && run.manifest.kind != "bearing" &&
         run.manifest.kind != "chatter" && (run.find("M1") || stored_curve(run, curve::modes));
}

std::string html_page(const Run &run)
{
  Page page(run);
  summary_section(page, run);
  stand_section(page, run);
  contact_section(page, run);
  bite_section(page, run);
  chatter_section(page, run, read_chatter(run));
  bearing_section(page, run);
  const ModelData models = read_models(run.directory);
  shape_section(page, run);
  mass_section(page, models);
  model_section(page, run, models);
  mode_section(page, run);
  frequency_section(page, run);
  response_section(page, run);
  limits_section(page, run);
  full_results_section(page, run);
  record_section(page, run);
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
         escaped(run.case_name) + " - millstand report</title>\n<style>\n" + embedded::page_css +
         "</style>\n</head>\n<body>\n<main>\n" + page_head(run) + page.contents() + page.body() + "</main>\n" +
         scripts() + "</body>\n</html>\n";
}

std::string html_report(const std::string &run_directory)
{
  return html_page(read_run(run_directory));
}
}  // namespace mill::report
