// A strict look over OBJ and MTL texts.
#include "scene/obj_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
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
  /// The line from word i on, without blanks around it.
  std::string rest(std::size_t i = 1) const {
    const char* begin = words_[i].data();
    return {begin, words_.back().data() + words_.back().size()};
  }

  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(fmt::format("{}: {}", place(), why));
  }

  std::string place() const { return fmt::format("{}:{}", path_, number_); }

  /// Whether word i is there and begins like a number.
  bool has_number(std::size_t i) const {
    return i < words_.size() &&
           std::string_view("+-.0123456789").find(words_[i][0]) != std::string_view::npos &&
           words_[i].find_first_not_of("+-.0123456789eE") == std::string_view::npos;
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

/// Up to three numbers after the option at word i, as -s and -o have them; returns the next word.
std::size_t read_pair(const LineReader& line, std::size_t i, glm::dvec2& pair) {
  const std::size_t first = i + 1;
  for (i = first; i < first + 3 && (i == first || line.has_number(i)); ++i)
    if (const double value = line.real(i); i < first + 2) pair[int(i - first)] = value;
  return i;
}

/// map_Kd [options] file. Options that change the picture in ways we do not have are reported.
MtlTexture read_map(const LineReader& line, const std::string& path,
                    std::map<std::string, std::string>& not_supported) {
  // Option -> how many words follow it.
  static const std::map<std::string_view, std::size_t> ignored = {
      {"-blendu", 1}, {"-blendv", 1}, {"-boost", 1},   {"-cc", 1},   {"-mm", 2},
      {"-texres", 1}, {"-bm", 1},     {"-imfchan", 1}, {"-type", 1}, {"-t", 3}};
  MtlTexture map;
  map.place = line.place();
  std::size_t i = 1;
  while (i < line.words().size() && line.words()[i][0] == '-') {
    const std::string_view option = line.words()[i];
    const auto found = ignored.find(option);
    if (option == "-s" || option == "-o") {
      i = read_pair(line, i, option == "-s" ? map.scale : map.offset);
    } else if (option == "-clamp") {
      const std::string_view value = i + 1 < line.words().size() ? line.words()[i + 1] : "";
      if (value != "on" && value != "off") line.fail("-clamp takes \"on\" or \"off\"");
      map.clamp = value == "on";
      i += 2;
    } else if (found != ignored.end()) {
      not_supported.emplace(fmt::format("MTL \"map_Kd {}\"", option), path);
      i += 1 + found->second;
    } else {
      line.fail(fmt::format("map_Kd has no option \"{}\"", printable(std::string(option), 20)));
    }
  }
  if (i >= line.words().size()) line.fail("map_Kd needs the name of a file");
  std::string name = line.rest(i);
  std::replace(name.begin(), name.end(), '\\', '/');
  map.file = (std::filesystem::path(path).parent_path() / name).string();
  return map;
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

MtlScan scan_mtl(const std::string& path, std::string& text) {
  // Keyword -> how many numbers follow. Ka is read past: ambient light has no place in transport.
  // Pcr and anisor say how a clearcoat and anisotropy look, which have no effect themselves.
  static const std::map<std::string_view, std::size_t> known = {
      {"newmtl", 0}, {"Ka", 3}, {"Kd", 3},  {"Ks", 3},    {"Ke", 3},    {"Tf", 3}, {"Kt", 3},
      {"Ns", 1},     {"Ni", 1}, {"d", 1},   {"Tr", 1},    {"illum", 1}, {"Pr", 1}, {"Pm", 1},
      {"Ps", 1},     {"Pc", 1}, {"Pcr", 1}, {"aniso", 1}, {"anisor", 1}};
  // Exporters write these to every material; where they are 0 nothing is missing.
  static const std::set<std::string_view> only_zero = {"Ps", "Pc", "aniso"};
  MtlScan scan;
  std::string material;
  for (LineReader line(path, text); line.next();) {
    const std::string_view key = line.words()[0];
    const auto found = known.find(key);
    if (key == "map_Kd") {
      scan.textures[material] = read_map(line, path, scan.not_supported);
      continue;
    }
    if (found == known.end()) {
      scan.not_supported.emplace("MTL \"" + printable(std::string(key), 20) + "\"", path);
      continue;
    }
    for (std::size_t i = 1; i <= found->second; ++i)
      if (line.real(i) < 0.0) line.fail(fmt::format("{} must not be negative", key));
    if (key == "newmtl") material = line.words().size() > 1 ? line.rest() : "";
    if (key == "Kd") scan.coloured.insert(material);
    if (key == "Pr" || key == "Pm") scan.principled.insert(material);
    if (only_zero.count(key) != 0 && line.real(1) > 0.0)
      scan.not_supported.emplace("MTL \"" + std::string(key) + "\"", path);
  }
  return scan;
}

}  // namespace pellucid
