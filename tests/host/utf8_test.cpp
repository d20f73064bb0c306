/// Text becomes UTF-8, whatever its bytes (engine/base/utf8.h).
#include "engine/base/utf8.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/base/json_text.h"

namespace splatray {
namespace {

TEST(Utf8, WhatIsUtf8Stays) {
  for (const std::string text :
       {"", "plain",
        "Stra\xC3\x9F"
        "e",
        "\xE2\x82\xAC 5", "\xF0\x9F\x8F\xA0", "\xEF\xBB\xBFmark", "\xF4\x8F\xBF\xBF"}) {
    EXPECT_TRUE(is_utf8(text)) << text;
    EXPECT_EQ(to_utf8(text), text);
  }
}

TEST(Utf8, OtherBytesAreLatin1) {
  EXPECT_EQ(to_utf8("Stra\xDF"
                    "e"),
            "Stra\xC3\x9F"
            "e");
  EXPECT_EQ(to_utf8("\xE4\xF6\xFC"), "\xC3\xA4\xC3\xB6\xC3\xBC");
  EXPECT_EQ(to_utf8("\xE2\x82\xAC and \xFC"), "\xE2\x82\xAC and \xC3\xBC") << "what is UTF-8 of it stays";
}

/// Every text of up to three bytes of each kind becomes UTF-8 that a second call leaves alone.
TEST(Utf8, AllBytesBecomeUtf8) {
  const std::string kinds = "\x41\x7F\x80\x8F\x90\x9F\xA0\xBF\xC1\xC2\xDF\xE0\xED\xEF\xF0\xF4\xF5\xFF";
  for (const char a : kinds)
    for (const char b : kinds)
      for (const char c : kinds) {
        const std::string text = to_utf8(std::string{a, b, c});
        EXPECT_TRUE(is_utf8(text));
        EXPECT_EQ(to_utf8(text), text);
        EXPECT_NO_THROW((void)nlohmann::json(text).dump()) << "JSON's own rule is the same";
      }
  for (const char* bad :
       {"\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF8\x88\x80\x80\x80"})
    EXPECT_FALSE(is_utf8(bad));
}

TEST(Utf8, CharactersThatAreCutAreFound) {
  const std::string home = "\xF0\x9F\x8F\xA0";
  for (std::size_t cut = 1; cut < 4; ++cut) EXPECT_EQ(cut_utf8_bytes("a" + home.substr(0, cut)), cut);
  EXPECT_EQ(cut_utf8_bytes("a" + home), 0U);
  EXPECT_EQ(cut_utf8_bytes("a\xE4"), 1U) << "it may go on";
  EXPECT_EQ(cut_utf8_bytes("\xE4 "), 0U);
  EXPECT_EQ(cut_utf8_bytes("\xE0\x80"), 0U) << "an overlong form goes on nowhere";
}

TEST(Utf8, MessagesAndJsonHoldOnlyUtf8) {
  EXPECT_EQ(std::string(Error(ExitCode::failed,
                              "stra\xDF"
                              "e\n")
                            .what()),
            "stra\xC3\x9F"
            "e?");
  EXPECT_EQ(json_text(nlohmann::json{{"a", "\xDF"}}), "{\"a\":\"\xEF\xBF\xBD\"}");
}

}  // namespace
}  // namespace splatray
