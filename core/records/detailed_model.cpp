#include "core/records/detailed_model.h"
#include "core/case/errors.h"
#include "core/records/csv_sheet.h"
#include "core/records/files.h"
#include "core/records/matrix_market.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr std::size_t places_of_chain = 6;

std::string cell(const std::string &text)
{
  return text.find(',') == std::string::npos ? text : "\"" + text + "\"";
}

[[noreturn]] void refuse(const std::string &path, const std::string &why)
{
  throw InputError(Place{path}, why);
}

void require_size(const std::string &path, const Eigen::MatrixXd &m, const Eigen::Index rows,
                  const Eigen::Index columns)
{
  if ((rows > 0 && m.rows() != rows) || m.cols() != columns)
    refuse(path, fmt::format("has {} rows and {} columns; {}{} columns are needed", m.rows(), m.cols(),
                             rows > 0 ? fmt::format("{} rows and ", rows) : "", columns));
}

Eigen::MatrixXd symmetric(const std::string &path)
{
  Eigen::MatrixXd m = read_matrix_market(path);
  if (m.rows() != m.cols() || (m - m.transpose()).cwiseAbs().maxCoeff() > 1e-9 * m.cwiseAbs().maxCoeff())
    refuse(path, "is not symmetric; mass and stiffness of a stand are");
  return 0.5 * (m + m.transpose());
}

std::string text_of(const csv::Cell &cell)
{
  return std::string(cell.text);
}

void name_unknown(StandModel &s, const std::string &part, StandUnknown unknown)
{
  const auto known = std::find(s.parts.begin(), s.parts.end(), part);
  s.part_of.push_back(int(known - s.parts.begin()));
  if (known == s.parts.end())
    s.parts.push_back(part);
  s.unknowns.push_back(std::move(unknown));
}

void read_names(const std::string &path, const Eigen::MatrixXd &readings, StandModel &s)
{
  csv::Sheet sheet = csv::sheet_of(path, read_text(path), "of,number,name,coordinate,position [m],direction,unit");
  const auto column = [&](const char *name, const char *unit) { return csv::index_of(sheet, name, unit); };
  const auto of = column("of", ""), name = column("name", ""), coordinate = column("coordinate", ""),
             position = column("position", "m"), unit = column("unit", "");
  std::size_t n = 0;
  for (std::size_t r = 0; r < sheet.n_rows(); ++r) {
    const std::string kind = text_of(sheet.cell(r, of));
    if (kind == "unknown") {
      const csv::Cell &at = sheet.cell(r, position);
      name_unknown(s, text_of(sheet.cell(r, name)),
                   {text_of(sheet.cell(r, coordinate)),
                    at.text.empty() ? std::nan("") : csv::number_of(at, "position", sheet),
                    text_of(sheet.cell(r, unit))});
      continue;
    }
    if (kind != "reading")
      throw InputError(sheet.place(sheet.cell(r, of)), "\"" + kind + "\" is neither \"unknown\" nor \"reading\"");
    if (Eigen::Index(n) >= readings.rows())
      throw InputError(sheet.place(sheet.cell(r, of)),
                       fmt::format("names reading {} of {}", n + 1, readings.rows()));
    if (Eigen::Index(n) + 1 < readings.rows())
      s.points.push_back({text_of(sheet.cell(r, name)), readings.row(Eigen::Index(n))});
    ++n;
  }
  if (Eigen::Index(s.unknowns.size()) != s.M.rows() || Eigen::Index(n) != readings.rows())
    refuse(path, fmt::format("names {} unknowns and {} readings; the matrices have {} and {}", s.unknowns.size(),
                             n, s.M.rows(), readings.rows()));
}
}  // namespace

Eigen::MatrixXd readings_of(const StandModel &stand)
{
  Eigen::MatrixXd rows(Eigen::Index(stand.points.size()) + 1, stand.M.rows());
  for (std::size_t i = 0; i < stand.points.size(); ++i)
    rows.row(Eigen::Index(i)) = stand.points[i].row;
  rows.bottomRows(1) = stand.load_cell.transpose();
  return rows;
}

std::string model_names_csv(const StandModel &stand)
{
  std::string text = "of,number,name,coordinate,position [m],direction,unit\n";
  for (std::size_t i = 0; i < stand.unknowns.size(); ++i) {
    const StandUnknown &u = stand.unknowns[i];
    text += fmt::format("unknown,{},{},{},{},y,{}\n", i + 1, cell(stand.parts[std::size_t(stand.part_of[i])]),
                        cell(u.what), std::isnan(u.position) ? "" : fmt::format("{}", u.position), u.unit);
  }
  for (std::size_t i = 0; i < stand.points.size(); ++i)
    text += fmt::format("reading,{},{},displacement,,y,m\n", i + 1, cell(stand.points[i].name));
  return text + fmt::format("reading,{},load cell,change of force,,y,N\n", stand.points.size() + 1);
}

StandModel detailed_model_of(const ModelFiles &files)
{
  StandModel s;
  s.name               = files.name;
  s.M                  = symmetric(files.mass);
  s.K_parts            = symmetric(files.stiffness);
  const Eigen::Index n = s.M.rows();
  require_size(files.stiffness, s.K_parts, n, n);
  const Eigen::MatrixXd b = read_matrix_market(files.force), readings = read_matrix_market(files.readings);
  require_size(files.force, b, n, 1);
  require_size(files.readings, readings, 0, n);
  if (readings.rows() < Eigen::Index(places_of_chain) + 1)
    refuse(files.readings,
           fmt::format("has {} rows; the six places of M1 to M6 and the load cell are needed", readings.rows()));
  s.b         = b.col(0);
  s.load_cell = readings.bottomRows(1).transpose();
  read_names(files.names, readings, s);
  return s;
}
}  // namespace mill
