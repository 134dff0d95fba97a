#include "core/records/detailed_model.h"
#include "core/base/choice.h"
#include "core/base/csv_sheet.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/records/matrix_market.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr std::size_t places_of_chain    = 6;
constexpr const char *connections_header = "connection,stiffness [N/m],error_estimate";

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
  return symmetric_part(m);
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

// What a row of names.csv names.
enum class NamedRow { unknown, reading };
constexpr auto words_of(NamedRow)
{
  return choice_words<NamedRow>("unknown", "reading");
}

void read_names(const std::string &path, const Eigen::MatrixXd &readings, StandModel &s)
{
  csv::Sheet sheet = csv::sheet_of(path, read_text(path), "of,number,name,coordinate,position [m],direction,unit");
  const auto column = [&](const char *name, const char *unit) { return csv::index_of(sheet, name, unit); };
  const auto owner = column("of", ""), name = column("name", ""), coordinate = column("coordinate", ""),
             position = column("position", "m"), unit = column("unit", "");
  std::size_t n = 0;
  for (std::size_t r = 0; r < sheet.n_rows(); ++r) {
    const std::string word = text_of(sheet.cell(r, owner));
    const auto kind        = choice_named<NamedRow>(word);
    if (kind == NamedRow::unknown) {
      const csv::Cell &cell = sheet.cell(r, position);
      name_unknown(s, text_of(sheet.cell(r, name)),
                   {text_of(sheet.cell(r, coordinate)),
                    cell.text.empty() ? std::nan("") : csv::number_of(cell, "position", sheet),
                    text_of(sheet.cell(r, unit))});
      continue;
    }
    if (!kind)
      throw InputError(sheet.place(sheet.cell(r, owner)),
                       "\"" + word + "\" is neither \"unknown\" nor \"reading\"");
    if (Eigen::Index(n) >= readings.rows())
      throw InputError(sheet.place(sheet.cell(r, owner)),
                       fmt::format("names reading {} of {}", n + 1, readings.rows()));
    if (Eigen::Index(n) + 1 < readings.rows())
      s.points.push_back({text_of(sheet.cell(r, name)), readings.row(Eigen::Index(n))});
    ++n;
  }
  if (Eigen::Index(s.unknowns.size()) != s.M.rows() || Eigen::Index(n) != readings.rows())
    refuse(path, fmt::format("names {} unknowns and {} readings; the matrices have {} and {}", s.unknowns.size(),
                             n, s.M.rows(), readings.rows()));
}

// Springs of one name follow each other; the file has one row for each.
void read_connections(const ModelFiles &files, StandModel &s)
{
  const Eigen::MatrixXd rows = read_matrix_market(files.strains);
  csv::Sheet sheet           = csv::sheet_of(files.connections, read_text(files.connections), connections_header);
  const auto name = csv::index_of(sheet, "connection", ""), stiffness = csv::index_of(sheet, "stiffness", "N/m"),
             error = csv::index_of(sheet, "error_estimate", "");
  require_size(files.strains, rows, Eigen::Index(sheet.n_rows()), s.M.rows());
  for (std::size_t r = 0; r < sheet.n_rows();) {
    const std::string text = text_of(sheet.cell(r, name));
    std::size_t end        = r;
    while (end < sheet.n_rows() && text_of(sheet.cell(end, name)) == text)
      ++end;
    for (const Connection &other : s.connections)
      if (other.name == text)
        throw InputError(sheet.place(sheet.cell(r, name)),
                         "\"" + text + "\" appears in two places; its springs must be consecutive");
    Connection c{text, rows.middleRows(Eigen::Index(r), Eigen::Index(end - r)),
                 Eigen::VectorXd(Eigen::Index(end - r))};
    if (const csv::Cell &cell = sheet.cell(r, error); !cell.text.empty())
      c.error_estimate = csv::number_of(cell, "error_estimate", sheet);
    for (std::size_t k = r; k < end; ++k) {
      const csv::Cell &cell            = sheet.cell(k, stiffness);
      c.stiffness[Eigen::Index(k - r)] = csv::number_of(cell, "stiffness", sheet);
      if (!(c.stiffness[Eigen::Index(k - r)] >= 0))
        throw InputError(sheet.place(cell), "stiffness " + text_of(cell) + " N/m: must not be negative");
    }
    s.connections.push_back(std::move(c));
    r = end;
  }
  // What is left of the matrix are the parts, which have no unknown in common.
  for (const Connection &c : s.connections)
    s.K_parts -= c.rows.transpose() * c.stiffness.asDiagonal() * c.rows;
  const double stiffest = stiffness_of(s).cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < s.K_parts.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      if (s.part_of[std::size_t(i)] != s.part_of[std::size_t(j)]) {
        if (std::abs(s.K_parts(i, j)) > 1e-9 * stiffest)
          refuse(
              files.connections,
              fmt::format("without these springs unknowns {} and {} of two parts are still joined in {}: they are "
                          "not those of this model",
                          j + 1, i + 1, files.stiffness));
        s.K_parts(i, j) = s.K_parts(j, i) = 0;
      }
}
}  // namespace

std::string connections_csv(const StandModel &stand)
{
  std::string text = std::string(connections_header) + "\n";
  for (const Connection &c : stand.connections)
    for (Eigen::Index r = 0; r < c.stiffness.size(); ++r)
      text += fmt::format("{},{},{}\n", cell(c.name), c.stiffness[r],
                          std::isnan(c.error_estimate) ? "" : fmt::format("{}", c.error_estimate));
  return text;
}

Eigen::MatrixXd strains_of(const StandModel &stand)
{
  Eigen::Index rows = 0;
  for (const Connection &c : stand.connections)
    rows += c.rows.rows();
  Eigen::MatrixXd all(rows, stand.M.rows());
  rows = 0;
  for (const Connection &c : stand.connections) {
    all.middleRows(rows, c.rows.rows()) = c.rows;
    rows += c.rows.rows();
  }
  return all;
}

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

ModelFiles named_files(const StandModel &stand, const std::string &folder)
{
  const std::string base = folder + "/" + stand.name;
  ModelFiles files;
  files.name      = stand.name;
  files.mass      = base + "-mass.mtx";
  files.stiffness = base + "-stiffness.mtx";
  files.force     = base + "-force.mtx";
  files.readings  = base + "-readings.mtx";
  files.names     = base + "-names.csv";
  if (!stand.connections.empty()) {
    files.connections = base + "-connections.csv";
    files.strains     = base + "-strains.mtx";
  }
  return files;
}

std::map<std::string, std::string> texts_of(const StandModel &stand, const ModelFiles &files)
{
  const std::string &name = stand.name;
  std::map<std::string, std::string> texts{
      {files.mass,
       matrix_market_text(symmetric_part(stand.M), "mass matrix of model " + name + ", whole stand, kg")},
      {files.stiffness, matrix_market_text(symmetric_part(stiffness_of(stand)),
                                           "stiffness matrix of model " + name + ", whole stand, N/m")},
      {files.force, matrix_market_text(stand.b, "force on each unknown per unit of bite force, model " + name)},
      {files.readings,
       matrix_market_text(readings_of(stand), "places by unknown (m), last row load cell (N), model " + name)},
      {files.names, model_names_csv(stand)}};
  if (!files.connections.empty()) {
    texts[files.connections] = connections_csv(stand);
    texts[files.strains] =
        matrix_market_text(strains_of(stand), "strain of each spring per displacement, model " + name);
  }
  return texts;
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
  if (!files.connections.empty())
    read_connections(files, s);
  return s;
}
}  // namespace mill
