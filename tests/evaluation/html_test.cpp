// SPDX-License-Identifier: BSD-3-Clause
#include "html.h"

#include <gtest/gtest.h>

namespace vmcl {
namespace {

TEST(Html, EscapesText) {
  EXPECT_EQ(escaped("<a href='x'> & \"b\""), "&lt;a href=&#39;x&#39;&gt; &amp; &quot;b&quot;");
}

TEST(Html, QuotesWordsOfACommand) {
  EXPECT_EQ(shellWord("--map=a/b.vmap"), "--map=a/b.vmap");
  EXPECT_EQ(shellWord("two words"), "'two words'");
  EXPECT_EQ(shellWord("it's"), "'it'\\''s'");
  EXPECT_EQ(shellWord(""), "''");
}

TEST(Html, KeepsTheIdsOfPicturesApart) {
  EXPECT_EQ(inlineSvg("<?xml version='1.0'?>\n<svg><g id=\"a\"/><use href='#a'/><path fill='url(#a)'/></svg>", "p1"),
            "<svg><g id=\"p1a\"/><use href='#p1a'/><path fill='url(#p1a)'/></svg>");
}

}  // namespace
}  // namespace vmcl
