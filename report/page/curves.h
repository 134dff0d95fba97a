#pragma once
#include "core/records/result_names.h"
#include "report/page/run.h"
#include "report/plot/svg_plot.h"
#include <Eigen/Core>
#include <string>
#include <vector>

// From stored tables to lines of a diagram.  The unit in the header of a column decides about the conversion, so
// that the unit at the axis is true whatever unit the file was written in.
namespace mill::report {
class Page;

/// A column and the unit in which it is wanted.
struct Column {
  std::string name;
  std::string unit;  ///< "kN", "µm", "µm/MN", "-"
};

/// Factor from one unit to another of the same dimension; NaN when the program knows no such conversion.
double factor_between(const std::string &from, const std::string &to);

/// The first quantity of the operating point of a result that has the dimension of the unit, in that unit; NaN
/// when none has.
double quantity_at(const Result &result, const std::string &unit);

/// (n) in the wanted unit; (0) when the column is absent or its unit is of another dimension.
Eigen::VectorXd values_of(const Table &table, const Column &column);

/// Adds a line when both columns are there; false when not.
bool add_line(Plot &plot, const Table &table, const Column &x, const Column &y, const std::string &label, Pen pen,
              bool markers = false);

/// One curve of a run; nullptr when not stored.
const Table *stored_curve(const Run &run, const CurveKind &kind, const std::string &item = "",
                          const std::string &owner = "");

struct StoredCurve {
  const CurveKind *kind;
  const Table *table;
};
/// The curves of one item that share a figure, as far as they are stored, in the order of curve::all.
std::vector<StoredCurve> curves_in(const Run &run, Figure figure, const std::string &family,
                                   const std::string &item);

/// The contacts or bearings that the run stored a curve of.
/// @param kind  the one without an ending
std::vector<std::string> items_of(const Run &run, const CurveKind &kind);

/// Every column of a curve over the first one, those of one unit in one drawing.
std::vector<std::string> plain_drawings(const CurveKind &kind, const Table &table);

/// The curves of an item that have a plain figure of their own (Figure::own).
void own_figures(Page &page, const Run &run, const std::string &family, const std::string &item);

/// y at one x, straight between the samples over ln x, exact on a logarithmic curve; NaN outside the samples.
/// @param x  (n) increasing, > 0
double interpolated(const Eigen::VectorXd &x, const Eigen::VectorXd &y, double position);
}  // namespace mill::report
