// Text in XML: signs of the language are written out, and what XML 1.0 does not allow (2.2, Char) is replaced.
#include "core/records/xml_text.h"
#include <gtest/gtest.h>

using mill::xml_text;

TEST(XmlText, SignsOfTheLanguageAreWrittenOut)
{
  EXPECT_EQ(xml_text("a < b & 'c' > \"d\""), "a &lt; b &amp; &#39;c&#39; &gt; &quot;d&quot;");
}

TEST(XmlText, CodesThatXmlDoesNotAllowAreReplaced)
{
  EXPECT_EQ(xml_text("a\uFFFFb\uFFFEc"), "a\uFFFDb\uFFFDc");
  EXPECT_EQ(xml_text("\uFFFD \uFFFC \uFF3F"), "\uFFFD \uFFFC \uFF3F") << "the neighbours are allowed";
  EXPECT_EQ(xml_text("cut \xEF\xBF"), "cut \xEF\xBF") << "half of a character at the end";
}
