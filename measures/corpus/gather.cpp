#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>

#include "io/corpus/corpus_job.hpp"
#include "io/error.hpp"
#include "io/file/output_file.hpp"
#include "io/warnings.hpp"
#include "measures/corpus/corpus.hpp"
#include "measures/corpus/corpus_rows.hpp"
#include "measures/corpus/corpus_table.hpp"
#include "measures/corpus/tally.hpp"

namespace atlasgauge {
namespace {

void remark(const std::string& line) {
  std::fputs((line + "\n").c_str(), stderr);
}

/// A link in a corpus that others made could lead anywhere.
void refuse_links(const std::filesystem::path& folder, const std::filesystem::path& below) {
  std::filesystem::path path = folder;
  for (const std::filesystem::path& step : below) {
    path /= step;
    std::error_code fault;
    if (!std::filesystem::is_symlink(path, fault)) continue;
    throw Error(ErrorKind::kResource, path.string(), 0,
                "a report would be written through this symbolic link; remove it, or give another "
                "folder to --reports");
  }
}

void write_reports(const CorpusRows& rows, const std::string& folder) {
  for (const CorpusRow& row : rows.all()) {
    const auto report = rows.report(row);
    if (!report) continue;
    const std::string name = row.path + ".json";
    refuse_links(folder, name);
    const std::filesystem::path path = std::filesystem::path(folder) / name;
    std::error_code fault;
    std::filesystem::create_directories(path.parent_path(), fault);
    if (fault) {
      throw Error(ErrorKind::kResource, path.parent_path().string(), 0,
                  "the folder cannot be made: " + fault.message());
    }
    write_file(path.string(), *report);
  }
}

/// Names what is missing; returns how much that is.
std::size_t tell(const CorpusRows& rows, const CorpusJob& job) {
  Tally tally;
  for (const CorpusRow& row : rows.all()) {
    if (!row.result) remark("missing: " + row.path);
    tally.add(row.result);
  }
  write_file("-", fmt::format("{} models: {}; in {} and {}\n", tally.models(), tally.text(),
                              job.table_path(".csv"), job.table_path(".jsonl")));
  return tally.missing;
}

}  // namespace

int gather_corpus(const CorpusGatherOptions& options) {
  const CorpusJob job(options.job);
  Warnings warnings([](const std::string& text) { remark("warning: " + text); });
  StopSignals stop;
  const CorpusRows rows(job, stop, warnings);
  if (stop.taken() != 0) return 128 + stop.taken();
  write_corpus_csv(rows, job.table_path(".csv"));
  write_corpus_json_lines(rows, job.table_path(".jsonl"));
  if (options.reports) write_reports(rows, *options.reports);
  return tell(rows, job) > 0 ? 1 : 0;
}

}  // namespace atlasgauge
