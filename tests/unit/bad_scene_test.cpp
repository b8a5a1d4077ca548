// Bad scene files, thousands of them: made from scenes that hold every key of the schema, so that a
// new key is under test from its first day. Each ends in an InputError that says where, or in a
// scene that packs into finite numbers.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "pack/pack.h"
#include "scene/schema.h"
#include "scene/text_file.h"
#include "scene_test_support.h"
#include "support/bad_text.h"

namespace pellucid {
namespace {

namespace fs = std::filesystem;
const fs::path source_folder = PELLUCID_SOURCE_DIR "/tests/support/everything";

/// A scene of everything/ in a folder of its own with the models beside it.
class SpoiltScene {
 public:
  explicit SpoiltScene(const std::string& name) {
    for (const auto& entry : fs::directory_iterator(source_folder))
      fs::copy(entry.path(), folder_.path());
    text_ = read_text_file(source_folder / name, "scene", 1 << 20);
    root_ = parse_json(path(), text_);
    find_fields(root_, nullptr);
  }

  const std::string& text() const { return text_; }
  /// Every value with its key's field; null: unknown or of free type.
  const std::map<const JsonNode*, const Field*>& values() const { return fields_; }
  /// Every member with its field; null: a name of the user's.
  const std::vector<std::pair<const JsonMember*, const Field*>>& members() const {
    return members_;
  }
  const std::set<std::string>& covered() const { return covered_; }  ///< kind.key

  /// The message of the refusal; "" if the scene was taken, and then it can be packed.
  std::string error_of(const std::string& text) const {
    folder_.write("scene.json", text);
    const std::string message = test::input_error([&] { expect_finite(load_scene(path())); });
    if (message.empty()) return message;
    EXPECT_EQ(message.rfind(path() + ":", 0), 0u) << message;
    EXPECT_NE(message.find("^"), std::string::npos) << message;
    EXPECT_LT(message.size(), 4000u) << "nobody reads that";
    return message;
  }

  /// The file:line:column at the head of messages about a byte of the text.
  std::string place(std::size_t offset) const {
    const auto begin = text_.begin(), at = begin + static_cast<std::ptrdiff_t>(offset);
    const std::size_t newline = text_.rfind('\n', offset);
    return path() + ":" + std::to_string(1 + std::count(begin, at, '\n')) + ":" +
           std::to_string(offset - newline) + ":";
  }

 private:
  std::string path() const { return folder_.path() + "/scene.json"; }

  static void expect_finite(const Scene& scene) {
    const PackedScene packed = pack_scene(scene, {8});
    const auto finite = [](const F4& v) {
      return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
    };
    bool good = finite(packed.info.center_radius) && finite(packed.info.bounds_reach) &&
                finite(packed.camera.corner) && finite(packed.camera.dx) &&
                finite(packed.camera.dy) && finite(packed.camera.forward);
    for (const F4& v : packed.positions) good = good && finite(v);
    for (const F4& v : packed.normals) good = good && finite(v);
    for (const Quadric& q : packed.quadrics)
      good = good && finite(q.center_radius) && finite(q.normal);
    for (const ::Light& l : packed.lights)
      good = good && finite(l.value) && finite(l.position) && std::isfinite(l.prob_pick);
    EXPECT_TRUE(good) << "not finite on the device";
  }

  /// Learns which key of which kind every member is, by misspelling it: the message tells the kind.
  void find_fields(const JsonNode& node, const Field* inherited) {
    fields_[&node] = inherited;
    for (const JsonNode& item : node.items) find_fields(item, list_field(inherited));
    for (const JsonMember& member : node.members) {
      const std::string message =
          error_of(test::replaced(text_, test::key_span(member), "\"" + member.key + "_\""));
      const std::size_t at = message.find("unknown key"), in = message.find("\" in ", at);
      const Field* field = nullptr;
      if (member.key == "type" && message.find("needs the key \"type\"") != std::string::npos) {
        const std::size_t family = message.find(": a ") + 4;
        covered_.insert(message.substr(family, message.find(' ', family) - family) + "/" +
                        member.value.text + ".type");
      } else if (at != std::string::npos) {
        const std::string kind = message.substr(in + 5, message.find('.', in) - in - 5);
        for (const Field& candidate : object_spec(kind).fields)
          if (member.key == candidate.key) field = &candidate;
        EXPECT_NE(field, nullptr) << kind << "." << member.key;
        covered_.insert(kind + "." + member.key);
      }
      members_.emplace_back(&member, field);
      find_fields(member.value, field);
    }
  }

  /// What holds for the items of a list: they are numbers of the same range.
  static const Field* list_field(const Field* list) {
    const bool numbers = list != nullptr && list->type != FieldType::array;
    return numbers ? list : nullptr;
  }

  test::TempFolder folder_;
  std::string text_;
  JsonNode root_;
  std::map<const JsonNode*, const Field*> fields_;
  std::vector<std::pair<const JsonMember*, const Field*>> members_;
  std::set<std::string> covered_;
};

class BadScene : public ::testing::TestWithParam<const char*> {
 protected:
  const SpoiltScene scene_{GetParam()};
};

const char* const scene_names[] = {"everything.json", "generated.json"};
INSTANTIATE_TEST_SUITE_P(, BadScene, ::testing::ValuesIn(scene_names),
                         [](const auto& scene) { return scene.index == 0 ? "All" : "Generated"; });

/// Whether a value is surely illegal for a key, judged by another reader and the schema alone.
bool is_illegal(const std::string& value, const Field* field, bool is_item) {
  if (value.empty() && is_item) return false;  // an empty list may be one
  if (is_item && field != nullptr &&
      (field->type == FieldType::edges || field->type == FieldType::names))
    return false;  // lists of vectors and of texts: their items have no field of their own
  const auto json = nlohmann::json::parse(value, nullptr, false);
  if (json.is_discarded() || json.is_null()) return true;
  if (field == nullptr) return false;
  const FieldType type = field->type;
  const bool many = type == FieldType::vector || type == FieldType::scale ||
                    type == FieldType::pair || type == FieldType::matrix ||
                    type == FieldType::color;
  const bool one = is_item || type == FieldType::integer || type == FieldType::number ||
                   type == FieldType::scale || type == FieldType::color;
  if (json.is_number()) {
    const double number = json.get<double>();
    const bool whole = is_item || type != FieldType::integer || number == std::floor(number);
    return !one || !whole || !(number >= field->range.low && number <= field->range.high);
  }
  if (json.is_boolean()) return type != FieldType::boolean;
  if (json.is_string()) return is_item || (type != FieldType::text && type != FieldType::choice);
  if (json.is_array()) return is_item || !(many || type == FieldType::array);
  return is_item || !(type == FieldType::color || type == FieldType::object);
}

TEST_P(BadScene, IsGoodBeforeItIsSpoilt) {
  EXPECT_EQ(scene_.error_of(scene_.text()), "");
  EXPECT_EQ(scene_.error_of("\xEF\xBB\xBF" + scene_.text()), "") << "a byte order mark is fine";
  std::string windows;
  for (const char c : scene_.text()) windows += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(scene_.error_of(windows), "");
}

TEST_P(BadScene, OddValuesAreRefusedInPlace) {
  for (const auto& [node, field] : scene_.values()) {
    const bool is_item = !node->path.empty() && node->path.back() == ']';
    for (const std::string& value : test::odd_values()) {
      SCOPED_TRACE(node->path + " = " + value.substr(0, 60));
      const std::string message =
          scene_.error_of(test::replaced(scene_.text(), test::span_of(*node), value));
      if (message.empty()) {
        EXPECT_FALSE(is_illegal(value, field, is_item)) << "was accepted";
      } else if (value == "null" || value == "1e38" || value == "-1e38") {
        EXPECT_EQ(message.rfind(scene_.place(node->offset), 0), 0u) << message;
      }
    }
    if (HasFatalFailure()) return;
  }
}

TEST_P(BadScene, MisspeltKeysAreNamed) {
  for (const auto& [member, field] : scene_.members())
    for (const std::string& word : test::misspellings(member->key)) {
      SCOPED_TRACE(member->value.path + " as " + word);
      const std::string message = scene_.error_of(
          test::replaced(scene_.text(), test::key_span(*member), "\"" + word + "\""));
      if (field == nullptr) continue;  // a name of the user's: any other is as good
      EXPECT_EQ(message.rfind(scene_.place(member->key_offset), 0), 0u) << message;
      EXPECT_NE(message.find("\"" + member->key + "\""), std::string::npos) << message;
      // "sizes" may be meant as another key of the same kind.
      const bool near = message.find("Did you mean '") != std::string::npos;
      EXPECT_TRUE(near || member->key.size() < 3) << message;
    }
}

TEST_P(BadScene, KeysLeftOutOrGivenTwice) {
  for (const auto& [member, field] : scene_.members()) {
    SCOPED_TRACE(member->value.path);
    const std::string message = scene_.error_of(test::without(scene_.text(), *member));
    if (field != nullptr && field->fallback == required) {
      EXPECT_NE(message.find("\"" + member->key + "\""), std::string::npos) << message;
    }
    const test::Span whole{member->key_offset, test::span_of(member->value).end};
    const std::string twice = scene_.text().substr(whole.begin, whole.end - whole.begin);
    EXPECT_NE(scene_.error_of(test::replaced(scene_.text(), whole, twice + ", " + twice))
                  .find("given twice"),
              std::string::npos);
  }
}

TEST_P(BadScene, DamagedFiles) {
  constexpr int cuts = 200, changes = 3000;
  test::for_each_damage(
      scene_.text(), cuts, changes, [&](const std::string& what, const std::string& text) {
        SCOPED_TRACE(what);
        const std::string message = scene_.error_of(text);
        const bool may_be_good = what.rfind("random", 0) == 0 || what == "a mark twice" ||
                                 what == "lines that end in CR";
        EXPECT_TRUE(may_be_good || !message.empty());
      });
}

TEST(BadSceneSize, HugeScenesEndSoon) {
  const auto start = std::chrono::steady_clock::now();
  std::string names, values = "0";
  for (int i = 0; i < 100000; ++i)
    names += ", \"m" + std::to_string(i) + R"(": {"type": "diffuse"})";
  for (int i = 0; i < (2 << 20); ++i) values += ",0";
  const std::string unknown = test::load_error(
      test::scene_with(R"({"type": "sphere", "material": "n"})", "", names.substr(2)));
  EXPECT_NE(unknown.find("there is no material \"n\""), std::string::npos) << unknown;
  EXPECT_LT(unknown.size(), 4000u);
  EXPECT_NE(test::load_error(test::scene_with(values)).find("more than 2097152 values"),
            std::string::npos);
  // Ten times what a loaded machine takes with sanitizers; a quadratic search would take hours.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST(BadSceneCoverage, TheScenesHoldEveryKey) {
  std::set<std::string> covered;
  for (const char* name : scene_names) covered.merge(std::set(SpoiltScene(name).covered()));
  for (const ObjectSpec& spec : object_specs())
    for (const Field& field : spec.fields)
      EXPECT_EQ(covered.count(spec.name + "." + field.key), 1u)
          << spec.name << "." << field.key << " is missing in tests/support/everything";
}

}  // namespace
}  // namespace pellucid
