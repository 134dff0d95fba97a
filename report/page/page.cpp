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

namespace {
// Where the first sentence of a caption ends: behind a full stop before a capital letter, outside of tags.
std::size_t end_of_sentence(const std::string &html)
{
  bool tag = false;
  for (std::size_t i = 0; i + 2 < html.size(); ++i) {
    tag                    = html[i] == '<' || (tag && html[i] != '>');
    const std::size_t next = html.substr(i + 2, 3) == "<b>" ? i + 5 : i + 2;
    if (!tag && html[i] == '.' && html[i + 1] == ' ' && next < html.size() && html[next] >= 'A' &&
        html[next] <= 'Z')
      return i + 1;
  }
  return html.size();
}

// One sentence, the others folded behind it.
std::string folded(const std::string &caption)
{
  const std::size_t end = end_of_sentence(caption);
  if (end + 1 >= caption.size())
    return caption;
  return caption.substr(0, end) + " <details class=\"more\"><summary>more</summary>" + caption.substr(end + 1) +
         "</details>";
}
}  // namespace

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
  std::string drawn;
  for (const std::string &drawing : drawings)
    drawn += drawing;
  if (drawn.empty())
    return;
  body_ += "<figure>\n<div class=\"drawings\">\n" + drawn;
  body_ += "</div>\n<figcaption><b>Figure " + std::to_string(++figures_) + ".</b> " + folded(caption) + " " +
           stamp_ + "</figcaption>\n</figure>\n";
}

void Page::table(const std::string &table, const std::string &caption)
{
  if (table.empty())
    return;
  body_ += "<div class=\"tabled\">\n<div class=\"caption\"><b>Table " + std::to_string(++tables_) + ".</b> " +
           folded(caption) + "</div>\n" + table + "</div>\n";
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
