#include "tests/support/oracle.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <tuple>

namespace atlasgauge::oracle {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Sums of doubles that lie within 400 binary orders of magnitude are exact.
using Wide = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<512, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

constexpr const char* kBlanks = " \t\r\v\f";

// ---- Text ----

struct Statement {
  size_t line;
  std::string keyword;
  std::string rest;
};

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

struct Word {
  size_t begin;
  size_t end;
};

std::vector<Word> word_ranges(const std::string& text) {
  std::vector<Word> words;
  size_t begin = text.find_first_not_of(kBlanks);
  while (begin != std::string::npos) {
    const size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
    words.push_back({begin, end});
    begin = text.find_first_not_of(kBlanks, end);
  }
  return words;
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (const Word& word : word_ranges(text)) {
    words.push_back(text.substr(word.begin, word.end - word.begin));
  }
  return words;
}

std::string without_comment(const std::string& text) {
  for (const Word& word : word_ranges(text)) {
    if (text[word.begin] == '#') return text.substr(0, word.begin);
  }
  return text;
}

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be opened");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// What a backslash at the end of a line means.
enum class Backslash { kContinues, kPlain };

// A line that continues is joined with the next, a blank between them.
std::vector<Statement> read_statements(const std::string& path, Backslash backslash) {
  std::istringstream text(read_file(path));
  std::vector<Statement> statements;
  std::string line, joined;
  size_t number = 0, first_number = 1;
  while (std::getline(text, line)) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const bool continues =
        backslash == Backslash::kContinues && !line.empty() && line.back() == '\\';
    if (continues) line.back() = ' ';
    joined += line;
    if (continues && text.peek() != std::istringstream::traits_type::eof()) continue;
    const std::string body = trimmed(without_comment(joined));
    const std::string keyword = body.substr(0, body.find_first_of(kBlanks));
    if (!body.empty()) {
      statements.push_back({first_number, keyword, trimmed(body.substr(keyword.size()))});
    }
    joined.clear();
    first_number = number + 1;
  }
  return statements;
}

[[noreturn]] void fail(const Statement& statement, const std::string& what) {
  throw std::runtime_error("line " + std::to_string(statement.line) + ": " + what);
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool only_digits(const std::string& text) {
  return text.find_first_not_of("0123456789") == std::string::npos;
}

// "1.#INF00" and "1.#INF00e+000" are how old runtimes print infinity with two digits.
bool is_msvc_special(const std::string& text, const std::string& special) {
  return text.starts_with(special) &&
         text.find_first_not_of("0eE+", special.size()) == std::string::npos;
}

std::optional<double> special_number(const std::string& word) {
  const bool negative = word.starts_with('-');
  const std::string text = negative || word.starts_with('+') ? word.substr(1) : word;
  const double sign = negative ? -1 : 1;
  if (lower(text) == "inf" || lower(text) == "infinity" || is_msvc_special(text, "1.#INF")) {
    return sign * std::numeric_limits<double>::infinity();
  }
  const bool is_nan = lower(text) == "nan" || is_msvc_special(text, "1.#IND") ||
                      is_msvc_special(text, "1.#QNAN") || is_msvc_special(text, "1.#SNAN");
  if (is_nan) return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

template <class Number>
Number parse_number(const Statement& statement, const std::string& word,
                    Number (*convert)(const char*, char**)) {
  if (const auto special = special_number(word)) return static_cast<Number>(*special);
  char* end = nullptr;
  const Number value = convert(word.c_str(), &end);
  const bool plain = word.find_first_not_of("0123456789+-.eE") == std::string::npos;
  if (word.empty() || !plain || *end != '\0') fail(statement, "not a number: " + word);
  return value;
}

// nullopt names nothing: an index that does not fit 64 bits.
std::optional<int64_t> parse_index(const Statement& statement, const std::string& word) {
  const bool has_sign = word.starts_with('-') || word.starts_with('+');
  const std::string digits = has_sign ? word.substr(1) : word;
  if (digits.empty() || !only_digits(digits)) fail(statement, "not an index: " + word);
  errno = 0;
  const long long value = std::strtoll(word.c_str(), nullptr, 10);
  if (errno == ERANGE) return std::nullopt;
  return value;
}

// ---- Materials ----

struct Material {
  std::string image_name;
  std::string image_path;
};

struct Materials {
  std::map<std::string, Material> by_name;
  std::vector<std::string> order;
};

std::string with_slashes(std::string path) {
  std::replace(path.begin(), path.end(), '\\', '/');
  return path;
}

std::string join_path(const fs::path& folder, const std::string& name) {
  return (folder / name).lexically_normal().string();
}

bool is_file(const fs::path& path) {
  std::error_code ignored;  // a name may be too long for any file
  return fs::is_regular_file(path, ignored);
}

bool image_exists(const std::string& path, const Options& options) {
  return is_file(path) || (options.image_size && options.image_size(path));
}

std::string find_image(const std::string& name, const fs::path& mtl_folder,
                       const fs::path& obj_folder, const Options& options) {
  const std::string beside_mtl = join_path(mtl_folder, name);
  const std::string beside_obj = join_path(obj_folder, name);
  if (!image_exists(beside_mtl, options) && image_exists(beside_obj, options)) return beside_obj;
  return beside_mtl;
}

bool is_numeric(const std::string& word) {
  char* end = nullptr;
  std::strtod(word.c_str(), &end);
  return !word.empty() && *end == '\0';
}

// The words that an option of a texture statement takes; -s, -o and -t take one to three, and a
// number that may be the last of these or the name is the name if nothing follows.
size_t option_arguments(const std::vector<std::string>& words, size_t option) {
  static const std::map<std::string, size_t> fixed = {
      {"-blendu", 1},  {"-blendv", 1}, {"-boost", 1},     {"-mm", 2},
      {"-texres", 1},  {"-clamp", 1},  {"-cc", 1},        {"-bm", 1},
      {"-imfchan", 1}, {"-type", 1},   {"-colorspace", 1}};
  if (const auto it = fixed.find(words[option]); it != fixed.end()) return it->second;
  if (words[option] != "-s" && words[option] != "-o" && words[option] != "-t") return 0;
  size_t count = 1;
  while (count < 3 && option + count + 2 < words.size() && is_numeric(words[option + count + 1])) {
    ++count;
  }
  return count;
}

std::string image_name_of(const std::string& rest) {
  const std::vector<std::string> words = words_of(rest);
  size_t first = 0;
  while (first < words.size() && words[first].starts_with('-')) {
    const size_t arguments = option_arguments(words, first);
    if (arguments == 0) break;
    first += 1 + arguments;
  }
  if (first >= words.size()) return "";
  return with_slashes(rest.substr(word_ranges(rest)[first].begin));
}

void read_mtl(const std::string& path, const fs::path& obj_folder, const Options& options,
              Materials& materials) {
  Material* current = nullptr;
  for (const Statement& statement : read_statements(path, Backslash::kPlain)) {
    if (statement.keyword == "newmtl") {
      const auto [it, is_new] = materials.by_name.try_emplace(statement.rest);
      if (is_new) materials.order.push_back(statement.rest);
      current = is_new ? &it->second : nullptr;
    } else if (statement.keyword == "map_Kd" && current) {
      const std::string name = image_name_of(statement.rest);
      const fs::path folder = fs::path(path).parent_path();
      if (!name.empty()) *current = {name, find_image(name, folder, obj_folder, options)};
    }
  }
}

std::vector<std::string> library_names(const std::string& rest, const fs::path& folder) {
  const std::vector<Word> words = word_ranges(rest);
  std::vector<std::string> names;
  size_t first = 0;
  while (first < words.size()) {
    size_t last = words.size();
    std::string name;
    for (; last > first; --last) {
      name =
          with_slashes(rest.substr(words[first].begin, words[last - 1].end - words[first].begin));
      if (is_file(folder / name)) break;
    }
    if (last > first) names.push_back(name);
    first = std::max(last, first + 1);
  }
  return names;
}

Materials read_materials(const std::vector<Statement>& statements, const fs::path& obj_path,
                         const Options& options) {
  const fs::path folder = obj_path.parent_path();
  Materials materials;
  bool has_library = false;
  for (const Statement& statement : statements) {
    if (statement.keyword != "mtllib") continue;
    has_library = true;
    for (const std::string& name : library_names(statement.rest, folder)) {
      read_mtl((folder / name).string(), folder, options, materials);
    }
  }
  const fs::path own = fs::path(obj_path).replace_extension(".mtl");
  if (!has_library && is_file(own)) {
    read_mtl(own.string(), folder, options, materials);
  }
  return materials;
}

Slot named_slot(const Material& material, const Options& options) {
  Slot slot{material.image_name, material.image_path, std::nullopt, false};
  if (options.image_size) slot.size = options.image_size(slot.path);
  slot.readable = slot.size.has_value();
  if (!slot.readable) slot.size = options.size_option;
  return slot;
}

// The slots of the model, and the slot of each material that has one.
std::map<std::string, int64_t> make_slots(const Materials& materials, const Options& options,
                                          Model& model) {
  std::map<std::string, int64_t> by_path, by_material;
  for (const std::string& name : materials.order) {
    const Material& material = materials.by_name.at(name);
    if (material.image_name.empty()) continue;
    const auto next = static_cast<int64_t>(model.slots.size());
    const auto [it, is_new] = by_path.try_emplace(material.image_path, next);
    if (is_new) model.slots.push_back(named_slot(material, options));
    by_material[name] = it->second;
  }
  model.with_images = !model.slots.empty();
  if (!model.with_images) {
    model.slots.push_back({"N/A", "", options.size_option.value_or(Size{1, 1}), false});
  }
  return by_material;
}

// ---- The OBJ file ----

// Zero-based; -1 names nothing. Upper bounds are checked once the whole file is read.
struct Corner {
  int64_t vertex = -1;
  int64_t uv = -1;
};

struct Polygon {
  std::vector<Corner> corners;
  std::optional<std::string> material;
};

struct ObjContent {
  std::vector<Position> positions;
  std::vector<Uv> uvs;
  std::vector<Polygon> polygons;
};

int64_t resolve_index(std::optional<int64_t> index, size_t read_so_far) {
  if (!index || *index == 0) return -1;
  if (*index > 0) return *index - 1;
  return std::max<int64_t>(-1, static_cast<int64_t>(read_so_far) + *index);
}

Corner parse_corner(const Statement& statement, const std::string& word, const ObjContent& obj) {
  const size_t slash = word.find('/');
  Corner corner;
  corner.vertex =
      resolve_index(parse_index(statement, word.substr(0, slash)), obj.positions.size());
  if (slash == std::string::npos) return corner;
  const size_t second = word.find('/', slash + 1);
  const size_t length = second == std::string::npos ? second : second - slash - 1;
  const std::string uv = word.substr(slash + 1, length);
  if (!uv.empty()) corner.uv = resolve_index(parse_index(statement, uv), obj.uvs.size());
  return corner;
}

Position parse_position(const Statement& statement) {
  const std::vector<std::string> words = words_of(statement.rest);
  if (words.size() < 3) fail(statement, "a vertex needs three coordinates");
  Position position;
  for (size_t i = 0; i < 3; ++i) position[i] = parse_number<double>(statement, words[i], strtod);
  return position;
}

Uv parse_uv(const Statement& statement) {
  const std::vector<std::string> words = words_of(statement.rest);
  if (words.empty()) fail(statement, "a texture coordinate needs u");
  const float u = parse_number<float>(statement, words[0], strtof);
  const float v = words.size() > 1 ? parse_number<float>(statement, words[1], strtof) : 0.0F;
  return {u, v};
}

/// Whether a statement is one by which a file shows itself to be an OBJ model.
bool is_of_obj(const Statement& statement) {
  static const std::set<std::string> keywords = {"v",   "vt",   "f",   "usemtl", "mtllib",
                                                 "p",   "l",    "bsp", "bzp",    "cdc",
                                                 "cdp", "curv", "fo",  "curv2",  "surf"};
  return keywords.contains(statement.keyword);
}

ObjContent parse_obj(const std::vector<Statement>& statements) {
  if (std::none_of(statements.begin(), statements.end(), is_of_obj)) {
    throw std::runtime_error("no OBJ statement");
  }
  ObjContent obj;
  std::optional<std::string> material;
  for (const Statement& statement : statements) {
    if (statement.keyword == "v") {
      obj.positions.push_back(parse_position(statement));
    } else if (statement.keyword == "vt") {
      obj.uvs.push_back(parse_uv(statement));
    } else if (statement.keyword == "usemtl") {
      material = statement.rest;
    } else if (statement.keyword == "f") {
      Polygon polygon{{}, material};
      for (const std::string& word : words_of(statement.rest)) {
        polygon.corners.push_back(parse_corner(statement, word, obj));
      }
      obj.polygons.push_back(polygon);
    }
  }
  return obj;
}

template <class Container>
bool names_one_of(int64_t index, const Container& container) {
  return index >= 0 && index < static_cast<int64_t>(container.size());
}

bool is_valid(const Polygon& polygon, const ObjContent& obj) {
  return polygon.corners.size() >= 3 &&
         std::all_of(polygon.corners.begin(), polygon.corners.end(), [&](const Corner& corner) {
           return names_one_of(corner.vertex, obj.positions);
         });
}

std::optional<Uv> uv_of(const Corner& corner, const ObjContent& obj) {
  if (!names_one_of(corner.uv, obj.uvs)) return std::nullopt;
  const Uv uv = obj.uvs[static_cast<size_t>(corner.uv)];
  if (!std::isfinite(uv[0]) || !std::isfinite(uv[1])) return std::nullopt;
  return uv;
}

void add_fan(const Polygon& polygon, const ObjContent& obj, std::optional<int64_t> slot,
             std::vector<Face>& faces) {
  for (size_t i = 2; i < polygon.corners.size(); ++i) {
    const std::array<Corner, 3> corners = {polygon.corners[0], polygon.corners[i - 1],
                                           polygon.corners[i]};
    Face face;
    face.slot = slot;
    for (size_t k = 0; k < 3; ++k) {
      face.vertices[k] = corners[k].vertex;
      face.uvs[k] = uv_of(corners[k], obj);
    }
    faces.push_back(face);
  }
}

// ---- Levels ----

bool is_finite(const Position& position) {
  return std::all_of(position.begin(), position.end(), [](double x) { return std::isfinite(x); });
}

bool has_repetition(const Triple& t) {
  return t[0] == t[1] || t[1] == t[2] || t[0] == t[2];
}

// Adding +0 turns -0 into +0 and leaves all else as it is.
Position without_negative_zero(const Position& p) {
  return {p[0] + 0.0, p[1] + 0.0, p[2] + 0.0};
}

Position minus(const Position& p, const Position& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

Position cross(const Position& a, const Position& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Position& a, const Position& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double length(const Position& a) {
  return std::sqrt(dot(a, a));
}

double texel_distance(const Texel& a, const Texel& b) {
  const double dx = a[0] - b[0];
  const double dy = a[1] - b[1];
  return std::sqrt(dx * dx + dy * dy);
}

std::array<Position, 3> corner_positions(const Model& model, const Triple& vertices) {
  std::array<Position, 3> corners;
  for (size_t k = 0; k < 3; ++k) corners[k] = model.positions[static_cast<size_t>(vertices[k])];
  return corners;
}

double triangle_area(const std::array<Position, 3>& p) {
  return 0.5 * length(cross(minus(p[1], p[0]), minus(p[2], p[0])));
}

double signed_texel_area(const std::array<Texel, 3>& t) {
  return 0.5 *
         ((t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[2][0] - t[0][0]) * (t[1][1] - t[0][1]));
}

std::vector<int64_t> weld(const std::vector<Position>& positions) {
  std::map<Position, int64_t> first_of;
  std::vector<int64_t> welded(positions.size(), -1);
  for (size_t v = 0; v < positions.size(); ++v) {
    if (!is_finite(positions[v])) continue;
    const Position key = without_negative_zero(positions[v]);
    welded[v] = first_of.try_emplace(key, static_cast<int64_t>(v)).first->second;
  }
  return welded;
}

void sort_out_levels(Analysis& analysis) {
  const Model& model = analysis.model;
  const std::vector<int64_t> welded = weld(model.positions);
  for (size_t f = 0; f < model.faces.size(); ++f) {
    FaceFacts& facts = analysis.faces[f];
    const Triple& vertices = model.faces[f].vertices;
    const std::array<Position, 3> corners = corner_positions(model, vertices);
    facts.degenerate = has_repetition(vertices);
    facts.non_finite = !facts.degenerate && !std::all_of(corners.begin(), corners.end(), is_finite);
    facts.raw = !facts.degenerate && !facts.non_finite;
    if (!facts.raw) continue;
    facts.area = triangle_area(corners);
    for (size_t k = 0; k < 3; ++k) {
      facts.welded_vertices[k] = welded[static_cast<size_t>(vertices[k])];
    }
    facts.welded = !has_repetition(facts.welded_vertices);
  }
}

struct UvBox {
  Texel low = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Texel high = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
};

UvBox uv_box_of_slot(const Analysis& analysis, int64_t slot) {
  UvBox box;
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    if (!analysis.faces[f].raw || analysis.model.faces[f].slot != slot) continue;
    for (const std::optional<Uv>& uv : analysis.model.faces[f].uvs) {
      for (size_t i = 0; uv && i < 2; ++i) {
        box.low[i] = std::min(box.low[i], static_cast<double>((*uv)[i]));
        box.high[i] = std::max(box.high[i], static_cast<double>((*uv)[i]));
      }
    }
  }
  return box;
}

Texel shift_of_slot(const Analysis& analysis, int64_t slot) {
  const UvBox box = uv_box_of_slot(analysis, slot);
  const auto outside = [&](size_t i) {
    const double centre = (box.low[i] + box.high[i]) / 2;
    return centre < 0 || centre > 1;
  };
  if (!outside(0) && !outside(1)) return {0, 0};
  return {-std::floor(box.low[0]), -std::floor(box.low[1])};
}

void place_on_slot(const Face& face, const Slot& slot, const Texel& shift, FaceFacts& facts) {
  facts.has_uv_triangle =
      slot.size && std::all_of(face.uvs.begin(), face.uvs.end(),
                               [](const std::optional<Uv>& uv) { return uv.has_value(); });
  if (!facts.has_uv_triangle) return;
  for (size_t k = 0; k < 3; ++k) {
    const auto [u, v] = *face.uvs[k];
    facts.texels[k] = {(u + shift[0]) * slot.size->first, (v + shift[1]) * slot.size->second};
    for (const double t : facts.texels[k]) facts.uv_far |= std::abs(t) > 0x1p30;
  }
  facts.signed_uv_area = signed_texel_area(facts.texels);
}

void place_uvs(Analysis& analysis) {
  std::vector<Texel> shifts;
  for (size_t slot = 0; slot < analysis.model.slots.size(); ++slot) {
    shifts.push_back(shift_of_slot(analysis, static_cast<int64_t>(slot)));
  }
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    const Face& face = analysis.model.faces[f];
    if (!analysis.faces[f].welded || !face.slot) continue;
    const auto slot = static_cast<size_t>(*face.slot);
    place_on_slot(face, analysis.model.slots[slot], shifts[slot], analysis.faces[f]);
  }
}

void split_into_uv_vertices(Analysis& analysis) {
  using UvVertex = std::tuple<int64_t, std::optional<Uv>, std::optional<int64_t>>;
  std::map<UvVertex, int64_t> ids;
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    FaceFacts& facts = analysis.faces[f];
    const Face& face = analysis.model.faces[f];
    for (size_t k = 0; facts.welded && k < 3; ++k) {
      std::optional<Uv> uv = face.uvs[k];
      if (uv) uv = Uv{(*uv)[0] + 0.0F, (*uv)[1] + 0.0F};
      const auto next = static_cast<int64_t>(ids.size());
      facts.uv_vertices[k] =
          ids.try_emplace({facts.welded_vertices[k], uv, face.slot}, next).first->second;
    }
  }
}

EdgeKey edge_key(const Triple& vertices, int corner) {
  const auto k = static_cast<size_t>(corner);
  return std::minmax({vertices[k], vertices[(k + 1) % 3]});
}

void add_edges(const Triple& vertices, int64_t face, EdgeMap& edges) {
  for (int corner = 0; corner < 3; ++corner) {
    const EdgeKey key = edge_key(vertices, corner);
    const bool forward = key.first == vertices[static_cast<size_t>(corner)];
    edges[key].push_back({face, corner, forward});
  }
}

void collect_edges(Analysis& analysis) {
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    const FaceFacts& facts = analysis.faces[f];
    const auto face = static_cast<int64_t>(f);
    if (facts.raw) add_edges(analysis.model.faces[f].vertices, face, analysis.raw_edges);
    if (!facts.welded) continue;
    add_edges(facts.welded_vertices, face, analysis.welded_edges);
    add_edges(facts.uv_vertices, face, analysis.uv_edges);
  }
}

// ---- Grouping ----

// Disjoint sets, each named by its smallest member.
class Sets {
 public:
  explicit Sets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  int64_t find(int64_t x) {
    while (parent(x) != x) x = parent(x) = parent(parent(x));
    return x;
  }

  void unite(int64_t x, int64_t y) {
    const auto [low, high] = std::minmax({find(x), find(y)});
    parent(high) = low;
  }

 private:
  int64_t& parent(int64_t x) { return parent_[static_cast<size_t>(x)]; }

  std::vector<int64_t> parent_;
};

Sets face_components(const EdgeMap& edges, size_t face_count) {
  Sets sets(face_count);
  for (const auto& [key, uses] : edges) {
    for (const EdgeUse& use : uses) sets.unite(use.face, uses.front().face);
  }
  return sets;
}

void number_charts(Analysis& analysis) {
  Sets sets = face_components(analysis.uv_edges, analysis.faces.size());
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    if (analysis.faces[f].welded) analysis.faces[f].chart = sets.find(static_cast<int64_t>(f));
  }
}

// Which faces to flip so that all run coherently across the edges of exactly two faces, the first
// face of each class so joined staying as it is; and the faces where that is impossible.
struct Coherence {
  std::vector<std::optional<bool>> flipped;
  std::vector<int64_t> contradictions;
};

struct Neighbour {
  int64_t face;
  bool same_direction;
};

std::vector<std::vector<Neighbour>> manifold_neighbours(const EdgeMap& edges, size_t face_count) {
  std::vector<std::vector<Neighbour>> neighbours(face_count);
  for (const auto& [key, uses] : edges) {
    if (uses.size() != 2) continue;
    const bool same = uses[0].forward == uses[1].forward;
    neighbours[static_cast<size_t>(uses[0].face)].push_back({uses[1].face, same});
    neighbours[static_cast<size_t>(uses[1].face)].push_back({uses[0].face, same});
  }
  return neighbours;
}

Coherence make_coherent(const EdgeMap& edges, size_t face_count) {
  const auto neighbours = manifold_neighbours(edges, face_count);
  Coherence result{std::vector<std::optional<bool>>(face_count), {}};
  for (size_t first = 0; first < face_count; ++first) {
    if (result.flipped[first]) continue;
    result.flipped[first] = false;
    std::vector<size_t> open = {first};
    while (!open.empty()) {
      const size_t face = open.back();
      open.pop_back();
      for (const Neighbour& neighbour : neighbours[face]) {
        const bool wanted = *result.flipped[face] != neighbour.same_direction;
        std::optional<bool>& other = result.flipped[static_cast<size_t>(neighbour.face)];
        if (other && *other != wanted) result.contradictions.push_back(neighbour.face);
        if (!other) open.push_back(static_cast<size_t>(neighbour.face));
        if (!other) other = wanted;
      }
    }
  }
  return result;
}

// ---- Numbers ----

double rounded(const Wide& value) {
  return value.convert_to<double>();
}

json ratio(const Wide& numerator, const Wide& denominator) {
  if (denominator == 0) return nullptr;
  return rounded(numerator / denominator);
}

Wide exact_sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), Wide(0));
}

struct Sample {
  double value;
  double weight;
};

using Samples = std::vector<Sample>;

Wide weighted_sum(const Samples& samples, const std::function<Wide(const Wide&)>& of) {
  Wide sum = 0;
  for (const Sample& sample : samples) sum += of(Wide(sample.value)) * Wide(sample.weight);
  return sum;
}

Wide total_weight(const Samples& samples) {
  return weighted_sum(samples, [](const Wide&) { return Wide(1); });
}

Wide average(const Samples& samples) {
  return weighted_sum(samples, [](const Wide& x) { return x; }) / total_weight(samples);
}

Wide mean_square(const Samples& samples, const Wide& pivot) {
  const auto square = [&](const Wide& x) { return Wide((x - pivot) * (x - pivot)); };
  return weighted_sum(samples, square) / total_weight(samples);
}

// The smallest value whose cumulative weight reaches that share of the total; samples are sorted.
double percentile(const Samples& sorted, int percent, const Wide& total) {
  Wide cumulative = 0;
  for (const Sample& sample : sorted) {
    cumulative += sample.weight;
    if (cumulative * 100 >= total * percent) return sample.value;
  }
  return sorted.back().value;
}

constexpr std::array<int, 11> kPercents = {1, 10, 20, 30, 40, 50, 60, 70, 80, 90, 99};

void report_nothing(json& report, const std::string& name) {
  for (const int percent : kPercents) report[name + "_perc" + std::to_string(percent)] = nullptr;
  for (const char* suffix : {"_min", "_max", "_avg", "_rms", "_var", "_stddev"}) {
    report[name + suffix] = nullptr;
  }
}

void report_statistics(json& report, const std::string& name, Samples samples) {
  if (samples.empty()) return report_nothing(report, name);
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.value < b.value; });
  const Wide total = total_weight(samples);
  for (const int percent : kPercents) {
    report[name + "_perc" + std::to_string(percent)] = percentile(samples, percent, total);
  }
  const Wide mean = average(samples);
  const Wide variance = mean_square(samples, mean);
  report[name + "_min"] = samples.front().value;
  report[name + "_max"] = samples.back().value;
  report[name + "_avg"] = rounded(mean);
  report[name + "_rms"] = rounded(sqrt(mean_square(samples, 0)));
  report[name + "_var"] = rounded(variance);
  report[name + "_stddev"] = rounded(sqrt(variance));
}

// ---- Mesh measures ----

template <class Predicate>
int64_t count_faces(const Analysis& analysis, Predicate predicate) {
  return std::count_if(analysis.faces.begin(), analysis.faces.end(), predicate);
}

template <class Predicate>
int64_t count_edges(const EdgeMap& edges, Predicate predicate) {
  return std::count_if(edges.begin(), edges.end(),
                       [&](const auto& edge) { return predicate(edge.second.size()); });
}

int64_t count_boundary(const EdgeMap& edges) {
  return count_edges(edges, [](size_t uses) { return uses == 1; });
}

int64_t count_non_manifold(const EdgeMap& edges) {
  return count_edges(edges, [](size_t uses) { return uses > 2; });
}

Wide total_area(const Analysis& analysis) {
  Wide sum = 0;
  for (const FaceFacts& face : analysis.faces) sum += face.area;
  return sum;
}

double edge_length(const Model& model, const EdgeKey& edge) {
  return length(minus(model.positions[static_cast<size_t>(edge.first)],
                      model.positions[static_cast<size_t>(edge.second)]));
}

Wide boundary_length(const Analysis& analysis) {
  std::vector<double> lengths;
  for (const auto& [edge, uses] : analysis.raw_edges) {
    if (uses.size() == 1) lengths.push_back(edge_length(analysis.model, edge));
  }
  return exact_sum(lengths);
}

double longest_side(const Model& model) {
  double longest = 0;
  for (size_t i = 0; i < 3; ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Position& position : model.positions) {
      if (!is_finite(position)) continue;
      low = std::min(low, position[i]);
      high = std::max(high, position[i]);
    }
    longest = std::max(longest, high - low);
  }
  return longest;
}

std::map<int64_t, std::vector<int64_t>> faces_of_vertices(const Analysis& analysis) {
  std::map<int64_t, std::vector<int64_t>> faces_of;
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    if (!analysis.faces[f].raw) continue;
    for (const int64_t v : analysis.model.faces[f].vertices) {
      faces_of[v].push_back(static_cast<int64_t>(f));
    }
  }
  return faces_of;
}

std::set<int64_t> vertices_on_non_manifold_edges(const EdgeMap& edges) {
  std::set<int64_t> vertices;
  for (const auto& [edge, uses] : edges) {
    if (uses.size() > 2) vertices.insert({edge.first, edge.second});
  }
  return vertices;
}

// Two faces at the vertex are in one fan when they share a further vertex, directly or by others.
size_t count_fans(const Model& model, int64_t vertex, const std::vector<int64_t>& faces) {
  std::map<int64_t, int64_t> first_at;
  Sets fans(faces.size());
  for (size_t i = 0; i < faces.size(); ++i) {
    const auto fan = static_cast<int64_t>(i);
    for (const int64_t other : model.faces[static_cast<size_t>(faces[i])].vertices) {
      if (other != vertex) fans.unite(fan, first_at.try_emplace(other, fan).first->second);
    }
  }
  std::set<int64_t> roots;
  for (size_t i = 0; i < faces.size(); ++i) roots.insert(fans.find(static_cast<int64_t>(i)));
  return roots.size();
}

int64_t count_non_manifold_vertices(const Analysis& analysis) {
  const std::set<int64_t> excluded = vertices_on_non_manifold_edges(analysis.raw_edges);
  int64_t count = 0;
  for (const auto& [vertex, faces] : faces_of_vertices(analysis)) {
    if (!excluded.contains(vertex) && count_fans(analysis.model, vertex, faces) > 1) ++count;
  }
  return count;
}

int64_t count_boundary_components(const Analysis& analysis) {
  Sets sets(analysis.model.positions.size());
  for (const auto& [edge, uses] : analysis.raw_edges) {
    if (uses.size() == 1) sets.unite(edge.first, edge.second);
  }
  std::set<int64_t> roots;
  for (const auto& [edge, uses] : analysis.raw_edges) {
    if (uses.size() == 1) roots.insert(sets.find(edge.first));
  }
  return static_cast<int64_t>(roots.size());
}

std::vector<int64_t> component_sizes(const Analysis& analysis) {
  Sets sets = face_components(analysis.raw_edges, analysis.faces.size());
  std::map<int64_t, int64_t> size_of;
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    if (analysis.faces[f].raw) ++size_of[sets.find(static_cast<int64_t>(f))];
  }
  std::vector<int64_t> sizes;
  for (const auto& [root, size] : size_of) sizes.push_back(size);
  return sizes;
}

int64_t count_distinct_faces(const Analysis& analysis) {
  std::set<Triple> triples;
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    Triple triple = analysis.model.faces[f].vertices;
    std::sort(triple.begin(), triple.end());
    if (analysis.faces[f].raw) triples.insert(triple);
  }
  return static_cast<int64_t>(triples.size());
}

int64_t count_duplicate_positions(const std::vector<Position>& positions) {
  std::set<Position> distinct;
  int64_t duplicates = 0;
  for (const Position& position : positions) {
    const bool has_nan =
        std::any_of(position.begin(), position.end(), [](double x) { return std::isnan(x); });
    if (has_nan) continue;
    if (!distinct.insert(without_negative_zero(position)).second) ++duplicates;
  }
  return duplicates;
}

bool is_oriented(const EdgeMap& edges) {
  return std::all_of(edges.begin(), edges.end(), [](const auto& edge) {
    return edge.second.size() != 2 || edge.second[0].forward != edge.second[1].forward;
  });
}

void report_sizes(json& report, const Analysis& analysis) {
  const Wide area = total_area(analysis);
  const Wide boundary = boundary_length(analysis);
  const Wide side = longest_side(analysis.model);
  report["area"] = rounded(area);
  report["boundary_len"] = rounded(boundary);
  report["area_normalized"] = ratio(area, side * side);
  report["boundary_len_normalized"] = ratio(boundary, side);
}

void report_face_counts(json& report, const Analysis& analysis) {
  const int64_t raw = count_faces(analysis, [](const FaceFacts& f) { return f.raw; });
  report["fn"] = analysis.faces.size();
  report["fndup"] = raw - count_distinct_faces(analysis);
  report["fnzero"] = count_faces(analysis, [](const FaceFacts& f) { return f.raw && f.area == 0; });
  report["fndegen"] = count_faces(analysis, [](const FaceFacts& f) { return f.degenerate; });
  report["faces_nonfinite"] =
      count_faces(analysis, [](const FaceFacts& f) { return f.non_finite; });
  report["faces_invalid"] = analysis.model.invalid_polygons;
}

void report_topology(json& report, const Analysis& analysis) {
  const auto vertices = static_cast<int64_t>(faces_of_vertices(analysis).size());
  const auto edges = static_cast<int64_t>(analysis.raw_edges.size());
  const int64_t faces = count_faces(analysis, [](const FaceFacts& f) { return f.raw; });
  const std::vector<int64_t> components = component_sizes(analysis);
  const auto component_count = static_cast<int64_t>(components.size());
  const int64_t bad_edges = count_non_manifold(analysis.raw_edges);
  const int64_t bad_vertices = count_non_manifold_vertices(analysis);
  const int64_t loops = count_boundary_components(analysis);
  const bool manifold = bad_edges == 0 && bad_vertices == 0;
  report["vn"] = analysis.model.positions.size();
  report["vnunref"] = static_cast<int64_t>(analysis.model.positions.size()) - vertices;
  report["vndup"] = count_duplicate_positions(analysis.model.positions);
  report["en"] = edges;
  report["en_b"] = count_boundary(analysis.raw_edges);
  report["nonmanif_edge"] = bad_edges;
  report["nonmanif_vert"] = bad_vertices;
  report["connected_components"] = component_count;
  report["largest_component_fn"] =
      components.empty() ? 0 : *std::max_element(components.begin(), components.end());
  report["euler"] = vertices - edges + faces;
  report["boundary_components"] = loops;
  report["boundary_loops"] = manifold ? loops : -1;
  report["genus"] = manifold ? -(vertices + faces - edges + loops - 2 * component_count) / 2 : -1;
}

void report_orientation(json& report, const Analysis& analysis) {
  report["oriented"] = is_oriented(analysis.raw_edges);
  report["orientable"] =
      make_coherent(analysis.raw_edges, analysis.faces.size()).contradictions.empty();
}

// ---- Atlas measures ----

bool has_both_areas(const FaceFacts& face) {
  return face.area != 0 && face.signed_uv_area != 0;
}

struct Chart {
  Wide total_signed = 0;
  Wide total_absolute = 0;
  int64_t positive_faces = 0;
  int64_t negative_faces = 0;
  bool orientable = true;
};

std::map<int64_t, Chart> charts_of(const Analysis& analysis) {
  const Coherence coherence = make_coherent(analysis.uv_edges, analysis.faces.size());
  std::map<int64_t, Chart> charts;
  for (const int64_t face : coherence.contradictions) {
    charts[analysis.faces[static_cast<size_t>(face)].chart].orientable = false;
  }
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    const FaceFacts& face = analysis.faces[f];
    if (!face.welded) continue;
    Chart& chart = charts[face.chart];
    const bool flip = chart.orientable && *coherence.flipped[f];
    const double area = flip ? -face.signed_uv_area : face.signed_uv_area;
    chart.total_signed += area;
    chart.total_absolute += std::abs(area);
    if (area > 0) ++chart.positive_faces;
    if (area < 0) ++chart.negative_faces;
  }
  return charts;
}

int64_t folds_of(const Chart& chart) {
  if (abs(chart.total_signed) <= Wide(1e-9) * chart.total_absolute) {
    return std::min(chart.positive_faces, chart.negative_faces);
  }
  return chart.total_signed > 0 ? chart.negative_faces : chart.positive_faces;
}

void report_charts(json& report, const std::map<int64_t, Chart>& charts) {
  int64_t null_charts = 0, folds = 0, non_orientable = 0;
  for (const auto& [number, chart] : charts) {
    if (chart.total_absolute == 0) ++null_charts;
    if (!chart.orientable) ++non_orientable;
    folds += folds_of(chart);
  }
  report["num_charts"] = charts.size();
  report["num_null_charts"] = null_charts;
  report["nfolds"] = folds;
  report["charts_nonorientable"] = non_orientable;
}

Wide boundary_length_uv(const Analysis& analysis) {
  std::vector<double> lengths;
  for (const auto& [edge, uses] : analysis.uv_edges) {
    const FaceFacts& face = analysis.faces[static_cast<size_t>(uses.front().face)];
    if (uses.size() != 1 || !face.has_uv_triangle) continue;
    const auto k = static_cast<size_t>(uses.front().corner);
    lengths.push_back(texel_distance(face.texels[k], face.texels[(k + 1) % 3]));
  }
  return exact_sum(lengths);
}

Wide total_uv_area(const Analysis& analysis) {
  Wide sum = 0;
  for (const FaceFacts& face : analysis.faces) sum += std::abs(face.signed_uv_area);
  return sum;
}

void report_uv_sizes(json& report, const Analysis& analysis) {
  const Wide area = total_uv_area(analysis);
  const Wide boundary = boundary_length_uv(analysis);
  const Wide circle = sqrt(Wide(4 * std::numbers::pi) * area);
  report["en_uv"] = analysis.uv_edges.size();
  report["en_uv_b"] = count_boundary(analysis.uv_edges);
  report["area_uv"] = rounded(area);
  report["boundary_len_uv"] = rounded(boundary);
  report["crumbliness"] = ratio(boundary, circle);
  report["solidity"] = area == 0 ? json(nullptr) : ratio(circle, boundary);
}

json mapped_fraction(const Analysis& analysis) {
  Wide mapped = 0, all = 0;
  for (const FaceFacts& face : analysis.faces) {
    if (!face.welded) continue;
    all += face.area;
    if (has_both_areas(face)) mapped += face.area;
  }
  return ratio(mapped, all);
}

void report_slots(json& report, const Model& model) {
  report["ntex"] = model.slots.size();
  report["textures"] = json::array();
  for (const Slot& slot : model.slots) report["textures"].push_back(slot.name);
}

// With the Gram matrices G of the sides a, b in space and H of the same sides d, e on the texture,
// the squared singular values of the Jacobian are the eigenvalues of H G^-1. Scaled by
// |a x b| |d x e| their sum becomes `trace` below and their product's root becomes `twice_det` / 2.
struct SingularValues {
  Wide trace;
  Wide twice_det;
};

std::array<Wide, 3> wide_difference(const Position& p, const Position& q) {
  return {Wide(p[0]) - q[0], Wide(p[1]) - q[1], Wide(p[2]) - q[2]};
}

Wide wide_dot(const std::array<Wide, 3>& a, const std::array<Wide, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

SingularValues singular_values(const std::array<Position, 3>& p, const std::array<Texel, 3>& t) {
  const auto a = wide_difference(p[1], p[0]);
  const auto b = wide_difference(p[2], p[0]);
  const auto d = wide_difference({t[1][0], t[1][1], 0}, {t[0][0], t[0][1], 0});
  const auto e = wide_difference({t[2][0], t[2][1], 0}, {t[0][0], t[0][1], 0});
  const Wide aa = wide_dot(a, a), bb = wide_dot(b, b), ab = wide_dot(a, b);
  const Wide trace = bb * wide_dot(d, d) - 2 * ab * wide_dot(d, e) + aa * wide_dot(e, e);
  const Wide det_3d_squared = aa * bb - ab * ab;
  const Wide det_uv = d[0] * e[1] - d[1] * e[0];
  return {trace, 2 * sqrt(det_3d_squared) * abs(det_uv)};
}

// (s_max + s_min)^2 and (s_max - s_min)^2 are trace ± twice_det, up to the common scale.
Wide larger_over_mean(const SingularValues& s) {
  const Wide difference = s.trace * s.trace - s.twice_det * s.twice_det;
  return s.trace + (difference > 0 ? Wide(sqrt(difference)) : Wide(0));
}

void report_distortion(json& report, const Analysis& analysis) {
  Samples qcd, conformality;
  Wide discarded = 0;
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    const FaceFacts& face = analysis.faces[f];
    if (!has_both_areas(face)) continue;
    const SingularValues s = singular_values(
        corner_positions(analysis.model, analysis.model.faces[f].vertices), face.texels);
    const Wide larger = larger_over_mean(s);
    const double stretch =
        s.twice_det == 0 ? std::numeric_limits<double>::infinity() : rounded(larger / s.twice_det);
    conformality.push_back({rounded(s.twice_det / larger), face.area});
    if (stretch < 100) qcd.push_back({stretch, face.area});
    if (stretch >= 100) discarded += face.area;
  }
  report_statistics(report, "qcd", qcd);
  report_statistics(report, "conformality", conformality);
  report["qcd_discardedArea"] = rounded(discarded);
}

void report_scale(json& report, const Analysis& analysis) {
  Wide area_3d = 0, area_uv = 0;
  for (const FaceFacts& face : analysis.faces) {
    if (!has_both_areas(face)) continue;
    area_3d += face.area;
    area_uv += std::abs(face.signed_uv_area);
  }
  Samples scale, density;
  for (const FaceFacts& face : analysis.faces) {
    if (!has_both_areas(face)) continue;
    const double uv = std::abs(face.signed_uv_area);
    scale.push_back({rounded(Wide(uv) * area_3d / (Wide(face.area) * area_uv)), face.area});
    density.push_back({std::sqrt(uv / face.area), face.area});
  }
  report_statistics(report, "texel_density", density);
  if (scale.empty()) {
    report["sf_untrimmed_avg"] = report["sf_untrimmed_var"] = nullptr;
    return;
  }
  const Wide mean = average(scale);
  report["sf_untrimmed_avg"] = rounded(mean);
  report["sf_untrimmed_var"] = rounded(mean_square(scale, mean));
}

double smallest_angle_degrees(const std::array<Position, 3>& p) {
  double smallest = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < 3; ++k) {
    const Position a = minus(p[(k + 1) % 3], p[k]);
    const Position b = minus(p[(k + 2) % 3], p[k]);
    smallest = std::min(smallest, std::atan2(length(cross(a, b)), dot(a, b)));
  }
  return smallest * (180 / std::numbers::pi);
}

void report_angles(json& report, const Analysis& analysis) {
  Samples angles;
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    const FaceFacts& face = analysis.faces[f];
    if (face.area == 0) continue;
    const auto corners = corner_positions(analysis.model, analysis.model.faces[f].vertices);
    angles.push_back({smallest_angle_degrees(corners), face.area});
  }
  report_statistics(report, "angle_min", angles);
}

bool is_seam(const Analysis& analysis, const std::vector<EdgeUse>& uses,
             const std::map<int64_t, Chart>& charts) {
  if (uses.size() != 2) return false;
  std::array<EdgeKey, 2> uv_keys;
  for (size_t i = 0; i < 2; ++i) {
    const FaceFacts& face = analysis.faces[static_cast<size_t>(uses[i].face)];
    if (charts.at(face.chart).total_absolute == 0) return false;
    uv_keys[i] = edge_key(face.uv_vertices, uses[i].corner);
  }
  return uv_keys[0] != uv_keys[1];
}

bool can_be_sampled(const Analysis& analysis, const EdgeUse& use) {
  const FaceFacts& facts = analysis.faces[static_cast<size_t>(use.face)];
  const Face& face = analysis.model.faces[static_cast<size_t>(use.face)];
  return facts.has_uv_triangle && !facts.uv_far &&
         analysis.model.slots[static_cast<size_t>(*face.slot)].readable;
}

void report_seams(json& report, const Analysis& analysis, const std::map<int64_t, Chart>& charts) {
  int64_t count = 0, unsampled = 0;
  std::vector<double> lengths;
  for (const auto& [edge, uses] : analysis.welded_edges) {
    if (!is_seam(analysis, uses, charts)) continue;
    ++count;
    lengths.push_back(edge_length(analysis.model, edge));
    if (!can_be_sampled(analysis, uses[0]) || !can_be_sampled(analysis, uses[1])) ++unsampled;
  }
  report["seam_edges"] = count;
  report["seam_len"] = rounded(exact_sum(lengths));
  report["seam_edges_unsampled"] = unsampled;
}

bool is_unmapped(const Face& face) {
  return std::any_of(face.uvs.begin(), face.uvs.end(),
                     [](const std::optional<Uv>& uv) { return !uv.has_value(); });
}

bool reaches_outside(const Face& face) {
  return std::any_of(face.uvs.begin(), face.uvs.end(), [](const std::optional<Uv>& uv) {
    return uv && ((*uv)[0] < 0 || (*uv)[0] > 1 || (*uv)[1] < 0 || (*uv)[1] > 1);
  });
}

bool is_untextured(const Model& model, const Face& face) {
  return !face.slot || !model.slots[static_cast<size_t>(*face.slot)].size;
}

void report_mapping_counts(json& report, const Analysis& analysis) {
  int64_t unmapped = 0, untextured = 0, outside = 0;
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    const Face& face = analysis.model.faces[f];
    if (!analysis.faces[f].raw) continue;
    unmapped += is_unmapped(face);
    untextured += is_untextured(analysis.model, face);
    outside += reaches_outside(face);
  }
  report["faces_unmapped"] = unmapped;
  report["faces_untextured"] = untextured;
  report["faces_uv_outside"] = outside;
  report["uv_far"] = count_faces(analysis, [](const FaceFacts& f) { return f.uv_far; });
}

}  // namespace

Model read_obj(const std::string& obj_path, const Options& options) {
  const std::vector<Statement> statements = read_statements(obj_path, Backslash::kContinues);
  const ObjContent obj = parse_obj(statements);
  Model model;
  model.name = fs::path(obj_path).filename().string();
  model.positions = obj.positions;
  const auto slot_of = make_slots(read_materials(statements, obj_path, options), options, model);
  for (const Polygon& polygon : obj.polygons) {
    if (!is_valid(polygon, obj)) {
      ++model.invalid_polygons;
      continue;
    }
    std::optional<int64_t> slot;
    if (!model.with_images) slot = 0;
    if (polygon.material && slot_of.contains(*polygon.material)) {
      slot = slot_of.at(*polygon.material);
    }
    add_fan(polygon, obj, slot, model.faces);
  }
  return model;
}

Analysis analyse(Model model) {
  Analysis analysis;
  analysis.faces.resize(model.faces.size());
  analysis.model = std::move(model);
  sort_out_levels(analysis);
  place_uvs(analysis);
  split_into_uv_vertices(analysis);
  collect_edges(analysis);
  number_charts(analysis);
  return analysis;
}

json measure(const Analysis& analysis) {
  const std::map<int64_t, Chart> charts = charts_of(analysis);
  json report;
  report["mesh"] = analysis.model.name;
  report_face_counts(report, analysis);
  report_topology(report, analysis);
  report_sizes(report, analysis);
  report_orientation(report, analysis);
  report_slots(report, analysis.model);
  report_charts(report, charts);
  report_uv_sizes(report, analysis);
  report["mapped_fraction"] = mapped_fraction(analysis);
  report_distortion(report, analysis);
  report_scale(report, analysis);
  report_angles(report, analysis);
  report_seams(report, analysis, charts);
  report_mapping_counts(report, analysis);
  return report;
}

json measure_obj(const std::string& obj_path, const Options& options) {
  return measure(analyse(read_obj(obj_path, options)));
}

}  // namespace atlasgauge::oracle
