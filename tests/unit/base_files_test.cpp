// Files appear whole or not at all; hashes are the published ones.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"

namespace pellucid {
namespace {

namespace fs = std::filesystem;

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("pellucid-files-" + std::to_string(getpid()) + "-" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::ptrdiff_t entries() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }
  std::string error_of(const std::string& name) const {
    try {
      write_text_atomic(name, "x");
    } catch (const OutputError& error) {
      return error.what();
    }
    return "";
  }
  fs::path folder_;
};

TEST_F(Files, NothingIsSeenBeforeCommit) {
  write_text_atomic(path("a.txt"), "old");
  AtomicFile file(path("a.txt"));
  file.write("new", 3);
  EXPECT_EQ(read_text(path("a.txt")), "old");
  EXPECT_EQ(fs::path(file.temporary()).parent_path(), folder_);
  EXPECT_EQ(fs::path(file.temporary()).extension(), ".txt");
  file.commit();
  EXPECT_EQ(read_text(path("a.txt")), "new");
  EXPECT_EQ(entries(), 1);
}

TEST_F(Files, WithoutCommitNothingChanges) {
  write_text_atomic(path("a"), "old");
  { AtomicFile(path("a")).write("new", 3); }
  { AtomicFile(path("b")).write("new", 3); }
  EXPECT_EQ(read_text(path("a")), "old");
  EXPECT_EQ(entries(), 1);
}

TEST_F(Files, LinksStayLinks) {
  write_text_atomic(path("target"), "old");
  fs::create_symlink("target", path("link"));
  write_text_atomic(path("link"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(read_text(path("target")), "new");
}

TEST_F(Files, DevicesAreWrittenInPlace) {
  write_text_atomic("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_NE(error_of("/dev/full").find("No space left"), std::string::npos)
      << error_of("/dev/full");
}

TEST_F(Files, FailuresNameFileAndReason) {
  EXPECT_EQ(error_of(path("no/a")),
            "cannot write '" + path("no/a") + "': No such file or directory");
  EXPECT_EQ(error_of(folder_.string()), "cannot write '" + folder_.string() + "': Is a directory");
  EXPECT_NE(error_of(""), "");
  EXPECT_THROW(read_text(path("none")), InputError);
  EXPECT_THROW(read_text(folder_.string()), InputError);
}

TEST_F(Files, FullDiskLeavesNothing) {
  struct rlimit old;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  signal(SIGXFSZ, SIG_IGN);
  const struct rlimit small = {100, old.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_THROW(write_text_atomic(path("a"), std::string(1000, 'x')), OutputError);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
  signal(SIGXFSZ, SIG_DFL);
  EXPECT_EQ(entries(), 0);
}

TEST_F(Files, LongNamesHaveShortTemporaries) {
  const std::string name(255, 'n');
  write_text_atomic(path(name), "x");
  EXPECT_EQ(read_text(path(name)), "x");
}

TEST(Executable, IsThisTest) {
  EXPECT_TRUE(fs::is_regular_file(executable_path())) << executable_path();
}

TEST(Hash, IsXxh3With128Bits) {
  // Printed by `printf '' | xxhsum -H2` and `printf abc | xxhsum -H2`.
  EXPECT_EQ(hash_hex(""), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(hash_hex("abc"), "06b05ab6733a618578af5f94892f3950");
}

TEST(Hash, DoesNotSeeHowDataWereCut) {
  const std::string text(100000, 'q');
  Hasher hasher;
  for (std::size_t at = 0; at < text.size(); at += 777)
    hasher.add(std::string_view(text).substr(at, 777));
  EXPECT_EQ(hasher.hex(), hash_hex(text));
}

}  // namespace
}  // namespace pellucid
