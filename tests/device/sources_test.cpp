// The source expander: includes once, line markers, errors that name the place.
#include "cl/sources.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"

namespace pellucid {
namespace {

class SourcesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = ::testing::TempDir() + "pellucid_sources";
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ + "/" + name) << text;
  }
  std::string folder_;
};

TEST_F(SourcesTest, EveryFileOnceWithItsLines) {
  write("a.cl", "first\n#include \"b.h\"\n#include \"b.h\"\nlast\n");
  write("b.h", "inner\n");
  const std::string text = KernelFiles(folder_).expand("a.cl", "#define X 1\n");
  EXPECT_EQ(text,
            "#define X 1\n#line 1 \"a.cl\"\nfirst\n#line 1 \"b.h\"\ninner\n#line 3 \"a.cl\"\n"
            "#line 4 \"a.cl\"\nlast\n");
}

TEST_F(SourcesTest, FilesOfAnOverlayStandInForOthers) {
  write("a.cl", "#include \"b.h\"\n#include \"c.h\"\n");
  write("b.h", "ours\n");
  write("c.h", "shared\n");
  std::filesystem::create_directories(folder_ + "/other");
  write("other/b.h", "theirs\n");
  const std::string text = KernelFiles(folder_, "other").expand("a.cl", "");
  EXPECT_NE(text.find("theirs"), std::string::npos);
  EXPECT_EQ(text.find("ours"), std::string::npos);
  EXPECT_NE(text.find("shared"), std::string::npos);
  EXPECT_NE(KernelFiles("", "naive").read("geom/triangle.h"),
            KernelFiles().read("geom/triangle.h"));
  EXPECT_EQ(KernelFiles("", "naive").read("geom/surface.h"), KernelFiles().read("geom/surface.h"));
}

TEST_F(SourcesTest, AMissingIncludeNamesItsPlace) {
  write("a.cl", "first\n#include \"gone.h\"\n");
  try {
    KernelFiles(folder_).expand("a.cl", "");
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("a.cl:2"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("gone.h"), std::string::npos) << e.what();
  }
}

TEST_F(SourcesTest, EmbeddedFilesAreThoseOnDisk) {
  const std::string disk = std::string(PELLUCID_SOURCE_DIR) + "/kernels";
  for (const char* name : {"passes/pt_mega.cl", "shared/layout.h", "bsdf/ggx.h"})
    EXPECT_EQ(KernelFiles().read(name), KernelFiles(disk).read(name)) << name;
}

}  // namespace
}  // namespace pellucid
