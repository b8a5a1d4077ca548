// PLY models: the header names elements and their properties, which a reader then walks.
#include "scene/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <sstream>

#include "base/error.h"
#include "base/text.h"
#include "scene/text_file.h"

namespace pellucid {
namespace {

enum class Format { ascii, little, big };
enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };

struct Property {
  std::string name;
  Type type = Type::f32;
  bool list = false;
  Type count_type = Type::u8;  ///< of a list
};
struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

std::size_t bytes_of(Type type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<int>(type)];
}

/// The text of a PLY file from header to end; every failure names the place in hand.
class PlyText {
 public:
  PlyText(const std::string& path, const std::string& text) : path_(path), text_(text) {}

  void read_header(Format& format, std::vector<Element>& elements);

  /// The next value of the current element.
  double value(Type type) { return format_ == Format::ascii ? ascii_value() : binary_value(type); }
  /// ASCII: an element starts on a line of its own and must end with it.
  void start_element() {
    if (format_ == Format::ascii)
      while (at_ < text_.size() && is_blank(text_[at_], true)) advance();
  }
  void end_element() {
    if (format_ != Format::ascii) return;
    skip_blanks();
    if (at_ < text_.size() && text_[at_] != '\n') fail("the line has more values than properties");
  }

  [[noreturn]] void fail(const std::string& why) const {
    if (format_ == Format::ascii) throw InputError(fmt::format("{}:{}: {}", path_, line_, why));
    throw InputError(fmt::format("{}: byte {}: {}", path_, at_, why));
  }
  std::size_t bytes_left() const { return text_.size() - at_; }

 private:
  static bool is_blank(char c, bool newline) {
    return c == ' ' || c == '\t' || c == '\r' || (newline && c == '\n');
  }
  void advance() { line_ += text_[at_++] == '\n'; }
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_], false)) ++at_;
  }
  std::vector<std::string> header_line();
  Type type_named(const std::string& name) const;
  void add_property(const std::vector<std::string>& words, std::vector<Element>& elements) const;
  Format format_named(const std::vector<std::string>& words) const;
  double ascii_value();
  double binary_value(Type type);

  const std::string& path_;
  const std::string& text_;
  std::size_t at_ = 0;
  int line_ = 1;
  Format format_ = Format::ascii;  // the header is text in all of them
};

std::vector<std::string> PlyText::header_line() {
  const std::size_t end = text_.find('\n', at_);
  if (end == std::string::npos) fail("the header does not end: there is no line end_header");
  std::istringstream line(text_.substr(at_, end - at_));
  std::vector<std::string> words;
  for (std::string word; line >> word;) words.push_back(word);
  at_ = end + 1;
  return words;
}

Type PlyText::type_named(const std::string& name) const {
  static const std::vector<std::string> names = {
      "char", "uchar", "short", "ushort", "int",   "uint",   "float",   "double",
      "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    fail(fmt::format("there is no type \"{}\"; there are {}", printable(name), join(names)));
  return static_cast<Type>((found - names.begin()) % 8);
}

void PlyText::add_property(const std::vector<std::string>& words,
                           std::vector<Element>& elements) const {
  if (elements.empty()) fail("a property comes before any element");
  const bool list = words.size() == 5 && words[1] == "list";
  if (!list && words.size() != 3)
    fail("a property reads \"property TYPE NAME\" or \"property list TYPE TYPE NAME\"");
  Property property{words.back(), type_named(words[words.size() - 2]), list};
  if (list) property.count_type = type_named(words[2]);
  elements.back().properties.push_back(property);
}

Format PlyText::format_named(const std::vector<std::string>& words) const {
  if (words.size() == 3 && words[2] == "1.0") {
    if (words[1] == "ascii") return Format::ascii;
    if (words[1] == "binary_little_endian") return Format::little;
    if (words[1] == "binary_big_endian") return Format::big;
  }
  fail("the format is ascii, binary_little_endian or binary_big_endian, all of version 1.0");
}

void PlyText::read_header(Format& format, std::vector<Element>& elements) {
  if (header_line() != std::vector<std::string>{"ply"}) fail("a PLY file begins with \"ply\"");
  bool has_format = false;
  for (;;) {
    ++line_;
    const std::vector<std::string> words = header_line();
    const std::string key = words.empty() ? "comment" : words[0];
    if (key == "end_header") break;
    if (key == "comment" || key == "obj_info") continue;
    if (key == "format") {
      format = format_named(words);
      has_format = true;
    } else if (key == "element") {
      Element element;
      const std::string count = words.size() == 3 ? words[2] : "";
      const auto end = count.data() + count.size();
      const auto [stop, error] = std::from_chars(count.data(), end, element.count);
      if (count.empty() || error != std::errc() || stop != end)
        fail("an element reads \"element NAME COUNT\"");
      element.name = words[1];
      elements.push_back(element);
    } else if (key == "property") {
      add_property(words, elements);
    } else {
      fail(fmt::format("\"{}\" has no place in a header", printable(key, 20)));
    }
  }
  if (!has_format) fail("the header has no line \"format\"");
  ++line_;
  format_ = format;
}

double PlyText::ascii_value() {
  skip_blanks();
  const std::size_t start = at_;
  while (at_ < text_.size() && !is_blank(text_[at_], true)) ++at_;
  if (start == at_)
    fail(at_ < text_.size() ? "the line ends too early" : "the file ends too early");
  const char *begin = text_.data() + start, *end = text_.data() + at_;
  if (*begin == '+') ++begin;
  double number = 0;
  const auto [stop, error] = std::from_chars(begin, end, number);
  if (error != std::errc() || stop != end)
    fail(fmt::format("\"{}\" is not a number", printable(text_.substr(start, at_ - start))));
  return number;
}

template <typename T>
double as_number(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

double PlyText::binary_value(Type type) {
  const std::size_t size = bytes_of(type);
  if (bytes_left() < size) fail("the file ends too early");
  unsigned char bytes[8];
  std::memcpy(bytes, text_.data() + at_, size);
  if (format_ == Format::big) std::reverse(bytes, bytes + size);  // hosts are little-endian
  at_ += size;
  switch (type) {
    case Type::i8:
      return as_number<std::int8_t>(bytes);
    case Type::u8:
      return as_number<std::uint8_t>(bytes);
    case Type::i16:
      return as_number<std::int16_t>(bytes);
    case Type::u16:
      return as_number<std::uint16_t>(bytes);
    case Type::i32:
      return as_number<std::int32_t>(bytes);
    case Type::u32:
      return as_number<std::uint32_t>(bytes);
    case Type::f32:
      return as_number<float>(bytes);
    case Type::f64:
      return as_number<double>(bytes);
  }
  throw InternalError("unknown PLY type");
}

/// Walks the elements and keeps what a mesh is made of.
class PlyMesh {
 public:
  PlyMesh(PlyText& text, const std::vector<Element>& elements) : text_(text) {
    for (const Element& element : elements)
      if (element.name == "vertex") vertices_ = element.count;
    if (vertices_ > 0xffffffffu) text_.fail("more than 2^32 vertices");
    for (const Element& element : elements) {
      if (element.count > 0 && element.properties.empty())
        text_.fail(fmt::format("element \"{}\" has no properties", printable(element.name)));
      if (element.name == "vertex") {
        read_vertices(element);
      } else {
        read_others(element);
      }
    }
  }

  RawMesh mesh;
  bool has_normals = false;

 private:
  /// One value of a property that is not a list; the items of a list are stepped over.
  double scalar(const Property& property) {
    if (!property.list) return text_.value(property.type);
    for (std::uint64_t left = list_length(property); left > 0; --left) text_.value(property.type);
    return 0.0;
  }

  std::uint64_t whole(double value, double most, const char* what) {
    if (!(value >= 0.0) || value != std::floor(value) || value > most)
      text_.fail(fmt::format("{:g} is no {} (0 to {:.0f})", value, what, most));
    return static_cast<std::uint64_t>(value);
  }
  std::uint64_t list_length(const Property& property) {
    return whole(text_.value(property.count_type), 0xffffffffu, "length of a list");
  }

  double coordinate(double value) {
    if (!(std::abs(value) <= largest_length))
      text_.fail(fmt::format("{:g} is out of range; the most is {:g}", value, largest_length));
    return value;
  }

  void read_vertices(const Element& element) {
    static const char* const known[] = {"x", "y", "z", "nx", "ny",        "nz",
                                        "u", "v", "s", "t",  "texture_u", "texture_v"};
    constexpr int count = 12, first_uv = 6;  // three spellings of texture coordinates
    std::vector<int> slots;
    bool found[count] = {};
    for (const Property& property : element.properties) {
      int slot = 0;
      while (slot < count && (property.list || property.name != known[slot])) ++slot;
      slots.push_back(slot);
      if (slot < count) found[slot] = true;
    }
    if (!found[0] || !found[1] || !found[2]) text_.fail("vertices need the properties x, y and z");
    has_normals = found[3] && found[4] && found[5];
    int uv = first_uv;
    while (uv < count && !(found[uv] && found[uv + 1])) uv += 2;
    mesh.positions.reserve(std::min<std::uint64_t>(element.count, text_.bytes_left()));
    for (std::uint64_t i = 0; i < element.count; ++i) {
      double values[count + 1] = {};
      text_.start_element();
      for (std::size_t p = 0; p < slots.size(); ++p)
        values[slots[p]] = scalar(element.properties[p]);
      for (int slot = 0; slot < count; ++slot) coordinate(values[slot]);
      text_.end_element();
      mesh.positions.emplace_back(values[0], values[1], values[2]);
      if (has_normals) mesh.normals.emplace_back(values[3], values[4], values[5]);
      if (uv < count) mesh.uvs.emplace_back(values[uv], values[uv + 1]);
    }
  }

  void read_others(const Element& element) {
    bool has_indices = false;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      text_.start_element();
      for (const Property& property : element.properties) {
        const bool indices = element.name == "face" && property.list &&
                             (property.name == "vertex_indices" || property.name == "vertex_index");
        has_indices |= indices;
        if (indices) {
          read_face(property);
        } else {
          scalar(property);
        }
      }
      text_.end_element();
    }
    if (element.name == "face" && element.count > 0 && !has_indices)
      text_.fail("faces need the list vertex_indices");
  }

  /// A polygon becomes a fan around its first corner.
  void read_face(const Property& property) {
    const std::uint64_t corners = list_length(property);
    if (corners < 3) text_.fail(fmt::format("a face of {} corners; it needs three", corners));
    if (vertices_ == 0) text_.fail("a face, but no vertices");
    glm::uvec3 triangle{0};
    for (std::uint64_t i = 0; i < corners; ++i) {
      const auto index = static_cast<std::uint32_t>(
          whole(text_.value(property.type), double(vertices_ - 1), "vertex index"));
      if (i == 0) triangle.x = index;
      triangle.y = triangle.z;
      triangle.z = index;
      if (i >= 2) mesh.triangles.push_back(triangle);
    }
  }

  PlyText& text_;
  std::uint64_t vertices_ = 0;
};

/// Unit length; normals of no length are made from the triangles around.
void finish_normals(RawMesh& mesh) {
  RawMesh made;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    glm::dvec3& n = mesh.normals[i];
    const double length = glm::length(n);
    if (!(length > 0.0) && made.normals.empty()) {
      made = mesh;
      add_smooth_normals(made);
    }
    n = length > 0.0 ? n / length : made.normals[i];
  }
}

}  // namespace

Model load_ply(const std::string& path, const ModelOptions& options) {
  if (options.materials == ModelMaterials::own)
    throw InputError(fmt::format(
        "'{}': PLY files hold no materials; give the shape the key \"material\"", path));
  const std::string data = read_text_file(path, "PLY file", max_model_bytes);
  PlyText text(path, data);
  Format format = Format::ascii;
  std::vector<Element> elements;
  text.read_header(format, elements);
  PlyMesh read(text, elements);
  if (read.mesh.triangles.empty()) throw InputError(fmt::format("{}: the file has no faces", path));
  if (!options.use_normals || !read.has_normals) read.mesh.normals.clear();
  if (!options.textured) read.mesh.uvs.clear();
  finish_normals(read.mesh);
  Model model;
  model.files.push_back(source_file(path, data));
  model.parts.push_back({"", no_material, std::nullopt, std::move(read.mesh)});
  return model;
}

}  // namespace pellucid
