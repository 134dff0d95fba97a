#pragma once

/// Texts that the build puts into the library (cmake/embed_text.cmake), so that the program needs no data files.
namespace mill::report::embedded {
extern const char *const page_css;    ///< report/page/page.css
extern const char *const page_js;     ///< report/page/page.js
extern const char *const reading_js;  ///< report/page/reading.js
extern const char
    *const dygraphs_js;  ///< plotting library for zoomable histories; empty when the build found none
extern const char *const dygraphs_css;      ///< its style; empty likewise
extern const char *const dygraphs_licence;  ///< report/dygraphs_licence.txt, kept next to the code it belongs to
}  // namespace mill::report::embedded
