#pragma once

/// Texts that the build puts into the library (cmake/embed_text.cmake), so that the program needs no data files;
/// the files of this folder and of twin/web/page with the same names.
namespace mill::live::embedded {
extern const char *const index_html;
extern const char *const theme_css;
extern const char *const page_css;
extern const char *const page_js;
extern const char *const canvas_js;
extern const char *const stand_js;
extern const char *const charts_js;
extern const char *const histories_js;
extern const char *const tables_js;
extern const char *const answers_js;
extern const char *const icon_svg;
}  // namespace mill::live::embedded
