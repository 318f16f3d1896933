#include "bench/end_to_end/cost_text.hpp"

#include <regex>
#include <sstream>
#include <string_view>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

const std::string kTime = R"( +(\d+\.\d+))";
const std::string kBytes = R"( +(\d+(?:\.\d+)?) ([KMGT]?)i?B)";

double bytes_of_unit(const std::string& number, const std::string& unit) {
  constexpr std::string_view kUnits = "KMGT";
  double bytes = std::stod(number);
  if (unit.empty()) return bytes;
  for (std::size_t i = 0; i <= kUnits.find(unit[0]); ++i) bytes *= 1024;
  return bytes;
}

bool read_stage(const std::string& line, CostText& cost) {
  static const std::regex form("(\\S.*?)" + kTime + kTime + " +(\\d+)" + kBytes + kBytes + kBytes);
  std::smatch parts;
  if (!std::regex_match(line, parts, form)) return false;
  const auto bytes = [&](std::size_t at) { return bytes_of_unit(parts[at], parts[at + 1]); };
  cost.stages.push_back({parts[1], std::stod(parts[2]), std::stod(parts[3]), std::stoull(parts[4]),
                         bytes(5), bytes(7), bytes(9)});
  return true;
}

void read_total(const std::string& line, CostText& cost) {
  static const std::regex form("([a-z ]*[a-z])" + kBytes + "(?:  .*)?");
  std::smatch parts;
  if (std::regex_match(line, parts, form)) cost.bytes[parts[1]] = bytes_of_unit(parts[2], parts[3]);
}

}  // namespace

double CostText::bytes_of(const std::string& what) const {
  const auto found = bytes.find(what);
  if (found != bytes.end()) return found->second;
  throw Error(ErrorKind::kInput, "atlasgauge -v prints no line on: " + what);
}

CostText parse_cost(const std::string& text) {
  CostText cost;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!read_stage(line, cost)) read_total(line, cost);
  }
  if (cost.stages.empty()) throw Error(ErrorKind::kInput, "atlasgauge -v prints no stages");
  return cost;
}

}  // namespace atlasgauge
