#pragma once
#include "report/page/run.h"
#include <string>

namespace mill::report {
/// The report of a run as one HTML page that opens anywhere: no network, no other file, style, drawings and charts
/// inside.  Made only from what is stored in the run directory, so that it can be written again at any time.
///
/// @param run_directory  folder with results.json; run.json, curves/ and response/ as far as they are there
/// @return               UTF-8 text of report.html; below 3 MB for two passes of 200 000 samples
/// @throws InputError    no results.json, or one that cannot be read
/// Cost: reading the tables; the page itself takes some 50 ms.
std::string html_report(const std::string &run_directory);

/// Title of a page as it stands in its head; by it a page of this program is recognised.
std::string title_element(const std::string &title);

class Page;
/// A page around sections that are complete: style, contents, scripts.
/// @param title  of the browser's window
/// @param head   HTML above the sections
std::string html_document(const std::string &title, const Run &run, const Page &page, const std::string &head);

/// html_report() of a run that has been read already.
std::string html_page(const Run &run);
}  // namespace mill::report
