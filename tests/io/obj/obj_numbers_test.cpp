#include "io/obj/obj_numbers.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

namespace atlasgauge {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A word with what must follow it.
std::string line_of(const std::string& word) {
  return word + '\n' + std::string(kReadAheadBytes, '9');
}

double double_of(const std::string& word) {
  double value = 0;
  const std::string text = line_of(word);
  EXPECT_EQ(read_double(text.data(), value), text.data() + word.size()) << word;
  return value;
}

float float_of(const std::string& word) {
  float value = 0;
  const std::string text = line_of(word);
  EXPECT_EQ(read_float(text.data(), value), text.data() + word.size()) << word;
  return value;
}

bool is_double(const std::string& word) {
  double value = 0;
  const std::string text = line_of(word);
  return read_double(text.data(), value) != nullptr;
}

std::int64_t index_of(const std::string& word) {
  std::int64_t value = 0;
  const std::string text = line_of(word);
  EXPECT_EQ(read_index(text.data(), value), text.data() + word.size()) << word;
  return value;
}

bool is_index(const std::string& word) {
  std::int64_t value = 0;
  const std::string text = line_of(word);
  return read_index(text.data(), value) != nullptr;
}

/// Decimal texts of every shape: digits, point and exponent where they may stand.
class RandomNumbers {
 public:
  std::string next() {
    std::string text = pick(3) == 0 ? "-" : pick(9) == 0 ? "+" : "";
    const std::size_t whole = pick(2) == 0 ? pick(4) : pick(25);
    text += digits(whole);
    if (pick(6) != 0 || whole == 0) text += "." + digits(pick(2) == 0 ? 6 : 1 + pick(25));
    if (pick(5) == 0) text += exponent();
    return text;
  }

 private:
  std::string digits(std::size_t count) {
    std::string text;
    while (text.size() < count) text += static_cast<char>('0' + pick(10));
    return text;
  }

  std::string exponent() {
    const char* const signs[] = {"e", "E", "e-", "e+", "e0", "e-00"};
    return signs[pick(6)] + std::to_string(pick(pick(4) == 0 ? 400 : 30));
  }

  std::size_t pick(std::size_t n) { return random_() % n; }

  std::mt19937_64 random_{7};
};

TEST(ObjNumbersTest, DoublesEqualStrtod) {
  RandomNumbers numbers;
  for (int i = 0; i < 300000; ++i) {
    const std::string text = numbers.next();
    const double expected = std::strtod(text.c_str(), nullptr) + 0.0;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(double_of(text)), std::bit_cast<std::uint64_t>(expected))
        << text;
  }
}

TEST(ObjNumbersTest, FloatsEqualStrtof) {
  RandomNumbers numbers;
  for (int i = 0; i < 300000; ++i) {
    const std::string text = numbers.next();
    const float expected = std::strtof(text.c_str(), nullptr) + 0.0F;
    ASSERT_EQ(std::bit_cast<std::uint32_t>(float_of(text)), std::bit_cast<std::uint32_t>(expected))
        << text;
  }
}

TEST(ObjNumbersTest, SixDecimalsEqualStrtodAndStrtof) {
  for (int i = 0; i <= 1000000; i += 7) {
    std::string text = std::to_string(i + 1000000);
    text = text.substr(0, 1) + "." + text.substr(1);
    ASSERT_EQ(double_of(text), std::strtod(text.c_str(), nullptr)) << text;
    ASSERT_EQ(float_of(text), std::strtof(text.c_str(), nullptr)) << text;
  }
}

TEST(ObjNumbersTest, FloatsAreRoundedOnce) {
  // Just above half way between 1 and the next float; as a double it is exactly half way.
  const std::string text = "1.00000005960464477540";
  EXPECT_EQ(float_of(text), std::nextafter(1.0F, 2.0F));
  EXPECT_EQ(float_of("1.000000059604644775390625"), 1.0F);
}

TEST(ObjNumbersTest, SignsPointsAndExponentsMayStandAnywhereLegal) {
  EXPECT_EQ(double_of("+1.5"), 1.5);
  EXPECT_EQ(double_of("-.5"), -0.5);
  EXPECT_EQ(double_of(".5"), 0.5);
  EXPECT_EQ(double_of("1."), 1.0);
  EXPECT_EQ(double_of("2.e1"), 20.0);
  EXPECT_EQ(double_of(".8e-001"), 0.08);
  EXPECT_EQ(double_of("-.7e+02"), -70.0);
  EXPECT_EQ(double_of("1E2"), 100.0);
}

TEST(ObjNumbersTest, OutOfRangeBecomesInfinityOrZero) {
  EXPECT_EQ(double_of("1e999"), kInfinity);
  EXPECT_EQ(double_of("-1e999"), -kInfinity);
  EXPECT_EQ(double_of("1e-999"), 0.0);
  EXPECT_EQ(float_of("1e39"), std::numeric_limits<float>::infinity());
  EXPECT_EQ(double_of("1e39"), 1e39);
}

TEST(ObjNumbersTest, NegativeZeroBecomesZero) {
  for (const char* text : {"-0", "-0.0", "-0e5", "-1e-999", "-.0"}) {
    EXPECT_FALSE(std::signbit(double_of(text))) << text;
    EXPECT_FALSE(std::signbit(float_of(text))) << text;
  }
}

TEST(ObjNumbersTest, InfinityIsANumber) {
  for (const char* text : {"inf", "Inf", "+INF", "infinity", "1.#INF", "1.#INF00", "+1.#INF"}) {
    EXPECT_EQ(double_of(text), kInfinity) << text;
    EXPECT_EQ(float_of(text), std::numeric_limits<float>::infinity()) << text;
  }
  for (const char* text : {"-inf", "-INFINITY", "-1.#INF", "-1.#INF00e+000"}) {
    EXPECT_EQ(double_of(text), -kInfinity) << text;
  }
}

TEST(ObjNumbersTest, NotANumberIsANumber) {
  for (const char* text : {"nan", "NaN", "-nan", "+NAN", "nan(ind)", "1.#IND", "-1.#IND00",
                           "1.#QNAN", "-1.#QNAN", "1.#SNAN"}) {
    EXPECT_TRUE(std::isnan(double_of(text))) << text;
    EXPECT_TRUE(std::isnan(float_of(text))) << text;
  }
}

TEST(ObjNumbersTest, OtherWordsAreNoNumbers) {
  for (const char* text :
       {"",    "-",      "+",    ".",   "e5",   "1e",   "1e+", "1x",      "1..2", "1.2.3", "--1",
        "+-1", "3.1+e2", "0x10", "1,5", "infi", "nano", "1.#", "1.#INFX", "1#",   "#",     "1/2"}) {
    EXPECT_FALSE(is_double(text)) << text;
  }
}

TEST(ObjNumbersTest, IndicesEndAtASlashOrABlank) {
  std::int64_t value = 0;
  const std::string text = line_of("-12/3");
  EXPECT_EQ(read_index(text.data(), value), text.data() + 3);
  EXPECT_EQ(value, -12);
  EXPECT_EQ(index_of("+7"), 7);
  EXPECT_EQ(index_of("0000000000000000000000042"), 42);
}

TEST(ObjNumbersTest, IndicesTooLargeFor64BitsStayTooLarge) {
  EXPECT_EQ(index_of("9223372036854775807"), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(index_of("9223372036854775808"), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(index_of("99999999999999999999999999"), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(index_of("-99999999999999999999999999"), -std::numeric_limits<std::int64_t>::max());
}

TEST(ObjNumbersTest, OtherWordsAreNoIndices) {
  for (const char* text : {"", "-", "+", "x", "1x", "1.5", "1e3", "--1", "nan"}) {
    EXPECT_FALSE(is_index(text)) << text;
  }
}

}  // namespace
}  // namespace atlasgauge
