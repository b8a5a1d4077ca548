// Images keep every bit through EXR, and damaged files or full disks end in errors, not in crashes.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "base/error.h"
#include "base/files.h"
#include "image/image.h"
#include "image/tonemap.h"

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace pellucid {
namespace {

namespace fs = std::filesystem;

class ImageFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("pellucid-image-" + std::to_string(getpid()) + "-" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_))
      found.push_back(entry.path().filename().string());
    std::sort(found.begin(), found.end());
    return found;
  }
  fs::path folder_;
};

/// Values from 1e-8 to 1e8 with full mantissas.
Image sample(int width, int height, std::vector<std::string> channels) {
  Image image;
  image.width = width;
  image.height = height;
  image.channels = std::move(channels);
  const std::size_t count = std::size_t(width) * std::size_t(height) * image.channels.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double place = static_cast<double>(i) / static_cast<double>(count - 1);
    image.data.push_back(static_cast<float>(std::pow(10.0, -8.0 + 16.0 * place)));
  }
  return image;
}

std::string error_of_reading(const std::string& path) {
  try {
    read_image(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string error_of_writing(const std::string& path, const Image& image) {
  try {
    write_image(path, image);
  } catch (const OutputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(ImageFile, ExrKeepsEveryBitAndTheOrderOfChannels) {
  const Image image = sample(37, 19, {"R", "G", "B", "variance.R", "Z", "id.object", "P.X", "A0"});
  write_image(path("a.exr"), image);
  const Image back = read_image(path("a.exr"));
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.height, 19);
  EXPECT_EQ(back.channels, image.channels);
  ASSERT_EQ(back.data.size(), image.data.size());
  EXPECT_EQ(0, std::memcmp(back.data.data(), image.data.data(), image.data.size() * sizeof(float)));
  EXPECT_EQ(names(), std::vector<std::string>{"a.exr"});
}

TEST_F(ImageFile, ExrKeepsWhatIsNotFinite) {
  Image image = sample(4, 2, {"R", "G", "B"});
  image.data[0] = std::numeric_limits<float>::quiet_NaN();
  image.data[4] = std::numeric_limits<float>::infinity();
  image.data[8] = -std::numeric_limits<float>::infinity();
  image.data[9] = std::numeric_limits<float>::denorm_min();
  write_image(path("a.exr"), image);
  const Image back = read_image(path("a.exr"));
  EXPECT_TRUE(std::isnan(back.data[0]));
  EXPECT_EQ(back.data[4], image.data[4]);
  EXPECT_EQ(back.data[8], image.data[8]);
  EXPECT_EQ(back.data[9], image.data[9]);
}

TEST_F(ImageFile, ExrKeepsMetadata) {
  Image image = sample(2, 2, {"R", "G", "B"});
  std::vector<float> matrix(16);
  for (int i = 0; i < 16; ++i) matrix[std::size_t(i)] = 0.1f * static_cast<float>(i) - 0.7f;
  std::vector<float> other = matrix;
  std::reverse(other.begin(), other.end());
  image.metadata = {{"samplesPerPixel", 64},
                    {"renderTimeSeconds", 1.25f},
                    {"pellucid:seed", std::string("18446744073709551615")},
                    {"pellucid:version", std::string("0.1.0 \"quoted\" / umlaut \xc3\xa4")},
                    {"worldToCamera", matrix},
                    {"worldToNDC", other}};
  write_image(path("a.exr"), image);
  const Image back = read_image(path("a.exr"));
  for (const auto& [name, value] : image.metadata) {
    ASSERT_EQ(back.metadata.count(name), 1u) << name;
    EXPECT_EQ(back.metadata.at(name), value) << name;
  }
}

TEST_F(ImageFile, EqualImagesGiveEqualFiles) {
  const Image image = sample(5, 5, {"R", "G", "B"});
  write_image(path("a.exr"), image);
  sleep(1);  // the image library would add the time of day
  write_image(path("b.exr"), image);
  EXPECT_TRUE(read_text(path("a.exr")) == read_text(path("b.exr")));
}

TEST_F(ImageFile, KnownGreySurvivesTheChainToPng) {
  Image linear;
  linear.width = 64;
  linear.height = 1;
  linear.channels = {"R", "G", "B", "Z"};
  for (int x = 0; x < 64; ++x)
    for (int c = 0; c < 4; ++c) linear.data.push_back(static_cast<float>(x) / 63.0f);
  linear.data[0] = 0.18f;
  write_image(path("a.png"), to_display(linear));
  const Image stored = read_image(path("a.png"));
  ASSERT_EQ(stored.channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_NEAR(stored.data[0] * 255.0f, 118.0f, 0.5f);  // 18 % grey is 117.6 in sRGB
  const Image back = read_image(path("a.png"), true);
  for (int x = 1; x < 64; ++x) {
    const float before = srgb_encode(linear.data[std::size_t(4 * x)]);
    EXPECT_NEAR(srgb_encode(back.data[std::size_t(3 * x)]), before, 0.5f / 255.0f + 1e-6f) << x;
  }
}

TEST_F(ImageFile, PngTakesColoursOnlyAndClips) {
  Image image = sample(1, 1, {"Z", "B", "G", "R"});
  image.data = {7.0f, -1.0f, 2.0f, std::numeric_limits<float>::quiet_NaN()};
  write_image(path("a.png"), image);
  const Image back = read_image(path("a.png"));
  EXPECT_EQ(back.channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(back.data, (std::vector<float>{0.0f, 1.0f, 0.0f}));
}

/// libpng leaves OpenImageIO by longjmp over destructors: leaks of theirs, not ours.
struct ForgiveLeaks {
#ifdef __SANITIZE_ADDRESS__
  __lsan::ScopedDisabler scope;
#endif
};

/// Every type of picture that pellucid writes, or reads in tests of others.
const char* const picture_types[] = {".exr", ".png", ".hdr", ".tif", ".jpg",
                                     ".bmp", ".tga", ".ppm", ".webp"};

TEST_F(ImageFile, TruncatedAtTwentyPlacesIsAnError) {
  const Image image = sample(64, 64, {"R", "G", "B", "Z"});
  [[maybe_unused]] const ForgiveLeaks forgive;
  for (const std::string suffix : picture_types) {
    write_image(path("whole" + suffix), image);
    const std::string bytes = read_text(path("whole" + suffix));
    for (std::size_t i = 0; i < 20; ++i) {
      const std::string name = path("cut" + suffix);
      write_text_atomic(name, std::string_view(bytes).substr(0, i * bytes.size() / 20));
      const std::string message = error_of_reading(name);
      EXPECT_NE(message.find(name), std::string::npos) << suffix << " part " << i << message;
      EXPECT_GT(message.size(), name.size() + 20) << "no reason: " << message;
    }
  }
}

TEST_F(ImageFile, CorruptedBytesNeverCrash) {
  [[maybe_unused]] const ForgiveLeaks forgive;
  for (const std::string suffix : picture_types) {
    write_image(path("whole" + suffix), sample(16, 16, {"R", "G", "B"}));
    const std::string bytes = read_text(path("whole" + suffix));
    const std::size_t header = 64;  // where sizes and offsets stand: every byte of it
    for (std::size_t i = 0; i < bytes.size(); i += i < header ? 1 : 37) {
      SCOPED_TRACE(suffix + " byte " + std::to_string(i));
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(~damaged[i]);
      write_text_atomic(path("damaged" + suffix), damaged);
      error_of_reading(path("damaged" + suffix));  // an error or a picture, both are fine
    }
  }
}

TEST_F(ImageFile, AbsurdSizesAreRefusedBeforeMemoryIsTaken) {
  write_text_atomic(path("a.ppm"), "P6 60000 60000 255\nabc");
  write_text_atomic(path("a.pfm"), "PF\n2000000000 2000000000\n-1.0\nabc");
  write_text_atomic(path("a.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\nabc");
  for (const char* name : {"a.ppm", "a.pfm", "a.hdr"})
    EXPECT_NE(error_of_reading(path(name)).find(name), std::string::npos);
  EXPECT_NE(error_of_reading(path("a.ppm")).find("60000x60000"), std::string::npos);
}

TEST_F(ImageFile, WhatCannotBeReadIsNamedWithItsReason) {
  EXPECT_NE(error_of_reading(path("none.exr")).find("No such file"), std::string::npos);
  EXPECT_NE(error_of_reading(folder_.string()).find("Is a directory"), std::string::npos);
  write_text_atomic(path("empty.exr"), "");
  EXPECT_NE(error_of_reading(path("empty.exr")).find("empty"), std::string::npos);
  write_text_atomic(path("text.exr"), "this is no picture");
  EXPECT_NE(error_of_reading(path("text.exr")), "");
  EXPECT_NE(error_of_reading("/dev/zero").find("a device"), std::string::npos);
}

TEST_F(ImageFile, WhatCannotBeWrittenIsNamedWithItsReason) {
  const Image image = sample(2, 2, {"R", "G", "B"});
  EXPECT_NE(error_of_writing(path("no/a.exr"), image).find("No such file"), std::string::npos);
  EXPECT_NE(error_of_writing(folder_.string(), image).find("Is a directory"), std::string::npos);
  const std::string unknown = error_of_writing(path("a.foo"), image);
  EXPECT_NE(unknown.find(path("a.foo")), std::string::npos) << unknown;
  EXPECT_EQ(unknown.find(".pellucid-"), std::string::npos) << unknown;
  EXPECT_TRUE(names().empty());
}

/// A limit on the size of files stands for a full disk: writing fails in the middle.
TEST_F(ImageFile, FullDiskLeavesTheOldFileAndNothingElse) {
  Image image = sample(256, 256, {"R", "G", "B"});
  std::uint32_t state = 1;  // noise does not compress
  for (float& value : image.data) {
    state = state * 1664525u + 1013904223u;
    value = static_cast<float>(state) / 4294967296.0f;
  }
  struct rlimit old;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  signal(SIGXFSZ, SIG_IGN);
  for (const std::string name : {"a.exr", "a.png", "a.pfm", "a.hdr", "a.tif", "a.jpg"}) {
    write_text_atomic(path(name), "old");
    const struct rlimit small = {20000, old.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const std::string message = error_of_writing(path(name), image);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
    EXPECT_NE(message.find(path(name)), std::string::npos) << name << ": " << message;
    EXPECT_TRUE(read_text(path(name)) == "old") << name;
    EXPECT_EQ(names(), std::vector<std::string>{name});
    fs::remove(path(name));
  }
  signal(SIGXFSZ, SIG_DFL);
}

}  // namespace
}  // namespace pellucid
