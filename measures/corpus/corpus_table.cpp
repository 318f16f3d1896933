#include "measures/corpus/corpus_table.hpp"

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "io/file/output_file.hpp"
#include "io/json/json_text.hpp"
#include "io/json/minified_json.hpp"
#include "io/table_file.hpp"
#include "measures/base/report.hpp"
#include "measures/corpus/corpus_columns.hpp"

namespace atlasgauge {
namespace {

/// What is in arrays and objects has no place in a table.
bool is_single(const Json& value) {
  return !value.is_structured();
}

/// Of what others wrote nothing is left out.
bool is_any(const Json& /*value*/) {
  return true;
}

Json parsed(const std::optional<std::string>& text) {
  return text ? Json::parse(*text) : Json::object();
}

/// The values of a row; holds the texts that they name.
class RowValues {
 public:
  void add(TableValue value) { values_.push_back(value); }
  void add_text(std::string text) { values_.emplace_back(texts_.emplace_back(std::move(text))); }

  void add(const Json& value) {
    if (value.is_null()) return add(TableValue());
    if (value.is_number_unsigned()) return add(TableValue(value.get<std::uint64_t>()));
    if (value.is_number_integer()) return add(TableValue(value.get<std::int64_t>()));
    if (value.is_number_float()) return add(TableValue(value.get<double>()));
    add_text(value.is_string() ? value.get<std::string>() : value.dump());
  }

  void add_members(const Json& object, const CorpusColumns& columns) {
    for (const std::string& key : columns.keys()) {
      const auto found = object.find(key);
      found == object.end() ? add(TableValue()) : add(*found);
    }
  }

  void add_outcome(const CorpusRow& row) {
    add_text(row.path);
    add_text(row.status());
    if (!row.result) {
      for (int i = 0; i < 2; ++i) add(TableValue());
    } else {
      row.is_measured() ? add(TableValue()) : add_text(row.result->reason);
      add(TableValue(warnings(*row.result)));
    }
    add_text(row.digest);
    row.result ? add_text(row.result->program) : add(TableValue());
  }

  const std::vector<TableValue>& values() const { return values_; }

 private:
  static std::uint64_t warnings(const ModelResult& result) {
    std::uint64_t sum = 0;
    for (const auto& [kind, count] : result.warnings) sum += count;
    return sum;
  }

  std::vector<TableValue> values_;
  std::deque<std::string> texts_;
};

std::string json_or_null(const std::optional<std::string>& text) {
  return text ? minified_json(*text) : "null";
}

}  // namespace

void write_corpus_csv(const CorpusRows& rows, const std::string& path) {
  CorpusColumns of_reports, of_metadata;
  for (const CorpusRow& row : rows.all()) {
    of_reports.add(parsed(rows.report(row)), is_single);
    of_metadata.add(parsed(rows.metadata(row)), is_any);
  }
  std::vector<std::string> columns{"model", "status", "reason", "warnings", "digest", "program"};
  columns.insert(columns.end(), of_reports.keys().begin(), of_reports.keys().end());
  for (const std::string& key : of_metadata.keys()) columns.push_back("metadata." + key);

  TableFile table(path, columns);
  for (const CorpusRow& row : rows.all()) {
    RowValues values;
    values.add_outcome(row);
    values.add_members(parsed(rows.report(row)), of_reports);
    values.add_members(parsed(rows.metadata(row)), of_metadata);
    table.append(values.values());
  }
  table.commit();
}

void write_corpus_json_lines(const CorpusRows& rows, const std::string& path) {
  OutputFile file(path);
  for (const CorpusRow& row : rows.all()) {
    const ModelResult result = row.result.value_or(ModelResult());
    const Json outcome{{"model", row.path},       {"status", row.status()},
                       {"reason", result.reason}, {"warnings", result.warnings},
                       {"digest", row.digest},    {"program", result.program}};
    std::string line = json_text(outcome);
    line.pop_back();
    line += ",\"metadata\":" + json_or_null(rows.metadata(row));
    line += ",\"report\":" + json_or_null(rows.report(row));
    file.append(line + "}\n");
  }
  file.commit();
}

}  // namespace atlasgauge
