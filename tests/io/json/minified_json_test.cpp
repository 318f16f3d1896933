#include "io/json/minified_json.hpp"

#include <gtest/gtest.h>

namespace atlasgauge {
namespace {

TEST(MinifiedJsonTest, BlanksBetweenValuesGo) {
  EXPECT_EQ(minified_json(" {\n\t\"a\" : [ 1 , 2.50 ] }\r\n"), "{\"a\":[1,2.50]}");
}

TEST(MinifiedJsonTest, StringsStayAsTheyAre) {
  EXPECT_EQ(minified_json(R"({ "a b" : "c \" d \\" , "e" : "\\\" f" })"),
            R"({"a b":"c \" d \\","e":"\\\" f"})");
}

TEST(MinifiedJsonTest, AByteOrderMarkGoes) {
  EXPECT_EQ(minified_json("\xEF\xBB\xBF{ }"), "{}");
}

}  // namespace
}  // namespace atlasgauge
