#include "io/process/message_digest.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace atlasgauge {
namespace {

MessageDigest digest_of(std::string_view text) {
  MessageDigest digest;
  digest.add(text);
  return digest;
}

TEST(MessageDigestTest, NothingIsNothing) {
  const MessageDigest digest = digest_of("");
  EXPECT_EQ(digest.warnings(), 0U);
  EXPECT_TRUE(digest.first_warnings().empty());
  EXPECT_EQ(digest.tail(), "");
}

TEST(MessageDigestTest, OnlyLinesThatBeginSoAreWarnings) {
  const MessageDigest digest = digest_of(
      "warning: a\n warning: b\nwarning:\nno warning: c\n\nwarning: \nwarning: d: warning: e");
  EXPECT_EQ(digest.warnings(), 3U);
  EXPECT_EQ(digest.first_warnings(), (std::vector<std::string>{"a", "", "d: warning: e"}));
}

TEST(MessageDigestTest, TextMayBeCutAtAnyByte) {
  const std::string text =
      "warning: one\nwarningwarning: no\nwar\nwarning: two\natlasgauge: it ends\nwarning: 3";
  for (std::size_t first = 0; first <= text.size(); ++first) {
    for (std::size_t second = first; second <= text.size(); ++second) {
      MessageDigest digest;
      digest.add(text.substr(0, first));
      digest.add(text.substr(first, second - first));
      digest.add(text.substr(second));
      ASSERT_EQ(digest.warnings(), 3U) << first << ' ' << second;
      ASSERT_EQ(digest.first_warnings(), (std::vector<std::string>{"one", "two", "3"}));
      ASSERT_EQ(digest.tail(), text);
    }
  }
}

TEST(MessageDigestTest, AllWarningsCountAndTheFirstAreKept) {
  MessageDigest digest;
  for (int i = 0; i < 1000; ++i) digest.add("warning: " + std::to_string(i) + "\n");
  EXPECT_EQ(digest.warnings(), 1000U);
  ASSERT_EQ(digest.first_warnings().size(), MessageDigest::kMostWarnings);
  EXPECT_EQ(digest.first_warnings().front(), "0");
  EXPECT_EQ(digest.first_warnings().back(), "19");
}

TEST(MessageDigestTest, LongWarningsAreCut) {
  const std::string text(3 * MessageDigest::kMostWarningBytes, 'x');
  MessageDigest digest;
  digest.add("warning: ");
  for (const char byte : text) digest.add(std::string(1, byte));
  digest.add("\nwarning: " + text);
  const std::string kept = text.substr(0, MessageDigest::kMostWarningBytes);
  EXPECT_EQ(digest.first_warnings(), (std::vector<std::string>{kept, kept}));
}

TEST(MessageDigestTest, TailIsTheEndOfAllText) {
  std::string text;
  for (int i = 0; i < 5000; ++i) text += std::to_string(i) + (i % 7 == 0 ? "\n" : " ");
  const std::string end = text.substr(text.size() - MessageDigest::kTailBytes);
  EXPECT_EQ(digest_of(text).tail(), end);
  for (const std::size_t piece : {1U, 100U, 4095U, 4096U, 4097U, 10000U}) {
    MessageDigest digest;
    for (std::size_t at = 0; at < text.size(); at += piece) digest.add(text.substr(at, piece));
    EXPECT_EQ(digest.tail(), end) << piece;
  }
}

}  // namespace
}  // namespace atlasgauge
