// Text from a file on its way to a terminal or a log.
#include "core/base/errors.h"
#include "core/base/visible_text.h"
#include "core/case/fields.h"
#include <gtest/gtest.h>

using namespace mill;

TEST(VisibleText, PlainTextOfAnyLanguageStays)
{
  for (const char *text : {"", "K3 = 4.02e10 N/m",
                           "Stra\xc3\x9f"
                           "e \xe8\xbd\xa7\xe6\x9c\xba \xf0\x9d\x9c\x8e",
                           "a\tb\nc"})
    EXPECT_EQ(visible(text), text);
  EXPECT_EQ(visible("a\tb\nc\r", true), "a\\tb\\nc\\r");
}

TEST(VisibleText, ControlCharactersAreWrittenOut)
{
  EXPECT_EQ(visible("\x1b[2J\x07\x7f"), "\\x1b[2J\\x07\\x7f");
  EXPECT_EQ(visible(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(visible("\xc2\x9b"
                    "31m"),
            "\\u009b31m")
      << "control sequence introducer in one character";
  EXPECT_EQ(visible("\xe2\x80\xae"
                    "abc\xe2\x81\xa9"),
            "\\u202eabc\\u2069")
      << "right-to-left override";
}

TEST(VisibleText, ATextOfTomlHasNoCharacterThatATerminalObeys)
{
  EXPECT_EQ(quoted("a \"b\" \\ \xc3\xa9"), "\"a \\\"b\\\" \\\\ \xc3\xa9\"");
  EXPECT_EQ(quoted("\x1b\t\x7f"), "\"\\u001B\\u0009\\u007F\"");
  EXPECT_EQ(quoted("\xe2\x80\xae"
                   "abc\xc2\x9b"),
            "\"\\u202Eabc\\u009B\"");
}

TEST(VisibleText, BytesThatAreNotUtf8AreWrittenOut)
{
  EXPECT_EQ(visible("\xff\xc3"), "\\xff\\xc3");
  EXPECT_EQ(visible("\xc0\x9b"), "\\xc0\\x9b") << "longer form of the escape character";
  EXPECT_EQ(visible("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half of a surrogate pair";
  EXPECT_EQ(visible("\xe2\x80"), "\\xe2\\x80") << "the text ends inside a character";
}

TEST(VisibleText, AnErrorShowsWhatItQuotesInOneLine)
{
  EXPECT_STREQ(InputError("the key 'a\n\x1b[31m' is unknown").what(), "error: the key 'a\\n\\x1b[31m' is unknown");
}
