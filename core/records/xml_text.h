#pragma once
#include <string>

namespace mill {
/// Text inside XML, SVG or HTML, between tags or in an attribute: & < > " ' written out.
std::string xml_text(const std::string &text);
}  // namespace mill
