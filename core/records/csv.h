#pragma once
#include "core/base/each_member.h"
#include <Eigen/Core>
#include <string>
#include <vector>

namespace mill {
/// A numeric table with "name [unit]" headers, as this program writes it.
struct Table {
  std::vector<std::string> names;        ///< without unit
  std::vector<std::string> units;        ///< as text, "" for a pure number
  std::vector<Eigen::VectorXd> columns;  ///< all of one length
  Table &add(std::string name, std::string unit, Eigen::VectorXd column);
  const Eigen::VectorXd *column(const std::string &name) const;  ///< nullptr when absent
};

template <class Io, class R, if_record<R, Table> = 0> void each_member(Io &&io, R &record)
{
  auto &[names, units, columns] = record;
  io("names", names);
  io("units", units);
  io("columns", columns);
}

/// Text of a table: commas, 17 digits at most, '\n', header "name [unit]" in quotes where RFC 4180 wants them.  A
/// number that is not finite is an empty cell.
std::string csv_text(const Table &table);
/// Does read_table() give back every bit of what csv_text() makes of this table?  Not where a number is infinite
/// or beyond what a cell may hold, or a name has to be written in another way.
bool reads_back(const Table &table);
/// Reads a file that csv_text wrote.  @throws InputError
Table read_table(const std::string &path);

/// A text between quotation marks as a cell of CSV; its own quotation marks are doubled.
std::string quoted_cell(const std::string &text);
}  // namespace mill
