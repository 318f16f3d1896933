#include "io/texture/library_names.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "io/obj/obj_numbers.hpp"

namespace atlasgauge {
namespace {

using Exists = std::function<bool(const std::string& name)>;

/// Longer runs of words are not tried as one name, so that the number of look-ups stays within so
/// many a word.
constexpr std::size_t kMaxWordsInName = 64;

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  const char* p = text.data();
  const char* const end = p + text.size();
  while ((p = std::find_if_not(p, end, is_blank)) != end) {
    const char* const word_end = std::find_if(p, end, is_blank);
    words.emplace_back(p, static_cast<std::size_t>(word_end - p));
    p = word_end;
  }
  return words;
}

std::string with_slashes(std::string_view text) {
  std::string name(text);
  std::ranges::replace(name, '\\', '/');
  return name;
}

/// Without the backslashes before spaces.
std::string unescaped(std::string_view text) {
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escapes = text[i] == '\\' && i + 1 < text.size() && text[i + 1] == ' ';
    if (!escapes) name += text[i];
  }
  return with_slashes(name);
}

std::string_view unquoted(std::string_view text) {
  const bool in_quotes = text.size() > 1 && text.front() == '"' && text.back() == '"';
  return in_quotes ? text.substr(1, text.size() - 2) : text;
}

/// The text as a name, in the order in which they are tried.
std::array<std::string, 3> spellings_of(std::string_view text) {
  return {with_slashes(text), unescaped(text), with_slashes(unquoted(text))};
}

/// The text as the name of a file that exists.
std::optional<std::string> existing_name(std::string_view text, const Exists& exists) {
  for (const std::string& name : spellings_of(text)) {
    if (!name.empty() && exists(name)) return name;
  }
  return std::nullopt;
}

/// Words [first, first + count) with what stands between them.
std::string_view run_of(const std::vector<std::string_view>& words, std::size_t first,
                        std::size_t count) {
  const char* const begin = words[first].data();
  const std::string_view last = words[first + count - 1];
  return {begin, static_cast<std::size_t>(last.data() + last.size() - begin)};
}

/// The longest run of words from `first` on that names a file.
struct Run {
  std::string name;
  std::size_t words;
};

std::optional<Run> longest_run(const std::vector<std::string_view>& words, std::size_t first,
                               const Exists& exists) {
  for (std::size_t count = std::min(kMaxWordsInName, words.size() - first); count > 0; --count) {
    if (auto name = existing_name(run_of(words, first, count), exists)) return Run{*name, count};
  }
  return std::nullopt;
}

}  // namespace

LibraryNames split_library_names(std::string_view text, const Exists& exists) {
  if (const auto whole = existing_name(text, exists)) return {{*whole}, {}};
  const std::vector<std::string_view> words = words_of(text);
  LibraryNames names;
  std::size_t missing = 0;  // words before `first`
  for (std::size_t first = 0; first <= words.size();) {
    const bool at_end = first == words.size();
    const std::optional<Run> run = at_end ? std::nullopt : longest_run(words, first, exists);
    if ((run || at_end) && missing != 0) {
      names.missing.emplace_back(run_of(words, first - missing, missing));
      missing = 0;
    }
    if (run) names.found.push_back(run->name);
    missing += run ? 0 : 1;
    first += run ? run->words : 1;
  }
  return names;
}

std::vector<std::string> possible_library_names(std::string_view missing) {
  std::vector<std::string_view> texts = words_of(missing);
  if (texts.size() != 1) texts.insert(texts.begin(), missing);
  std::vector<std::string> names;
  for (const std::string_view text : texts) {
    for (const std::string& name : spellings_of(text)) {
      const bool is_new = names.empty() || names.back() != name;
      if (!name.empty() && is_new) names.push_back(name);
    }
  }
  return names;
}

}  // namespace atlasgauge
