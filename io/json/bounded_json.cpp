#include "io/json/bounded_json.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

using Json = nlohmann::json;

/// What a value takes at most, in an array that has just grown, and what a container or the member
/// of an object takes besides (allocator's overhead included).
constexpr std::uint64_t kValueBytes = 3 * sizeof(Json);
constexpr std::uint64_t kContainerBytes = 96;
constexpr std::uint64_t kMemberBytes = 128;
constexpr std::uint64_t kStringBytes = 64;

[[noreturn]] void refuse_size(const std::string& path, std::uint64_t limit) {
  throw Error(
      ErrorKind::kResource, path, 0,
      fmt::format("its JSON takes more than {} bytes of memory, the limit; allow more memory, "
                  "move embedded data to files of their own, or split the model",
                  limit));
}

/// The parser's text without its tags, and not all of a long token.
std::string fault_text(const std::string& what) {
  constexpr std::size_t kShownBytes = 200;
  const std::size_t tag_end = what.find("] ");
  std::string text = tag_end == std::string::npos ? what : what.substr(tag_end + 2);
  if (text.size() > kShownBytes) text = text.substr(0, kShownBytes) + "...";
  return text;
}

/// Builds the wanted part of a document, and counts what it takes.
class Builder : public nlohmann::json_sax<Json> {
 public:
  Builder(const std::string& path, const JsonLimits& limits, std::uint64_t text_bytes,
          KeepMember keep)
      : path_(path), limits_(limits), bytes_(text_bytes), keep_(keep) {}

  Json take() { return std::move(root_); }

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t& /*text*/) override { return put(value); }
  bool binary(binary_t& /*value*/) override { return false; }

  bool string(string_t& value) override {
    if (is_wanted()) count(kStringBytes + value.size());
    return put(std::move(value));
  }

  bool start_object(std::size_t /*elements*/) override { return open(Json::object()); }
  bool start_array(std::size_t /*elements*/) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Json* const object = open_.back();
    if (object == nullptr) return true;
    member_ = nullptr;
    if (!keep_(name)) return true;
    count(kMemberBytes + name.size());
    member_ = &(*object)[name];
    return true;
  }

  bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                   const nlohmann::detail::exception& fault) override {
    throw Error(ErrorKind::kInput, path_, 0, "found broken JSON: " + fault_text(fault.what()));
  }

 private:
  bool is_wanted() const {
    if (open_.empty()) return true;
    return open_.back() != nullptr && (open_.back()->is_array() || member_ != nullptr);
  }

  /// Where the value was put, or null for one that is not wanted.
  Json* place(Json value) {
    if (!is_wanted()) return nullptr;
    count(kValueBytes);
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    if (open_.back()->is_array()) {
      open_.back()->push_back(std::move(value));
      return &open_.back()->back();
    }
    *member_ = std::move(value);
    return member_;
  }

  bool put(Json value) {
    place(std::move(value));
    return true;
  }

  bool open(Json container) {
    if (open_.size() >= limits_.depth) {
      throw Error(ErrorKind::kInput, path_, 0,
                  fmt::format("found JSON nested deeper than {} levels, which no model needs",
                              limits_.depth));
    }
    Json* const placed = place(std::move(container));
    if (placed != nullptr) count(kContainerBytes);
    open_.push_back(placed);
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  void count(std::uint64_t bytes) {
    bytes_ += bytes;
    if (bytes_ > limits_.memory_bytes) refuse_size(path_, limits_.memory_bytes);
  }

  const std::string& path_;
  const JsonLimits& limits_;
  std::uint64_t bytes_;
  KeepMember keep_;
  Json root_;
  std::vector<Json*> open_;  // null for what is not wanted
  Json* member_ = nullptr;   // of the innermost object, for the value that follows
};

}  // namespace

Json parse_json(std::string_view text, const std::string& path, const JsonLimits& limits,
                KeepMember keep) {
  if (text.size() > limits.memory_bytes) refuse_size(path, limits.memory_bytes);
  Builder builder(path, limits, text.size(), keep);
  Json::sax_parse(text, &builder);
  return builder.take();
}

Json read_json(const ByteRange& range, const JsonLimits& limits, KeepMember keep) {
  if (range.size > limits.memory_bytes) refuse_size(range.path, limits.memory_bytes);
  return parse_json(read_range(range), range.path, limits, keep);
}

}  // namespace atlasgauge
