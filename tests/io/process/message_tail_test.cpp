#include "io/process/message_tail.hpp"

#include <gtest/gtest.h>

#include <string>

namespace atlasgauge {
namespace {

std::string tail_of(const std::string& text, std::size_t cut) {
  MessageTail tail;
  for (std::size_t at = 0; at < text.size(); at += cut) tail.add(text.substr(at, cut));
  return tail.text();
}

TEST(MessageTailTest, AShortTextIsKeptWhole) {
  EXPECT_EQ(MessageTail().text(), "");
  EXPECT_EQ(tail_of("warning: a\natlasgauge: b\n", 3), "warning: a\natlasgauge: b\n");
}

TEST(MessageTailTest, OfALongTextTheEndIsKeptHoweverItIsCut) {
  std::string text;
  for (int i = 0; i < 10000; ++i) text += std::to_string(i);
  for (const std::size_t cut : {1U, 7U, 4095U, 4096U, 4097U, 8192U, 100000U}) {
    EXPECT_EQ(tail_of(text, cut), text.substr(text.size() - MessageTail::kBytes)) << cut;
  }
}

}  // namespace
}  // namespace atlasgauge
