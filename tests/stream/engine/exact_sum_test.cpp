#include "stream/engine/exact_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "measures/base/archive.hpp"

namespace atlasgauge {
namespace {

using Terms = std::vector<double>;
using boost::multiprecision::cpp_int;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kMax = std::numeric_limits<double>::max();
constexpr double kTiny = std::numeric_limits<double>::denorm_min();

ExactSum sum_of(const Terms& terms) {
  ExactSum sum;
  for (const double term : terms) sum.add(term);
  return sum;
}

/// In units of the smallest double.
cpp_int exact(double term) {
  int exponent = 0;
  const double fraction = std::frexp(term, &exponent);
  const cpp_int mantissa = static_cast<std::int64_t>(std::ldexp(std::abs(fraction), 53));
  const int shift = exponent - 53 + 1074;
  const cpp_int size = shift >= 0 ? cpp_int(mantissa << shift) : cpp_int(mantissa >> -shift);
  return term < 0 ? cpp_int(-size) : size;
}

/// The nearest double, ties to even.
double rounded(const cpp_int& units) {
  if (units == 0) return 0;
  const cpp_int size = abs(units);
  const auto bits = static_cast<int>(msb(size)) + 1;
  if (bits <= 53) {
    const double value = std::ldexp(static_cast<double>(static_cast<std::uint64_t>(size)), -1074);
    return units < 0 ? -value : value;
  }
  const int drop = bits - 53;
  cpp_int kept = size >> drop;
  const cpp_int rest = size - (kept << drop), half = cpp_int(1) << (drop - 1);
  if (rest > half || (rest == half && kept % 2 == 1)) ++kept;
  const double value =
      std::ldexp(static_cast<double>(static_cast<std::uint64_t>(kept)), drop - 1074);
  return units < 0 ? -value : value;
}

double exact_sum(const Terms& terms) {
  cpp_int sum = 0;
  for (const double term : terms) sum += exact(term);
  return rounded(sum);
}

Terms random_terms(std::size_t count, int low_exponent, int high_exponent, bool signs) {
  std::mt19937 random(static_cast<unsigned>(count));
  std::uniform_real_distribution<double> fraction(0.5, 1);
  std::uniform_int_distribution<int> exponent(low_exponent, high_exponent);
  Terms terms;
  for (std::size_t i = 0; i < count; ++i) {
    const double term = std::ldexp(fraction(random), exponent(random));
    terms.push_back(signs && random() % 2 == 0 ? -term : term);
  }
  return terms;
}

Product product_of(double a, double b) {
  return exact_product(a, SplitDouble(a), b, SplitDouble(b));
}

std::vector<std::byte> saved(ExactSum sum) {
  Saver saver;
  saver(sum);
  return saver.bytes();
}

TEST(ExactSumTest, NothingIsZero) {
  EXPECT_EQ(ExactSum().value(), 0);
}

TEST(ExactSumTest, OneTermIsItself) {
  for (const double term : {1.0, -1.0, 0.1, 1e300, -1e-300, kMax, -kMax, kTiny, -kTiny, 0x1p-1022,
                            0x1.fffffffffffffp-1023, 0.0, -0.0}) {
    EXPECT_EQ(sum_of({term}).value(), term);
  }
}

TEST(ExactSumTest, TenTenthsAreOneRoundedOnce) {
  EXPECT_EQ(sum_of(Terms(10, 0.1)).value(), 1.0);
}

TEST(ExactSumTest, CancellationLosesNothing) {
  EXPECT_EQ(sum_of({1e300, 1, -1e300}).value(), 1);
  EXPECT_EQ(sum_of({kMax, kTiny, -kMax}).value(), kTiny);
  EXPECT_EQ(sum_of({1, 1e-20, -1, -1e-20}).value(), 0);
  EXPECT_EQ(sum_of({-1, 1e-20}).value(), -1);
  EXPECT_EQ(sum_of({1e16, 1, 1, -1e16}).value(), 2);
}

TEST(ExactSumTest, SubnormalsAddUp) {
  EXPECT_EQ(sum_of(Terms(1000, kTiny)).value(), 1000 * kTiny);
  EXPECT_EQ(sum_of({0x1p-1022, -kTiny}).value(), 0x1p-1022 - kTiny);
}

TEST(ExactSumTest, MayOverflowOnTheWay) {
  EXPECT_EQ(sum_of({kMax, kMax, kMax, -kMax, -kMax}).value(), kMax);
  EXPECT_EQ(sum_of({kMax, kMax}).value(), kInf);
  EXPECT_EQ(sum_of({-kMax, -kMax}).value(), -kInf);
}

TEST(ExactSumTest, TiesGoToEven) {
  EXPECT_EQ(sum_of({1, 0x1p-53}).value(), 1);
  EXPECT_EQ(sum_of({1, 0x1p-52, 0x1p-53}).value(), 1 + 0x1p-51);
}

TEST(ExactSumTest, TheSmallestTermBreaksATie) {
  for (const double last : {0x1p-60, 0x1p-100, 0x1p-112}) {
    EXPECT_EQ(sum_of({1, 0x1p-53, last}).value(), 1 + 0x1p-52) << last;
    EXPECT_EQ(sum_of({1, 0x1p-53, -last}).value(), 1) << last;
  }
}

TEST(ExactSumTest, TheSmallestTermBreaksATieHoweverSmall) {
  for (const double last : {0x1p-115, 0x1p-130, 0x1p-200, kTiny}) {
    EXPECT_EQ(sum_of({1, 0x1p-53, last}).value(), 1 + 0x1p-52) << last;
    EXPECT_EQ(sum_of({1, 0x1p-52, 0x1p-53, -last}).value(), 1 + 0x1p-52) << last;
  }
}

TEST(ExactSumTest, AgreesWithExactArithmetic) {
  for (const bool signs : {false, true}) {
    for (const Terms& terms :
         {random_terms(3000, -5, 5, signs), random_terms(2000, -1073, 1000, signs),
          random_terms(2500, -1073, -1000, signs), random_terms(1500, 900, 1010, signs)}) {
      EXPECT_EQ(sum_of(terms).value(), exact_sum(terms));
    }
  }
}

TEST(ExactSumTest, ManyTermsOfOneSizeDoNotOverflowTheWindow) {
  // 2^33 is as far up in its window as a term can be.
  for (const double term : {0x1.fffffffffffffp31, -0x1.fffffffffffffp31, 0x1p32, -0x1p0,
                            0x1.fffffffffffffp33, -0x1.fffffffffffffp33}) {
    EXPECT_EQ(sum_of(Terms(5000, term)).value(), 5000 * term);
  }
}

TEST(ExactSumTest, TermsThatTakeTurnsInSizeAreNotLost) {
  Terms terms;
  for (int i = 0; i < 3000; ++i)
    terms.push_back(std::ldexp(i % 2 == 0 ? 3 : -5, 40 * (i % 7) - 120));
  EXPECT_EQ(sum_of(terms).value(), exact_sum(terms));
}

TEST(ExactSumTest, OrderDoesNotMatter) {
  Terms terms = random_terms(5000, -300, 300, true);
  const std::vector<std::byte> bytes = saved(sum_of(terms));
  for (unsigned seed = 0; seed < 5; ++seed) {
    std::shuffle(terms.begin(), terms.end(), std::mt19937(seed));
    EXPECT_EQ(saved(sum_of(terms)), bytes);
  }
}

TEST(ExactSumTest, MillionsOfLargeTermsCarry) {
  ExactSum sum;
  for (int i = 0; i < 3000000; ++i) sum.add(0x1.fffffffffffffp31);
  EXPECT_EQ(sum.value(), exact_sum({3000000 * 0x1p32, -3000000 * 0x1p-21}));
  for (int i = 0; i < 3000000; ++i) sum.add(-0x1.fffffffffffffp31);
  EXPECT_EQ(sum.value(), 0);
}

TEST(ExactSumTest, MergeIsAddition) {
  const Terms terms = random_terms(4000, -500, 500, true);
  for (const std::size_t parts : {1U, 2U, 3U, 7U}) {
    std::vector<ExactSum> partials(parts);
    for (std::size_t i = 0; i < terms.size(); ++i) partials[i % parts].add(terms[i]);
    ExactSum whole;
    for (auto part = partials.rbegin(); part != partials.rend(); ++part) whole.merge(*part);
    EXPECT_EQ(saved(whole), saved(sum_of(terms)));
  }
}

TEST(ExactSumTest, MergeWithItselfDoubles) {
  ExactSum sum = sum_of({1.5, -0.25, 1e-300});
  sum.merge(sum);
  EXPECT_EQ(sum.value(), 2.5);
}

TEST(ExactSumTest, MergingManyTimesDoesNotOverflow) {
  ExactSum whole;
  const ExactSum part = sum_of(Terms(500, 0x1.fffffffffffffp31));
  for (int i = 0; i < 20000; ++i) whole.merge(part);
  EXPECT_EQ(whole.value(), exact_sum({1e7 * 0x1p32, -1e7 * 0x1p-21}));
}

TEST(ExactSumTest, SavedAndLoadedGoesOn) {
  const Terms terms = random_terms(1000, -30, 30, true);
  ExactSum sum = sum_of(terms);
  const std::vector<std::byte> bytes = saved(sum);
  Loader loader(bytes);
  ExactSum again;
  loader(again);
  again.add(3);
  sum.add(3);
  EXPECT_EQ(saved(again), saved(sum));
}

TEST(ExactSumTest, LoadingReplacesWhatWasThere) {
  const std::vector<std::byte> bytes = saved(sum_of({2}));
  Loader loader(bytes);
  ExactSum sum = sum_of({5, kInf});
  loader(sum);
  EXPECT_EQ(sum.value(), 2);
}

TEST(ExactSumTest, NotFiniteIsNaNForEver) {
  for (const double term : {kInf, -kInf, std::nan("")}) {
    ExactSum sum = sum_of({1, term, 2});
    EXPECT_TRUE(std::isnan(sum.value()));
    ExactSum other = sum_of({1});
    other.merge(sum);
    EXPECT_TRUE(std::isnan(other.value()));
  }
}

TEST(ExactSumTest, ProductOfTwoIsExact) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> factor(-1e3, 1e3);
  for (int i = 0; i < 1000; ++i) {
    const double a = factor(random), b = factor(random);
    ExactSum sum;
    sum.add(product_of(a, b));
    sum.add(-(a * b));
    EXPECT_EQ(sum.value(), std::fma(a, b, -(a * b)));
  }
}

TEST(ExactSumTest, ProductOfThreeIsGoodToTwiceADouble) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> factor(-1e3, 1e3);
  for (int i = 0; i < 1000; ++i) {
    const double a = factor(random), b = factor(random), c = factor(random);
    ExactSum sum;
    const Product ab = product_of(a, b);
    sum.add(product_of(ab.high, c));
    sum.add_error(ab.low * c);
    const cpp_int product = exact(a) * exact(b) * exact(c);  // in units of 2^-3222
    const cpp_int found = exact(sum.value()) << (2 * 1074);
    EXPECT_LE(abs(product - found), abs(product) >> 52);
    sum.add(-sum.value());
    const cpp_int rest = exact(sum.value()) << (2 * 1074);
    EXPECT_LE(abs(product - found - rest), abs(product) >> 102);
  }
}

TEST(ExactSumTest, HugeFactorsStayFinite) {
  ExactSum sum;
  sum.add(product_of(1e305, 0.5));
  EXPECT_EQ(sum.value(), 5e304);
}

TEST(ExactSumTest, PreciseKeepsWhatADoubleLoses) {
  const Float128 precise = sum_of({1, 0x1p-100}).precise();
  EXPECT_EQ(static_cast<double>(precise - 1), 0x1p-100);
}

}  // namespace
}  // namespace atlasgauge
