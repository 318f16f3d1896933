#include "io/corpus/model_probe.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "io/error.hpp"
#include "io/parsed_number.hpp"
#include "io/tsv.hpp"

namespace atlasgauge {
namespace {

constexpr const char* kFile = "file";
constexpr const char* kModel = "model";

[[noreturn]] void refuse(std::string_view line) {
  throw Error(ErrorKind::kInternal,
              fmt::format("a child process that looks at models wrote '{}'", line));
}

template <class Number>
Number number_in(const std::string& field, std::string_view line) {
  if (const auto number = parsed_number<Number>(field)) return *number;
  refuse(line);
}

InputFile file_in(const std::vector<std::string>& fields, std::string_view line) {
  if (fields.size() != 4) refuse(line);
  return {fields[3], number_in<std::uint64_t>(fields[1], line),
          number_in<std::int64_t>(fields[2], line)};
}

void end_probe(const std::vector<std::string>& fields, std::string_view line, ModelProbe& probe) {
  if (fields.size() != 5 || fields[0] != kModel) refuse(line);
  probe.seconds = number_in<double>(fields[1], line);
  probe.inputs.bytes = number_in<std::uint64_t>(fields[2], line);
  probe.inputs.hex = fields[3];
  probe.path = fields[4];
}

}  // namespace

std::string probe_text(const ModelProbe& probe) {
  std::string text;
  for (const InputFile& file : probe.inputs.files) {
    text += tsv_line(std::array<std::string, 4>{kFile, std::to_string(file.bytes),
                                                std::to_string(file.modified_ns), file.path});
  }
  return text + tsv_line(std::array<std::string, 5>{kModel, fmt::format("{:.6f}", probe.seconds),
                                                    std::to_string(probe.inputs.bytes),
                                                    probe.inputs.hex, probe.path});
}

std::vector<ModelProbe> read_probes(std::string_view text) {
  std::vector<ModelProbe> probes;
  ModelProbe probe;
  for (std::size_t end = 0; (end = text.find('\n')) != std::string_view::npos;) {
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    const std::vector<std::string> fields = tsv_fields(line);
    if (fields.front() == kFile) {
      probe.inputs.files.push_back(file_in(fields, line));
      continue;
    }
    end_probe(fields, line, probe);
    probes.push_back(std::exchange(probe, {}));
  }
  return probes;
}

}  // namespace atlasgauge
