#include "io/file/module.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "io/error.hpp"
#include "io/image/image_module.hpp"
#include "tests/support/module_folder.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

class ModuleTest : public ::testing::Test {
 protected:
  void SetUp() override { show_modules(kImageModuleFile); }

  static std::string error_of(const char* file, const char* symbol) {
    try {
      module_symbol({file, "knits", "buy wool"}, symbol);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kResource);
      return error.what();
    }
    return "";
  }
};

TEST_F(ModuleTest, FindsWhatAModuleExports) {
  const Module module{kImageModuleFile, "reads images", "install it"};
  EXPECT_NE(module_symbol(module, kReadImageHeaderSymbol), nullptr);
}

TEST_F(ModuleTest, AModuleThatIsNowhereIsAnErrorThatSaysWhatToDo) {
  EXPECT_EQ(error_of("none.so", "any"),
            "cannot load none.so, which knits: it lies neither beside the program nor in "
            "../lib/atlasgauge; buy wool");
}

TEST_F(ModuleTest, AModuleThatCannotBeLoadedIsAnErrorWithTheReason) {
  const TempDir dir;
  dir.write("text.so", "no module at all");
  ASSERT_EQ(::setenv("ATLASGAUGE_MODULE_DIR", dir.path().c_str(), 1), 0);
  EXPECT_NE(error_of("text.so", "any").find("text.so: file too short; buy wool"),
            std::string::npos);
}

TEST_F(ModuleTest, ASymbolThatAModuleLacksIsAnError) {
  EXPECT_NE(error_of(kImageModuleFile, "no_such_symbol").find("undefined symbol: no_such_symbol"),
            std::string::npos);
}

}  // namespace
}  // namespace atlasgauge
