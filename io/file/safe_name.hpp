#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace atlasgauge {

/// A name for a file about a texture, safe whatever the model names it: "0003_wood.exr" for number
/// 3, "textures\\wood.jpg" and ".exr". Of letters, digits, '.', '_' and '-' of ASCII, without a
/// path, at most 80 bytes longer than the suffix; another one for each number.
std::string safe_file_name(std::size_t number, std::string_view texture, std::string_view suffix);

}  // namespace atlasgauge
