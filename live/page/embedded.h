#pragma once

/// Texts that the build puts into the library (cmake/embed_text.cmake), so that the program needs no data files.
namespace mill::live::embedded {
extern const char *const index_html;  ///< live/page/index.html
extern const char *const page_css;    ///< live/page/page.css
extern const char *const page_js;     ///< live/page/page.js
extern const char *const stand_js;    ///< live/page/stand.js
extern const char *const charts_js;   ///< live/page/charts.js
extern const char *const tables_js;   ///< live/page/tables.js
extern const char *const icon_svg;    ///< live/page/icon.svg
}  // namespace mill::live::embedded
