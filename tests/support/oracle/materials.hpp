#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/support/oracle/model.hpp"
#include "tests/support/oracle/text.hpp"

namespace atlasgauge::oracle {

struct Material {
  std::string image_name;
  std::string image_path;
};

struct Materials {
  std::map<std::string, Material> by_name;
  std::vector<std::string> order;
};

// The materials of all libraries that the statements of an OBJ name.
Materials read_materials(const std::vector<Statement>& statements,
                         const std::filesystem::path& obj_path, const Options& options);

// Gives the model its slots; returns the slot of each material that has one.
std::map<std::string, int64_t> make_slots(const Materials& materials, const Options& options,
                                          Model& model);

}  // namespace atlasgauge::oracle
