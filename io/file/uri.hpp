#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace atlasgauge {

/// "%20" as a blank and so on; a '%' without two hexadecimal digits stays.
std::string percent_decoded(std::string_view uri);

/// "data:image/png;base64,..." (RFC 2397).
bool is_data_uri(std::string_view uri);

/// The bytes of a data: URI, base64 or percent-encoded; nothing where its base64 is broken.
std::optional<std::string> data_uri_bytes(std::string_view uri);

/// The file that a URI names, relative to `folder`: the first that exists of the name
/// percent-decoded, as it is spelled, and either without its query ("?v=1") and fragment; else the
/// first of them. Backslashes count as slashes. Nothing where it names no file: it is empty, holds
/// a zero byte, or has a scheme ("https:").
std::optional<std::filesystem::path> file_of_uri(std::string_view uri,
                                                 const std::filesystem::path& folder);

/// A URI as a message shows it: not all of a long one.
std::string shown_uri(std::string_view uri);

}  // namespace atlasgauge
