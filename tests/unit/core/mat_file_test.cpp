// MATLAB files of level 5, read back byte by byte as the description of the format says.
#include "core/records/mat_file.h"
#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <stdexcept>

using namespace mill;

namespace {
/// Walks through the data elements of a file.
struct Bytes {
  std::string data;
  std::size_t position = 0;
  template <class Number> Number take()
  {
    Number n;
    if (position + sizeof n > data.size())
      throw std::runtime_error("the file ends too early");
    std::memcpy(&n, data.data() + position, sizeof n);
    position += sizeof n;
    return n;
  }
  /// Content of the next element, which must be of this type; padding is left behind.
  Bytes element(const std::uint32_t type)
  {
    EXPECT_EQ(take<std::uint32_t>(), type);
    const auto n = take<std::uint32_t>();
    Bytes content{data.substr(position, n)};
    EXPECT_EQ(content.data.size(), n);
    position += (n + 7) / 8 * 8;
    return content;
  }
};

struct Array {
  std::uint32_t kind = 0;
  std::int32_t rows = 0, columns = 0;
  std::string name;
  Bytes content;
};

Array array_of(Bytes &file)
{
  Bytes whole = file.element(14), flags = whole.element(6), size = whole.element(5), name = whole.element(1);
  Array a;
  a.kind    = flags.take<std::uint32_t>();
  a.rows    = size.take<std::int32_t>();
  a.columns = size.take<std::int32_t>();
  a.name    = name.data;
  a.content = {whole.data.substr(whole.position)};
  return a;
}
}  // namespace

TEST(MatFile, MatricesAndTextsComeBack)
{
  Eigen::MatrixXd K(2, 3);
  K << 1, 2, 3, -4.5, 1e300, 1. / 3;
  Bytes file{mat_file({{"K", K, {}}, {"names", {}, {"upper frame", "", "x"}}})};
  EXPECT_EQ(file.data.substr(0, 19), "MATLAB 5.0 MAT-file");
  file.position = 124;
  EXPECT_EQ(file.take<std::uint16_t>(), 0x0100);
  EXPECT_EQ(file.data.substr(126, 2), "IM") << "little-endian";
  file.position = 128;

  Array matrix = array_of(file);
  EXPECT_EQ(matrix.kind, 6u);
  EXPECT_EQ(matrix.name, "K");
  ASSERT_EQ(matrix.rows, 2);
  ASSERT_EQ(matrix.columns, 3);
  Bytes values = matrix.content.element(9);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 2; ++i)
      EXPECT_EQ(values.take<double>(), K(i, j));

  Array cell = array_of(file);
  EXPECT_EQ(cell.kind, 1u);
  EXPECT_EQ(cell.name, "names");
  EXPECT_EQ(cell.rows, 3);
  EXPECT_EQ(cell.columns, 1);
  for (const std::string text : {"upper frame", "", "x"}) {
    Array letters = array_of(cell.content);
    EXPECT_EQ(letters.kind, 4u);
    EXPECT_EQ(letters.columns, std::int32_t(text.size()));
    Bytes units = letters.content.element(4);
    std::string read;
    while (units.position < units.data.size())
      read += char(units.take<std::uint16_t>());
    EXPECT_EQ(read, text);
  }
  EXPECT_EQ(file.position, file.data.size());
}

TEST(MatFile, ANameThatMatlabDoesNotAcceptIsAProgrammingError)
{
  for (const char *name : {"", "1K", "a-b", "upper frame"})
    EXPECT_THROW(mat_file({{name, Eigen::MatrixXd::Zero(1, 1), {}}}), std::logic_error) << name;
}
