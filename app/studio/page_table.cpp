#include "app/studio/page/embedded.h"
#include "app/studio/studio.h"

namespace mill::studio {
namespace {
constexpr std::size_t largest_case = 1 << 20;  // bytes of a body that holds a case or a sheet

web::PageRoute get(const char *path)
{
  web::PageRoute route;
  route.path = path;
  return route;
}

web::PageRoute post(const char *path, const bool slow, const std::size_t body = 64 << 10)
{
  web::PageRoute route;
  route.path   = path;
  route.method = "POST";
  route.slow   = slow;
  route.body   = body;
  return route;
}

web::PageRoute events()
{
  web::PageRoute route = get("/events");
  route.query_token    = true;
  route.events         = true;
  return route;
}

web::PageRoute files_of_runs()
{
  web::PageRoute route = get("/run");
  route.query_token    = true;  // a browser opens a report without headers
  route.below          = true;
  return route;
}
}  // namespace

const web::PageTable &page_table()
{
  static const char *const script = "text/javascript; charset=utf-8", *const style = "text/css; charset=utf-8";
  static const web::PageTable table{
      {{"/", "text/html; charset=utf-8", embedded::index_html},
       {"/page.css", style, embedded::page_css},
       {"/theme.css", style, embedded::theme_css},
       {"/page.js", script, embedded::page_js},
       {"/state.js", script, embedded::state_js},
       {"/fields.js", script, embedded::fields_js},
       {"/drawing.js", script, embedded::drawing_js},
       {"/stand_to_scale.js", script, embedded::stand_to_scale_js},
       {"/answers.js", script, embedded::answers_js},
       {"/variants.js", script, embedded::variants_js},
       {"/curve.js", script, embedded::curve_js},
       {"/icon.svg", "image/svg+xml", embedded::icon_svg}},
      {get("/schema"), get("/document"), events(), post("/edit", true, largest_case),
       post("/check", true, largest_case), post("/quick", true), post("/sweep", true), post("/run", false),
       post("/save", false), post("/compare", true), files_of_runs()}};  // /run itself is the command above
  return table;
}
}  // namespace mill::studio
