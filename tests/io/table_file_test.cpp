#include "io/table_file.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

using Names = std::vector<std::string>;
using Row = std::vector<TableValue>;

constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

class TableFileTest : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return (dir_.path() / name).string(); }

  std::string written(const std::string& name, const Names& columns,
                      const std::vector<Row>& rows) const {
    TableFile table(file(name), columns);
    for (const Row& row : rows) table.append(row);
    table.commit();
    return content_of(file(name));
  }

  TempDir dir_;
};

TEST_F(TableFileTest, CsvHasAHeaderAndALineForARow) {
  EXPECT_EQ(written("t.csv", {"number", "area", "name"},
                    {{std::uint64_t{7}, 0.5, std::string_view("wood")},
                     {kLeast, -4.0, std::string_view("stone")}}),
            "number,area,name\n7,0.5,wood\n-9223372036854775808,-4.0,stone\n");
}

TEST_F(TableFileTest, JsonLinesHasAnObjectForARow) {
  EXPECT_EQ(written("t.jsonl", {"number", "area", "name"},
                    {{kMost, 1e300, std::string_view("wood")}, {kLeast, 2.0, std::string_view()}}),
            "{\"number\":18446744073709551615,\"area\":1e+300,\"name\":\"wood\"}\n"
            "{\"number\":-9223372036854775808,\"area\":2.0,\"name\":\"\"}\n");
}

TEST_F(TableFileTest, MissingValuesAndNumbersThatAreNotFiniteAreEmptyOrNull) {
  const Row row{{}, kInfinity, kNotANumber, -kInfinity};
  const Names columns{"a", "b", "c", "d"};
  EXPECT_EQ(written("t.csv", columns, {row}), "a,b,c,d\n,,,\n");
  EXPECT_EQ(written("t.ndjson", columns, {row}), "{\"a\":null,\"b\":null,\"c\":null,\"d\":null}\n");
}

TEST_F(TableFileTest, TableWithoutRowsHasItsColumnsInCsv) {
  EXPECT_EQ(written("t.csv", {"a", "b,c"}, {}), "a,\"b,c\"\n");
  EXPECT_EQ(written("t.jsonl", {"a", "b"}, {}), "");
}

TEST_F(TableFileTest, EmptyTextIsNotAMissingOneInCsv) {
  EXPECT_EQ(written("t.csv", {"a", "b"}, {{std::string_view(), {}}}), "a,b\n\"\",\n");
}

/// Texts that a careless writer would break the table with.
const Names kHostileTexts = {"plain",         "a,b",      "say \"hi\"", "two\nlines",
                             "two\r\nlines",  "\r",       "\"",         ",",
                             " blank ",       "tab\t",    "back\\",     "\x01\x1F\x7F",
                             "K\xC3\xB6rper", "=1+1",     "null",       "../../x",
                             "\xE2\x80\xA8",  "{\"a\":1}"};

TEST_F(TableFileTest, HostileTextsReadBackFromJson) {
  std::vector<Row> rows;
  for (const std::string& text : kHostileTexts) rows.push_back({std::string_view(text)});
  std::istringstream lines(written("t.jsonl", {"te\"xt"}, rows));
  for (const std::string& text : kHostileTexts) {
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(nlohmann::json::parse(line).at("te\"xt"), text);
  }
}

TEST_F(TableFileTest, HostileTextsReadBackFromCsv) {
  std::vector<Row> rows;
  for (const std::string& text : kHostileTexts) rows.push_back({std::string_view(text), 1.5});
  written("t.csv", {"te\"xt", "x"}, rows);
  const ProgramResult result = run_program(
      "/usr/bin/env",
      {"python3", "-c",
       "import csv, json, sys\n"
       "with open(sys.argv[1], newline='', encoding='utf-8') as file:\n"
       "    print(json.dumps([row[0] for row in csv.reader(file, strict=True) if row[1]]))",
       file("t.csv")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  Names wanted = kHostileTexts;
  wanted.insert(wanted.begin(), "te\"xt");
  EXPECT_EQ(nlohmann::json::parse(result.out).get<Names>(), wanted);
}

TEST_F(TableFileTest, TextThatIsNotUtf8IsStillJson) {
  const std::string text = written("t.jsonl", {"a"}, {{std::string_view("x\xFF\xC3(y")}});
  EXPECT_EQ(nlohmann::json::parse(text).at("a"), "x\xEF\xBF\xBD\xEF\xBF\xBD(y");
  EXPECT_EQ(written("t.csv", {"a"}, {{std::string_view("x\xFFy")}}), "a\nx\xFFy\n");
}

TEST_F(TableFileTest, DoublesReadBackToTheSameBits) {
  std::vector<double> values = {0.0,  -0.0,  0.1,     1.0 / 3,
                                1e22, 1e-22, 5e-324,  std::numeric_limits<double>::max(),
                                1e15, 1e16,  123456.0};
  std::mt19937_64 random(1);
  while (values.size() < 2000) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) values.push_back(value);
  }
  std::vector<Row> rows;
  for (const double value : values) rows.push_back({value});
  std::istringstream csv(written("t.csv", {"a"}, rows)), json(written("t.jsonl", {"a"}, rows));
  std::string text;
  std::getline(csv, text);
  for (const double value : values) {
    std::getline(csv, text);
    double read = 0;
    std::from_chars(text.data(), text.data() + text.size(), read);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read), std::bit_cast<std::uint64_t>(value)) << text;
    std::getline(json, text);
    const nlohmann::json number = nlohmann::json::parse(text).at("a");
    EXPECT_TRUE(number.is_number_float()) << text;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(number.get<double>()),
              std::bit_cast<std::uint64_t>(value))
        << text;
  }
}

TEST_F(TableFileTest, FormatIsTheSuffixWhateverItsCase) {
  EXPECT_EQ(table_format("a.csv"), TableFormat::kCsv);
  EXPECT_EQ(table_format("folder.x/A.CSV"), TableFormat::kCsv);
  EXPECT_EQ(table_format("a.jsonl"), TableFormat::kJsonLines);
  EXPECT_EQ(table_format("a.NDJSON"), TableFormat::kJsonLines);
}

TEST_F(TableFileTest, OtherSuffixesAreRefusedWithThoseThatWouldDo) {
  for (const std::string path : {"a", "", "-", "csv", "a.json", "a.csv.gz", "a.csv/b", "a.txt"}) {
    try {
      table_format(path);
      FAIL() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kUsage);
      const std::string text = error.what();
      EXPECT_NE(text.find(".csv"), std::string::npos) << text;
      EXPECT_NE(text.find(".jsonl"), std::string::npos) << text;
    }
  }
}

TEST_F(TableFileTest, RowOfAnotherLengthIsRefused) {
  const Names columns{"a", "b"};
  TableFile table(file("t.csv"), columns);
  EXPECT_THROW(table.append(Row{1.0}), Error);
  EXPECT_THROW(table.append(Row{1.0, 2.0, 3.0}), Error);
}

TEST_F(TableFileTest, WithoutCommitNothingIsLeft) {
  const Names columns{"a"};
  { TableFile(file("t.csv"), columns).append(Row{1.0}); }
  EXPECT_EQ(names_in(dir_.path()), Names{});
}

TEST_F(TableFileTest, FullDiskIsAnErrorWithThePath) {
  const Names columns{"a"};
  const FileSizeLimit limit(100'000);
  TableFile table(file("t.csv"), columns);
  try {
    for (int i = 0; i < 100'000; ++i) table.append(Row{std::uint64_t{1}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kResource);
    EXPECT_TRUE(std::string(error.what()).starts_with(file("t.csv"))) << error.what();
  }
}

}  // namespace
}  // namespace atlasgauge
