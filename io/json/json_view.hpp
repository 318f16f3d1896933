#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace atlasgauge {

class JsonElements;

/// A value of a document that someone else wrote, with its place in it for messages:
/// "accessors[3].count". Every access throws Error(kInput) where the value is of another kind.
class JsonView {
 public:
  /// All three outlive the view, and those taken from it.
  JsonView(const nlohmann::json& document, const std::string& path);

  /// A member of an object, or nothing without it.
  std::optional<JsonView> find(const char* key) const;
  /// A member that must be there.
  JsonView at(const char* key) const;
  /// The elements of the array that is a member, none without it.
  JsonElements elements(const char* key) const;
  /// The names of the members of an object.
  std::vector<std::string> keys() const;

  bool is_object() const;
  /// Not negative and without a fraction.
  std::uint64_t whole() const;
  std::uint32_t index() const;
  double number() const;
  bool flag() const;
  const std::string& text() const;
  /// Exactly `count` numbers.
  std::vector<double> numbers(std::size_t count) const;

  std::uint64_t whole_or(const char* key, std::uint64_t otherwise) const;
  bool flag_or(const char* key, bool otherwise) const;
  std::string text_or(const char* key, const char* otherwise) const;

  /// Throws Error(kInput) that begins with the place of the value.
  [[noreturn]] void refuse(const std::string& text) const;

 private:
  JsonView(const nlohmann::json& value, const std::string& path, std::string place);

  const nlohmann::json* value_;
  const std::string* path_;
  std::string place_;

  friend class JsonElements;
};

/// The elements of an array, for a loop.
class JsonElements {
 public:
  class Iterator {
   public:
    Iterator(const JsonElements& elements, std::size_t index)
        : elements_(&elements), index_(index) {}
    JsonView operator*() const { return (*elements_)[index_]; }
    Iterator& operator++() {
      ++index_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return index_ == other.index_; }

   private:
    const JsonElements* elements_;
    std::size_t index_;
  };

  /// Without an array: none.
  explicit JsonElements(std::optional<JsonView> array);

  std::size_t size() const;
  JsonView operator[](std::size_t index) const;
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

 private:
  std::optional<JsonView> array_;
};

}  // namespace atlasgauge
