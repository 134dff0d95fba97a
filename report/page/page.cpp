#include "report/page/page.h"
#include "report/plot/svg.h"

namespace mill::report {
Page::Page(const Run &run)
    : stamp_("<span class=\"stamp\">" + escaped(run.case_name) +
             (run.manifest.run_id.empty() ? "" : ", run " + escaped(run.manifest.run_id)) + "</span>")
{
}

void Page::section(const std::string &id, const std::string &title)
{
  sections_.emplace_back(id, title);
  body_ += "<h2 id=\"" + escaped(id) + "\"><span class=\"number\">" + std::to_string(sections_.size()) +
           "</span> " + escaped(title) + "</h2>\n";
}

void Page::heading(const std::string &title)
{
  body_ += "<h3>" + escaped(title) + "</h3>\n";
}

void Page::html(const std::string &text)
{
  body_ += text + "\n";
}

void Page::paragraph(const std::string &html)
{
  body_ += "<p>" + html + "</p>\n";
}

void Page::figure(const std::vector<std::string> &drawings, const std::string &caption)
{
  body_ += "<figure>\n<div class=\"drawings\">\n";
  for (const std::string &drawing : drawings)
    body_ += drawing;
  body_ += "</div>\n<figcaption><b>Figure " + std::to_string(++figures_) + ".</b> " + caption + " " + stamp_ +
           "</figcaption>\n</figure>\n";
}

void Page::table(const std::string &table, const std::string &caption)
{
  body_ += "<div class=\"tabled\">\n<p class=\"caption\"><b>Table " + std::to_string(++tables_) + ".</b> " +
           caption + "</p>\n" + table + "</div>\n";
}

void Page::absent(const std::string &what, const std::string &file)
{
  body_ += "<p class=\"absent\">" + escaped(what) + " left out: this run stored no <code>" + escaped(file) +
           "</code>.</p>\n";
}

std::string Page::contents() const
{
  std::string list = "<nav><ol>\n";
  for (const auto &[id, title] : sections_)
    list += "<li><a href=\"#" + escaped(id) + "\">" + escaped(title) + "</a></li>\n";
  return list + "</ol></nav>\n";
}

const std::string &Page::body() const
{
  return body_;
}
}  // namespace mill::report
