#include "report/page/page.h"
#include "report/plot/svg.h"

namespace mill::report {
const char *name_of(const Depth depth)
{
  switch (depth) {
  case Depth::manager:
    return "manager";
  case Depth::engineer:
    return "engineer";
  case Depth::expert:
    return "expert";
  }
  return "";
}

Page::Page(const Run &run)
    : stamp_("<span class=\"stamp\">" + escaped(run.case_name) +
             (run.manifest.run_id.empty() ? "" : ", run " + escaped(run.manifest.run_id)) + "</span>")
{
}

void Page::section(const std::string &id, const std::string &title, const Depth depth)
{
  body_ += sections_.empty() ? "" : "</details>\n";
  sections_.push_back({id, title, depth});
  body_ += "<details class=\"part\" id=\"" + escaped(id) + "\" data-depth=\"" + name_of(depth) + "\"" +
           (depth == Depth::expert ? "" : " open") + ">\n<summary><h2><span class=\"number\">" +
           std::to_string(sections_.size()) + "</span> " + escaped(title) + "</h2></summary>\n";
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
  std::string list = "<ol>\n";
  for (const Heading &section : sections_)
    list += "<li><a href=\"#" + escaped(section.id) + "\">" + escaped(section.title) + "</a></li>\n";
  return list + "</ol>\n";
}

std::string Page::body() const
{
  return body_ + (sections_.empty() ? "" : "</details>\n");
}
}  // namespace mill::report
