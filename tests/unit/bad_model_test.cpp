// Bad OBJ and MTL files, made from a model with every keyword: each ends in an InputError that
// names file and line, or in triangles with finite corners.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>

#include "scene/obj.h"
#include "scene/text_file.h"
#include "scene_test_support.h"
#include "support/bad_text.h"

namespace pellucid {
namespace {

const std::string folder_name = PELLUCID_SOURCE_DIR "/tests/support/everything/";

class BadModel : public ::testing::Test {
 protected:
  /// The message of the refusal; "" if the model was taken.
  std::string error_of(const std::string& obj, const std::string& mtl) const {
    folder_.write("everything.mtl", mtl);
    const std::string path = folder_.write("everything.obj", obj);
    const std::string message = test::input_error([&] { expect_finite(load_obj(path, {})); });
    EXPECT_TRUE(message.empty() || message.find(folder_.path() + "/") != std::string::npos)
        << message;
    EXPECT_LT(message.size(), 4000u) << "nobody reads that";
    return message;
  }

  static void expect_finite(const Model& model) {
    EXPECT_FALSE(model.parts.empty());
    for (const ModelPart& part : model.parts) {
      for (const glm::dvec3& p : part.mesh.positions)
        EXPECT_TRUE(std::isfinite(p.x + p.y + p.z) && std::abs(p.x) <= largest_length);
      for (const glm::dvec3& n : part.mesh.normals) EXPECT_NEAR(glm::length(n), 1.0, 1e-6);
      for (const glm::uvec3& t : part.mesh.triangles)
        for (int i = 0; i < 3; ++i) EXPECT_LT(t[i], part.mesh.positions.size());
    }
  }

  /// Every word of `text` replaced by every odd one.
  void replace_words(const std::string& text, const std::function<std::string(std::string)>& use) {
    std::size_t end = 0;
    for (std::size_t at = 0; (at = text.find_first_not_of(" \n", end)) != std::string::npos;) {
      end = std::min(text.find_first_of(" \n", at), text.size());
      const std::string was = text.substr(at, end - at);
      const bool number = was.find_first_not_of("-.0123456789e") == std::string::npos && was != "-";
      const char first = text[text.rfind('\n', at) + 1];
      const bool unread = first == '#' || first == 's';  // comments, smoothing groups
      const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
      for (const std::string& odd : odd_words()) {
        SCOPED_TRACE(std::to_string(line) + ": " + was + " as " + odd.substr(0, 60));
        const std::string message = use(test::replaced(text, {at, end}, odd));
        // An index, a position, a colour: each has to be a number that the line names.
        const bool broken = odd.find_first_not_of("+-.0123456789eE") != std::string::npos ||
                            odd == "1e38" || odd == "1e400" || odd == "-1e38";
        const bool blank = odd.empty() || std::strchr("#\n\r\t", odd[0]) != nullptr;
        if (!number || unread || !broken || blank) continue;
        EXPECT_NE(message.find(":" + std::to_string(line) + ": "), std::string::npos) << message;
      }
    }
  }

  static const std::vector<std::string>& odd_words() {
    static const std::vector<std::string> words = {"nan",
                                                   "inf",
                                                   "-inf",
                                                   "-1",
                                                   "0",
                                                   "1e38",
                                                   "-1e38",
                                                   "1e400",
                                                   "1e-320",
                                                   "99999999999999999999",
                                                   "-99999999999999999999",
                                                   "2147483648",
                                                   "-2147483648",
                                                   "x",
                                                   "",
                                                   "#",
                                                   "\\",
                                                   "0x10",
                                                   "1.5.5",
                                                   "1,5",
                                                   "/",
                                                   "//",
                                                   "1/",
                                                   "1//",
                                                   "//1",
                                                   "/1/",
                                                   "1/1/1/1",
                                                   "1/9/1",
                                                   "1//9",
                                                   "-9",
                                                   "\r",
                                                   "\t",
                                                   std::string(1, '\0'),
                                                   "\xff",
                                                   "\v",
                                                   "%s%n",
                                                   std::string(100000, '1'),
                                                   "\nt x 99999999/0/0 1\n",
                                                   "\nt x -1/-1/-1\n",
                                                   "\nl 0\n",
                                                   "\nl 99 98\n",
                                                   "\np 99\n",
                                                   "\nvw 0 9999999 1\n",
                                                   "\nf\n",
                                                   "\nf 1 2\n",
                                                   "\nusemtl\n",
                                                   "\nusemtl gone\n",
                                                   "\nmtllib\n",
                                                   "\nmtllib gone.mtl\n",
                                                   "\nmtllib /dev/zero\n",
                                                   "\nnewmtl\n",
                                                   "\nmap_Kd -o\n",
                                                   "\nmap_Kd -s 1 1 1 -bm\n"};
    return words;
  }

  test::TempFolder folder_;
  const std::string obj_ = read_text_file(folder_name + "everything.obj", "OBJ", 1 << 20);
  const std::string mtl_ = read_text_file(folder_name + "everything.mtl", "MTL", 1 << 20);
};

TEST_F(BadModel, IsGoodBeforeItIsSpoilt) {
  EXPECT_EQ(error_of(obj_, mtl_), "");
  EXPECT_EQ(error_of("\xEF\xBB\xBF" + obj_, "\xEF\xBB\xBF" + mtl_), "");
  for (const char* end : {"\r\n", "\r"}) {  // Windows, and Macintosh of old
    std::string obj, mtl;
    for (const char c : obj_) obj += c == '\n' ? end : std::string(1, c);
    for (const char c : mtl_) mtl += c == '\n' ? end : std::string(1, c);
    EXPECT_EQ(error_of(obj, mtl), "");
    const std::string message = error_of(obj + "f 1 2 99" + end, mtl);
    const auto lines = std::count(obj_.begin(), obj_.end(), '\n');
    EXPECT_NE(message.find("obj:" + std::to_string(lines + 1) + ": the face asks for vertex 99"),
              std::string::npos)
        << message;
  }
}

TEST_F(BadModel, OddWords) {
  replace_words(obj_, [&](const std::string& text) { return error_of(text, mtl_); });
  replace_words(mtl_, [&](const std::string& text) { return error_of(obj_, text); });
}

TEST_F(BadModel, DamagedFiles) {
  constexpr int cuts = 400, changes = 4000;
  test::for_each_damage(obj_, cuts, changes, [&](const std::string& what, const std::string& text) {
    SCOPED_TRACE(what);
    error_of(text, mtl_);
  });
  test::for_each_damage(mtl_, cuts, changes, [&](const std::string& what, const std::string& text) {
    SCOPED_TRACE(what);
    error_of(obj_, text);
  });
  EXPECT_NE(error_of("", mtl_).find("no faces"), std::string::npos);
  EXPECT_NE(error_of(obj_, "").find("no material \"glass\". It has none"), std::string::npos);
}

TEST_F(BadModel, CommentsBehindFacesAndNames) {
  EXPECT_EQ(error_of("mtllib everything.mtl # where\nv 0 0 0 # a\nv 1 0 0\nv 0 1 0\n"
                     "usemtl matte # grey\nf 1 2 3 # one\nf 1 3 2 # two\n",
                     mtl_),
            "");
}

TEST_F(BadModel, HugePolygonEndsSoon) {
  std::string text = "mtllib everything.mtl\nusemtl matte\n", face = "f";
  constexpr int corners = 100000;
  for (int i = 0; i < corners; ++i) {
    const double angle = 6.283185307179586 * i / corners;
    text += "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
    face += " " + std::to_string(i + 1);
  }
  const auto start = std::chrono::steady_clock::now();
  const std::string message = error_of(text + face + "\n", mtl_);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_NE(message.find("corners"), std::string::npos) << message;
}

}  // namespace
}  // namespace pellucid
