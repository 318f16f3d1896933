#include "io/tiles/tileset.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "io/file/uri.hpp"
#include "io/json/json_affine.hpp"
#include "io/json/json_view.hpp"

namespace atlasgauge {
namespace {

constexpr const char* kImplicitExtension = "3DTILES_implicit_tiling";
constexpr const char* kContentsExtension = "3DTILES_multiple_contents";

/// In the order of the alphabet.
constexpr std::array<std::string_view, 16> kMembers = {"3DTILES_implicit_tiling",
                                                       "3DTILES_multiple_contents",
                                                       "asset",
                                                       "children",
                                                       "content",
                                                       "contents",
                                                       "extensions",
                                                       "extensionsRequired",
                                                       "gltfUpAxis",
                                                       "implicitTiling",
                                                       "refine",
                                                       "root",
                                                       "transform",
                                                       "uri",
                                                       "url",
                                                       "version"};

constexpr std::array<std::string_view, 6> kHarmlessExtensions = {"3DTILES_content_gltf",
                                                                 "3DTILES_multiple_contents",
                                                                 "3DTILES_metadata",
                                                                 "3DTILES_bounding_volume_S2",
                                                                 "3DTILES_batch_table_hierarchy",
                                                                 "3DTILES_draco_point_compression"};

bool equals(std::string_view text, std::string_view small_letters) {
  return std::ranges::equal(text, small_letters, [](char a, char b) {
    return a == b || (a >= 'A' && a <= 'Z' && a - 'A' + 'a' == b);
  });
}

UpAxis parse_up(const JsonView& axis) {
  if (equals(axis.text(), "x")) return UpAxis::kX;
  if (equals(axis.text(), "y")) return UpAxis::kY;
  if (equals(axis.text(), "z")) return UpAxis::kZ;
  axis.refuse("expected \"X\", \"Y\" or \"Z\"");
}

/// What children take over from a tile.
struct Inherited {
  std::uint32_t depth;
  std::uint32_t transform;
  bool adds;
};

/// Flattens the tree of tiles. JSON is never nested so deep that recursion could overflow.
class Flattening {
 public:
  explicit Flattening(bool adds) : adds_(adds) { tileset_.transforms.emplace_back(); }

  Tileset run(const JsonView& root) {
    add(root, {0, 0, adds_});
    return std::move(tileset_);
  }

 private:
  void add(const JsonView& tile, const Inherited& parent) {
    refuse_implicit(tile);
    const auto index = static_cast<std::uint32_t>(tileset_.tiles.size());
    const Inherited own{parent.depth, transform_of(tile, parent.transform),
                        adds_of(tile, parent.adds)};
    Tile added;
    added.depth = own.depth;
    added.transform = own.transform;
    added.adds = own.adds;
    added.first_content = static_cast<std::uint32_t>(tileset_.contents.size());
    add_contents(tile);
    added.contents = static_cast<std::uint32_t>(tileset_.contents.size()) - added.first_content;
    tileset_.tiles.push_back(added);
    for (const JsonView& child : tile.elements("children")) {
      add(child, {own.depth + 1, own.transform, own.adds});
    }
    tileset_.tiles[index].end = static_cast<std::uint32_t>(tileset_.tiles.size());
  }

  static void refuse_implicit(const JsonView& tile) {
    const std::optional<JsonView> extensions = tile.find("extensions");
    const bool is_implicit = tile.find("implicitTiling").has_value() ||
                             (extensions && extensions->find(kImplicitExtension));
    if (!is_implicit) return;
    tile.refuse(
        "found implicit tiling, which is not read here; convert the tileset to one that "
        "lists its tiles");
  }

  std::uint32_t transform_of(const JsonView& tile, std::uint32_t parent) {
    const std::optional<JsonView> matrix = tile.find("transform");
    if (!matrix) return parent;
    const Affine own = affine_from(*matrix);
    if (own.is_identity()) return parent;
    tileset_.transforms.push_back(tileset_.transforms[parent] * own);
    return static_cast<std::uint32_t>(tileset_.transforms.size() - 1);
  }

  /// Older tilesets write it in small letters.
  static bool adds_of(const JsonView& tile, bool parent) {
    const std::optional<JsonView> refine = tile.find("refine");
    if (!refine) return parent;
    if (equals(refine->text(), "add")) return true;
    if (equals(refine->text(), "replace")) return false;
    refine->refuse("expected \"ADD\" or \"REPLACE\"");
  }

  void add_contents(const JsonView& tile) {
    if (const std::optional<JsonView> content = tile.find("content")) add_content(*content);
    for (const JsonView& content : tile.elements("contents")) add_content(content);
    const std::optional<JsonView> extensions = tile.find("extensions");
    const std::optional<JsonView> several =
        extensions ? extensions->find(kContentsExtension) : std::nullopt;
    if (!several) return;
    for (const char* const key : {"content", "contents"}) {
      for (const JsonView& content : several->elements(key)) add_content(content);
    }
  }

  void add_content(const JsonView& content) {
    const std::optional<JsonView> uri = content.find("uri");
    tileset_.contents.push_back(uri ? uri->text() : content.at("url").text());
  }

  bool adds_;
  Tileset tileset_;
};

void check_extensions(const JsonView& document) {
  for (const JsonView& name : document.elements("extensionsRequired")) {
    if (std::ranges::find(kHarmlessExtensions, name.text()) != kHarmlessExtensions.end()) continue;
    // Said where it is used.
    if (name.text() == kImplicitExtension) continue;
    name.refuse("the tileset requires the extension " + shown_uri(name.text()) +
                ", which is not known here; convert it to one without");
  }
}

void check_version(const JsonView& document) {
  if (!document.is_object() || !document.find("asset") || !document.find("root")) {
    document.refuse("found no \"asset\" and \"root\", so this is no tileset of 3D Tiles");
  }
  const std::string version = document.at("asset").text_or("version", "1.0");
  if (version.starts_with("0.") || version.starts_with("1.")) return;
  document.at("asset").refuse("found 3D Tiles " + shown_uri(version) + ", expected 1.0 or 1.1");
}

}  // namespace

Affine to_z_up(UpAxis up) {
  switch (up) {
    case UpAxis::kX:
      return {{0, 0, 1, 0, 1, 0, -1, 0, 0, 0, 0, 0}};
    case UpAxis::kY:
      return {{1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0}};
    case UpAxis::kZ:
      break;
  }
  return {};
}

bool is_tileset_member(std::string_view key) {
  return std::ranges::binary_search(kMembers, key);
}

Tileset parse_tileset(const nlohmann::json& json, const std::string& path,
                      const InheritedTile& inherited) {
  const JsonView document(json, path);
  check_version(document);
  check_extensions(document);
  Tileset tileset = Flattening(inherited.adds).run(document.at("root"));
  const std::optional<JsonView> up = document.at("asset").find("gltfUpAxis");
  if (up) tileset.up = parse_up(*up);
  return tileset;
}

}  // namespace atlasgauge
