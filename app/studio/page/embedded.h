#pragma once

/// Texts that the build puts into the library (cmake/embed_text.cmake): the files of this folder with the same
/// names, the drawing of the report, and what pages of millstand have in common.
namespace mill::studio::embedded {
extern const char *const index_html;
extern const char *const page_css;
extern const char *const page_js;
extern const char *const state_js;
extern const char *const fields_js;
extern const char *const drawing_js;
extern const char *const answers_js;
extern const char *const variants_js;
extern const char *const curve_js;
extern const char *const stand_to_scale_js;
extern const char *const theme_css;
extern const char *const icon_svg;
}  // namespace mill::studio::embedded
