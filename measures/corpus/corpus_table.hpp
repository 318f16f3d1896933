#pragma once

#include <string>

#include "measures/corpus/corpus_rows.hpp"

namespace atlasgauge {

/// A row a model, as CSV: path, status, reason of a failure, number of warnings, digest and
/// program; then the single values of the report, under its keys; then the members of its metadata,
/// as `metadata.KEY`. What does not exist is empty. There whole or not at all: see OutputFile.
void write_corpus_csv(const CorpusRows& rows, const std::string& path);

/// An object a model and line: the same first values (`warnings` by kind), then `metadata` and
/// `report` as they are, or null.
void write_corpus_json_lines(const CorpusRows& rows, const std::string& path);

}  // namespace atlasgauge
