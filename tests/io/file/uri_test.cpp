#include "io/file/uri.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

TEST(UriTest, PercentsAreDecodedWhereDigitsFollow) {
  EXPECT_EQ(percent_decoded("a%20b%C3%A9%2f"), "a b\xC3\xA9/");
  EXPECT_EQ(percent_decoded("100%"), "100%");
  EXPECT_EQ(percent_decoded("%4"), "%4");
  EXPECT_EQ(percent_decoded("%zz%41"), "%zzA");
}

TEST(UriTest, DataIsDecodedFromBase64WithAndWithoutPadding) {
  EXPECT_EQ(data_uri_bytes("data:;base64,"), "");
  EXPECT_EQ(data_uri_bytes("data:;base64,Zg=="), "f");
  EXPECT_EQ(data_uri_bytes("data:a/b;base64,Zm8="), "fo");
  EXPECT_EQ(data_uri_bytes("DATA:a/b;BASE64,Zm9v"), "foo");
  EXPECT_EQ(data_uri_bytes("data:;base64,Zm9vYg"), "foob");
  EXPECT_EQ(data_uri_bytes("data:;base64,-_%2B%2F"), data_uri_bytes("data:;base64,+/+/"));
  EXPECT_EQ(data_uri_bytes("data:text/plain,a%20b"), "a b");
}

TEST(UriTest, BrokenDataIsNothing) {
  for (const char* const uri : {"data:", "data:;base64", "data:;base64,Z", "data:;base64,Zm9vY",
                                "data:;base64,Zm 9", "data:;base64,Z=g="}) {
    EXPECT_EQ(data_uri_bytes(uri), std::nullopt) << uri;
  }
}

TEST(UriTest, FilesAreFoundDecodedAsSpelledOrWithoutQuery) {
  const TempDir dir;
  const auto found = [&](const char* uri) {
    return file_of_uri(uri, dir.path()).value().filename().string();
  };
  dir.write("a b.bin", "");
  EXPECT_EQ(found("a%20b.bin"), "a b.bin");
  EXPECT_EQ(found("a%20b.bin?v=1#x"), "a b.bin");
  EXPECT_EQ(found("sub\\..\\missing.bin"), "missing.bin");
  dir.write("a%20b.bin?v=1#x", "");
  EXPECT_EQ(found("a%20b.bin?v=1#x"), "a%20b.bin?v=1#x") << "the literal name goes first";
}

TEST(UriTest, WhatHasASchemeOrAZeroByteOrNothingIsNoFile) {
  for (const char* const uri : {"", "https://example.org/a", "file:///a", "a%00b"}) {
    EXPECT_EQ(file_of_uri(uri, "."), std::nullopt) << uri;
  }
  EXPECT_TRUE(file_of_uri("a/b:c", "."));
  EXPECT_TRUE(file_of_uri("C:/a", "."));
}

}  // namespace
}  // namespace atlasgauge
