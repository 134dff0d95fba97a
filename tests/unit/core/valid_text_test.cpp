// Text from outside becomes valid UTF-8 in one place; a sheet in another encoding gives a case that is valid.
#include "core/base/csv_sheet.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/input_file.h"
#include "core/base/uninterrupted.h"
#include "core/base/valid_text.h"
#include <filesystem>
#include <gtest/gtest.h>

using namespace mill;

TEST(ValidText, Utf8StaysAsItIs)
{
  for (const std::string text : {"", "plain", "Kr\u00e4fte \u00b5m \u20ac", "\U0001F600", "\u0141\u00f3d\u017a"}) {
    EXPECT_TRUE(is_utf8(text)) << text;
    EXPECT_EQ(valid_text(text), text);
  }
}

TEST(ValidText, OtherBytesAreReadAsWindows1252)
{
  EXPECT_EQ(valid_text("Kr\xE4"
                       "fte"),
            "Kr\u00e4fte");
  EXPECT_EQ(valid_text("m/s\xB2"), "m/s\u00b2");
  EXPECT_EQ(valid_text("\x80 \x93"
                       "a\x94 \x96"),
            "\u20ac \u201ca\u201d \u2013");
  EXPECT_EQ(valid_text("\x81"), "\ufffd") << "a byte that Windows-1252 does not use";
}

// The forms that RFC 3629 forbids: overlong, surrogates, beyond U+10FFFF, cut off.
TEST(ValidText, ForbiddenFormsOfUtf8AreNotUtf8)
{
  for (const std::string text : {"\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80",
                                 "\xF0\x80\x80\x80", "\xE2\x82", "\x80", "\xFF", "abcdefgh\xE2"})
    EXPECT_FALSE(is_utf8(text));
}

TEST(ValidText, EveryStringOfBytesBecomesUtf8)
{
  std::uint64_t state = 20261127;
  for (int i = 0; i < 2000; ++i) {
    std::string bytes;
    for (int k = 0; k < i % 40; ++k) {
      state ^= state << 13;
      state ^= state >> 7;
      state ^= state << 17;
      bytes += char(state & 0xFF);
    }
    EXPECT_TRUE(is_utf8(valid_text(bytes))) << i;
    TextEncoding encoding{};
    EXPECT_TRUE(is_utf8(valid_file_text(bytes, encoding))) << i;
    EXPECT_TRUE(is_utf8(valid_file_text("\xFF\xFE" + bytes, encoding))) << i;
  }
}

TEST(ValidText, FilesOfUtf16AndWindowsAreConverted)
{
  TextEncoding encoding{};
  EXPECT_EQ(valid_file_text(std::string("\xFF\xFE"
                                        "a\0\xE4\0",
                                        6),
                            encoding),
            "a\u00e4");
  EXPECT_STREQ(word_of(encoding), "UTF-16 little endian");
  EXPECT_EQ(valid_file_text(std::string("\xFE\xFF"
                                        "\xD8\x3D\xDE\x00",
                                        6),
                            encoding),
            "\U0001F600");
  EXPECT_EQ(valid_file_text("gr\xFC\xDF\nb\n", encoding), "gr\u00fc\u00df\nb\n");
  EXPECT_STREQ(word_of(encoding), "Windows-1252");
}

TEST(ValidText, CellsOfASheetInLatin1AreUtf8)
{
  const auto sheet = csv::sheet_of("sheet.csv", "key,value\npass.0.name,Vorger\xFCst\n", "key, value");
  EXPECT_EQ(sheet.cell(0, 1).text, "Vorger\u00fcst");
  EXPECT_EQ(sheet.notes.at(0), "the file is Windows-1252");
}

TEST(InputFile, AFileLargerThanMemoryIsRefusedWithItsSize)
{
  const std::string path = testing::TempDir() + "millstand_sparse_file";
  write_atomically(path, "");
  std::filesystem::resize_file(path, std::uintmax_t(8) << 40);
  try {
    read_text(path);
    FAIL() << "read";
  } catch (const InputError &error) {
    EXPECT_NE(error.problems.at(0).message.find("has 8.8e+03 GB; reading it takes 1.76e+04 GB of memory"),
              std::string::npos)
        << error.problems.at(0).message;
  }
  std::filesystem::remove(path);
}

TEST(InputFile, ACallThatASignalInterruptsIsMadeAgain)
{
  int calls         = 0;
  const auto number = uninterrupted([&] { return ++calls < 3 ? (errno = EINTR, -1) : 7; });
  EXPECT_EQ(number, 7);
  EXPECT_EQ(calls, 3);
  int opened = 0;
  const int *pointer =
      uninterrupted([&]() -> const int * { return ++opened < 3 ? (errno = EINTR, nullptr) : &opened; });
  EXPECT_EQ(pointer, &opened);
  calls = 0;
  EXPECT_EQ(uninterrupted([&] { return ++calls, errno = ENOENT, -1; }), -1);
  EXPECT_EQ(calls, 1) << "another error is not tried again";
}
