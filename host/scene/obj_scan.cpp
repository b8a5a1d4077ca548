// A strict look over OBJ and MTL texts.
#include "scene/obj_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <set>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "scene/scene.h"
#include "scene/text_file.h"

namespace pellucid {
namespace {

/// The words of one line at a time, with errors that name the place. Lines end in LF, CR LF or CR.
/// Comments, which may stand behind other words, become blanks.
class LineReader {
 public:
  LineReader(const std::string& path, std::string& text) : path_(path), text_(text) {}

  /// Moves to the next line that has words; comments count as empty.
  bool next() {
    while (at_ < text_.size()) {
      begin_ = at_;
      end_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
      at_ = end_ + (text_.compare(end_, 2, "\r\n") == 0 ? 2 : 1);
      ++number_;
      split({text_.data() + begin_, end_ - begin_});
      if (!words_.empty()) return true;
    }
    return false;
  }
  /// Makes the line empty for whoever reads the text next.
  void blank() { std::fill(&text_[begin_], &text_[begin_] + (end_ - begin_), ' '); }

  const std::vector<std::string_view>& words() const { return words_; }
  int number() const { return number_; }
  std::string rest() const {  ///< the line after its first word, without blanks around it
    const char* begin = words_[1].data();
    return {begin, words_.back().data() + words_.back().size()};
  }

  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(fmt::format("{}:{}: {}", path_, number_, why));
  }

  /// Word i as a finite number of a size that makes sense.
  double real(std::size_t i) const {
    if (i >= words_.size())
      fail(fmt::format("\"{}\" needs {} numbers, but has {}", words_[0], i, words_.size() - 1));
    const std::string word(words_[i]);
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    const bool plain = word.find_first_not_of("+-.0123456789eE") == std::string::npos;
    if (end != word.c_str() + word.size() || !plain || !std::isfinite(value))
      fail(fmt::format("\"{}\" is not a finite number", printable(word)));
    if (std::abs(value) > largest_length)
      fail(fmt::format("{} is out of range; the most is {:g}", printable(word), largest_length));
    return value;
  }

 private:
  void split(std::string_view line) {
    words_.clear();
    constexpr const char* blanks = " \t";
    for (std::size_t start = line.find_first_not_of(blanks); start != std::string_view::npos;) {
      if (line[start] == '#')
        return std::fill(&text_[begin_ + start], &text_[begin_] + line.size(), ' ');
      const std::size_t end = std::min(line.find_first_of(blanks, start), line.size());
      words_.push_back(line.substr(start, end - start));
      start = line.find_first_not_of(blanks, end);
    }
  }

  const std::string& path_;
  std::string& text_;
  std::size_t begin_ = 0, end_ = 0, at_ = 0;
  int number_ = 0;
  std::vector<std::string_view> words_;
};

/// How many of each kind the file has given so far.
struct Counts {
  long positions = 0, texcoords = 0, normals = 0;
};

/// Checks one index of a face corner, 1-based or counted back from the end.
void check_index(const LineReader& line, std::string_view word, long count, const char* what) {
  const std::string text(word);
  char* end = nullptr;
  const long index = std::strtol(text.c_str(), &end, 10);
  if (text.empty() || end != text.c_str() + text.size() || index == 0)
    line.fail(fmt::format("\"{}\" is not a {} index", printable(text), what));
  if (index > count || index < -count)
    line.fail(fmt::format("the face asks for {} {}, but the file has given {} so far", what, index,
                          count));
}

/// position, position/texcoord, position//normal or position/texcoord/normal
void check_corner(const LineReader& line, std::string_view corner, const Counts& counts) {
  const std::size_t first = corner.find('/');
  check_index(line, corner.substr(0, first), counts.positions, "vertex");
  if (first == std::string_view::npos) return;
  const std::string_view rest = corner.substr(first + 1);
  const std::size_t second = rest.find('/');
  const std::string_view texcoord = rest.substr(0, second);
  if (!texcoord.empty() || second == std::string_view::npos)
    check_index(line, texcoord, counts.texcoords, "texture coordinate");
  if (second != std::string_view::npos)
    check_index(line, rest.substr(second + 1), counts.normals, "normal");
}

void check_face(const LineReader& line, const Counts& counts) {
  // tinyobjloader cuts polygons in a time that grows with the square of their corners, at least.
  constexpr std::size_t most_corners = 4096;
  if (line.words().size() < 4) line.fail("a face needs at least three corners");
  if (line.words().size() - 1 > most_corners)
    line.fail(fmt::format("the face has {} corners, the most is {}; cut it into triangles",
                          line.words().size() - 1, most_corners));
  for (std::size_t i = 1; i < line.words().size(); ++i) check_corner(line, line.words()[i], counts);
}

}  // namespace

ObjScan scan_obj(const std::string& path, std::string& text) {
  static const std::set<std::string_view> harmless = {"o", "g", "s"};
  ObjScan scan;
  Counts counts;
  bool has_material = false;
  for (LineReader line(path, text); line.next();) {
    const std::string_view key = line.words()[0];
    if (line.words().back() == "\\")
      line.fail("lines continued by \\ are not supported; join them");
    if (key == "v" || key == "vn") {
      for (std::size_t i = 1; i <= 3; ++i) line.real(i);
      ++(key == "v" ? counts.positions : counts.normals);
    } else if (key == "vt") {
      for (std::size_t i = 1; i < std::max<std::size_t>(line.words().size(), 2); ++i) line.real(i);
      ++counts.texcoords;
    } else if (key == "f") {
      check_face(line, counts);
      if (!has_material && scan.first_face_without_material == 0)
        scan.first_face_without_material = line.number();
    } else if (key == "usemtl") {
      if (line.words().size() < 2) line.fail("usemtl needs the name of a material");
      scan.materials.emplace(line.rest(), line.number());
      has_material = true;
    } else if (key == "mtllib") {
      if (line.words().size() < 2) line.fail("mtllib needs the name of a file");
      scan.names_library = true;
    } else if (harmless.count(key) == 0) {
      scan.not_supported.emplace("OBJ \"" + printable(std::string(key), 20) + "\"", path);
      line.blank();
      continue;
    }
  }
  return scan;
}

void scan_mtl(const std::string& path, std::string& text,
              std::map<std::string, std::string>& not_supported) {
  // Keyword -> how many numbers follow. Ka is read past: ambient light has no place in transport.
  static const std::map<std::string_view, std::size_t> known = {
      {"newmtl", 0}, {"Ka", 3}, {"Kd", 3}, {"Ks", 3}, {"Ke", 3}, {"Tf", 3},
      {"Kt", 3},     {"Ns", 1}, {"Ni", 1}, {"d", 1},  {"Tr", 1}, {"illum", 1}};
  for (LineReader line(path, text); line.next();) {
    const std::string_view key = line.words()[0];
    const auto found = known.find(key);
    if (found == known.end()) {
      not_supported.emplace("MTL \"" + printable(std::string(key), 20) + "\"", path);
      continue;
    }
    for (std::size_t i = 1; i <= found->second; ++i)
      if (line.real(i) < 0.0) line.fail(fmt::format("{} must not be negative", key));
  }
}

}  // namespace pellucid
