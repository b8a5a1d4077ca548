// Films to channels of words and back.
#include "render/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <sstream>

#include "base/error.h"
#include "base/hash.h"
#include "base/text.h"
#include "cl/sources.h"

namespace pellucid {
namespace {

/// Grows with every change of what the words mean.
constexpr const char* format_version = "1";
constexpr const char* no_aovs = "none";  // OpenEXR drops empty texts
constexpr const char* prefix = "pellucid:checkpoint.";

std::string key(const std::string& name) {
  return prefix + name;
}

const char* const channel_names[3] = {"R", "G", "B"};
constexpr std::size_t pixel_words = sizeof(FilmPixel) / sizeof(uint);

/// Name of every word of FilmPixel in order; pads have none.
std::vector<std::string> word_names() {
  std::vector<std::string> names;
  for (const auto& [what, words] :
       {std::pair{"sum", FILM_SUM_WORDS}, {"block", FILM_SUM_WORDS}, {"square", FILM_SQUARE_WORDS}})
    for (const char* c : channel_names)
      for (int i = 0; i < words; ++i) names.push_back(fmt::format("{}.{}.{}", what, c, i));
  names.insert(names.end(), {"passes", "rays.0", "rays.1", "peak", "peak.pass"});
  names.resize(pixel_words);
  return names;
}

/// Kept even where it is 0: a file needs a channel.
constexpr const char* always_there = "passes";

/// Channels of words, each [pixels], in the order of their names as OpenEXR has them; those that
/// are 0 everywhere are left out.
class Planes {
 public:
  explicit Planes(std::size_t pixels) : pixels_(pixels) {}
  template <typename Word>
  void add(const std::string& name, Word&& word) {
    std::vector<uint> plane(pixels_);
    bool any = false;
    for (std::size_t i = 0; i < pixels_; ++i) any |= (plane[i] = word(i)) != 0;
    if (any || name == always_there) planes_[name] = std::move(plane);
  }
  void put_into(WordImage& words) && {
    const std::size_t stride = planes_.size();
    words.data.resize(pixels_ * stride);
    for (auto& [name, plane] : planes_) {
      const std::size_t a = words.channels.size();
      words.channels.push_back(name);
      for (std::size_t i = 0; i < pixels_; ++i) words.data[i * stride + a] = plane[i];
      plane = {};
    }
  }

 private:
  std::size_t pixels_;
  std::map<std::string, std::vector<uint>> planes_;
};

uint word_of(const FilmPixel& pixel, std::size_t index) {
  uint word;
  std::memcpy(&word, reinterpret_cast<const char*>(&pixel) + index * sizeof word, sizeof word);
  return word;
}

std::string open_name(std::uint64_t block, std::size_t c, std::size_t word) {
  return fmt::format("open.{}.{}.{}", block, channel_names[c], word);
}

/// Name and place within a pixel of every word of layers.
std::vector<std::pair<std::string, std::size_t>> layer_words(const Layers& layers) {
  std::vector<std::pair<std::string, std::size_t>> words;
  for (const LayerChannel& channel : layer_channels(layers.set))
    for (std::size_t w = 0; w < 2; ++w)
      words.emplace_back(fmt::format("layer.{}.{}", channel.name, w), channel.word + w);
  return words;
}

Planes planes_of(const Film& film, const CheckpointFacts& facts) {
  Planes planes(film.pixels.size());
  const std::vector<std::string> names = word_names();
  for (std::size_t w = 0; w < names.size(); ++w)
    if (!names[w].empty())
      planes.add(names[w], [&](std::size_t i) { return word_of(film.pixels[i], w); });
  for (const auto& [block, sums] : film.open)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t w = 0; w < FILM_SUM_WORDS; ++w)
        planes.add(open_name(block, c, w), [&, &s = sums](std::size_t i) { return s[i][c][w]; });
  for (const auto& [name, word] : layer_words(film.layers))
    planes.add(name, [&, w = word](std::size_t i) {
      return film.layers.words[i * film.layers.words_per_pixel() + w];
    });
  for (const AovChannel& aov : facts.aovs)
    planes.add("aov." + aov.name, [&](std::size_t i) {
      uint bits;
      std::memcpy(&bits, &aov.data[i], sizeof bits);
      return bits;
    });
  return planes;
}

/// Metadata as typed values, with errors that name the file.
class Facts {
 public:
  Facts(const std::string& file, const std::map<std::string, MetaValue>& metadata)
      : file_(file), metadata_(metadata) {}
  std::string text(const std::string& name) const {
    const auto found = metadata_.find(key(name));
    const auto* value =
        found == metadata_.end() ? nullptr : std::get_if<std::string>(&found->second);
    if (!value) fail("'" + name + "' is missing");
    return *value;
  }
  long long number(const std::string& name) const {
    const std::string word = text(name);
    long long value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      fail(fmt::format("'{}' is '{}'", name, word));
    return value;
  }
  [[noreturn]] void fail(const std::string& reason) const {
    throw InputError(fmt::format("checkpoint '{}' is damaged: {}", file_, reason));
  }

 private:
  const std::string& file_;
  const std::map<std::string, MetaValue>& metadata_;
};

std::string cut_key(std::size_t kind) {
  return fmt::format("cut.{}", cut_names()[kind]);
}

/// As write_checkpoint() puts it: sum, steps of 2^-32, paths; left out where no cap was.
DepthCuts read_cuts(const WordImage& words, const Facts& facts) {
  DepthCuts cuts{};
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    if (!words.metadata.count(key(cut_key(i)))) continue;
    std::istringstream text(facts.text(cut_key(i)));
    DepthCut& cut = cuts[i];
    if (!(text >> cut.whole >> cut.part >> cut.paths)) facts.fail("'" + cut_key(i) + "'");
  }
  return cuts;
}

/// Of everything but the hash itself and what describes the picture.
std::string content_hash(const WordImage& words) {
  Hasher hasher;
  for (const auto& [name, value] : words.metadata)
    if (name.rfind(prefix, 0) == 0 && name != key("hash"))
      if (const auto* text = std::get_if<std::string>(&value))  // others are not of our making
        hasher.add(name + "=" + *text + "\n");
  // Readers put channels into an order of their own.
  std::vector<std::string> names = words.channels;
  std::sort(names.begin(), names.end());
  const std::size_t stride = names.size();
  std::vector<uint> plane(words.data.size() / stride);
  for (const std::string& name : names) {
    const auto a = std::size_t(words.channel(name));
    for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = words.data[i * stride + a];
    hasher.add(name + " ").add(plane.data(), plane.size() * sizeof(uint));
  }
  return hasher.hex();
}

Film film_of(const WordImage& words, const Facts& facts) {
  const Window window{int(facts.number("x0")), int(facts.number("y0")), words.width, words.height};
  Film film(int(facts.number("width")), int(facts.number("height")), window,
            int(facts.number("lsb")), std::uint64_t(facts.number("block_size")));
  film.passes = PassSet::parse(facts.text("passes"));
  if (film.block_size < 1) facts.fail("'block_size' is 0");
  if (facts.text("current") != "none") film.current = std::uint64_t(facts.number("current"));
  const std::vector<std::string> names = word_names();
  const std::size_t stride = words.channels.size();
  for (std::size_t a = 0; a < stride; ++a) {
    const auto w =
        std::size_t(std::find(names.begin(), names.end(), words.channels[a]) - names.begin());
    if (w == names.size()) continue;
    for (std::size_t i = 0; i < film.pixels.size(); ++i)
      std::memcpy(reinterpret_cast<char*>(&film.pixels[i]) + w * sizeof(uint),
                  &words.data[i * stride + a], sizeof(uint));
  }
  return film;
}

void read_open_blocks(const WordImage& words, const Facts& facts, Film& film) {
  const PassSet blocks = PassSet::parse(facts.text("open"));
  for (const PassRange& range : blocks.ranges())
    for (std::uint64_t block = range.first; block < range.last; ++block) {
      std::vector<BlockSum>& sums = film.open[block];
      sums.resize(film.pixels.size());
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t w = 0; w < FILM_SUM_WORDS; ++w) {
          const int a = words.channel(open_name(block, c, w));
          for (std::size_t i = 0; a >= 0 && i < sums.size(); ++i)
            sums[i][c][w] = words.data[i * words.channels.size() + std::size_t(a)];
        }
    }
}

void read_layers(const WordImage& words, const Facts& facts, Film& film) {
  if (!words.metadata.count(key("layer_set"))) return;
  Layers& layers = film.layers;
  layers = Layers(uint(facts.number("layer_set")),
                  std::ldexp(1.0f, int(facts.number("layer_exponent"))), film.pixels.size());
  for (const auto& [name, word] : layer_words(layers)) {
    const int from = words.channel(name);  // left out where it is 0 everywhere
    for (std::size_t i = 0; from >= 0 && i < film.pixels.size(); ++i)
      layers.words[i * layers.words_per_pixel() + word] =
          words.data[i * words.channels.size() + std::size_t(from)];
  }
}

std::vector<AovChannel> read_aovs(const WordImage& words, const Facts& facts) {
  std::vector<AovChannel> aovs;
  const std::string list = facts.text("aovs");
  const std::size_t pixels = std::size_t(words.width) * std::size_t(words.height);
  for (std::size_t begin = 0; list != no_aovs && begin < list.size();) {
    const std::size_t end = std::min(list.find(' ', begin), list.size());
    AovChannel aov{list.substr(begin, end - begin), std::vector<float>(pixels)};
    begin = end + 1;
    const int from = words.channel("aov." + aov.name);  // left out where it is 0 everywhere
    for (std::size_t i = 0; from >= 0 && i < pixels; ++i)
      std::memcpy(&aov.data[i], &words.data[i * words.channels.size() + std::size_t(from)],
                  sizeof(uint));
    aovs.push_back(std::move(aov));
  }
  return aovs;
}

/// "a", or "a; b" where the films come from different places.
void join_evidence(std::map<std::string, MetaValue>& into,
                   const std::map<std::string, MetaValue>& other, const std::string& name) {
  const auto theirs = other.find(name);
  if (theirs == other.end() || !std::holds_alternative<std::string>(theirs->second)) return;
  const std::string& text = std::get<std::string>(theirs->second);
  const auto ours = into.find(name);
  if (ours == into.end() || !std::holds_alternative<std::string>(ours->second)) {
    into[name] = text;
    return;
  }
  std::string& all = std::get<std::string>(ours->second);
  if (("; " + all + "; ").find("; " + text + "; ") == std::string::npos) all += "; " + text;
}

}  // namespace

void add_missing(std::vector<AovChannel>& channels, const std::vector<AovChannel>& more) {
  for (const AovChannel& aov : more) {
    const bool there = std::any_of(channels.begin(), channels.end(),
                                   [&](const AovChannel& c) { return c.name == aov.name; });
    if (!there) channels.push_back(aov);
  }
}

std::string difference(const std::map<std::string, std::string>& a,
                       const std::map<std::string, std::string>& b) {
  std::map<std::string, std::array<std::string, 2>> both;
  for (const auto& [name, value] : a) both[name][0] = value;
  for (const auto& [name, value] : b) both[name][1] = value;
  std::vector<std::string> all;
  for (const auto& [name, value] : both) {
    const auto told = [](const std::string& v) { return v.empty() ? "not given" : v; };
    if (value[0] != value[1])
      all.push_back(fmt::format("{} is {} in the one and {} in the other", name, told(value[0]),
                                told(value[1])));
  }
  return join(all, "; ");
}

void write_checkpoint(const std::string& path, const Film& film, const CheckpointFacts& facts) {
  WordImage words;
  words.width = film.window.width;
  words.height = film.window.height;
  planes_of(film, facts).put_into(words);
  words.metadata = facts.evidence;
  PassSet open;
  for (const auto& [block, sums] : film.open) open.add({block, block + 1});
  const auto put = [&](const std::string& name, const std::string& value) {
    words.metadata[key(name)] = value;
  };
  put("version", format_version);
  put("x0", std::to_string(film.window.x0)), put("y0", std::to_string(film.window.y0));
  put("width", std::to_string(film.width)), put("height", std::to_string(film.height));
  put("lsb", std::to_string(film.lsb)), put("block_size", std::to_string(film.block_size));
  put("passes", film.passes.text()), put("open", open.text());
  put("current", film.current ? std::to_string(*film.current) : "none");
  if (film.layers.set) {
    put("layer_set", std::to_string(film.layers.set));
    put("layer_exponent", std::to_string(std::ilogb(film.layers.scale)));
  }
  put("seconds", fmt::format("{}", facts.seconds));
  std::vector<std::string> aovs;
  for (const AovChannel& aov : facts.aovs) aovs.push_back(aov.name);
  put("aovs", aovs.empty() ? no_aovs : fmt::format("{}", fmt::join(aovs, " ")));
  for (const auto& [name, value] : facts.identity) put("identity." + name, value);
  for (const Counter& c : facts.counters) put("counter." + c.name, std::to_string(c.count));
  for (std::size_t i = 0; i < facts.cuts.size(); ++i) {
    const DepthCut& cut = facts.cuts[i];
    if (cut.paths) put(cut_key(i), fmt::format("{} {} {}", cut.whole, cut.part, cut.paths));
  }
  put("hash", content_hash(words));
  write_words(path, words);
}

bool is_checkpoint(const std::map<std::string, MetaValue>& metadata) {
  return metadata.count(key("version")) > 0;
}

Checkpoint read_checkpoint(const std::string& path) {
  const WordImage words = read_words(path);
  if (!is_checkpoint(words.metadata))
    throw InputError(fmt::format("'{}' is an image, not a checkpoint of pellucid", path));
  const Facts facts(path, words.metadata);
  if (facts.text("version") != format_version)
    throw InputError(fmt::format("checkpoint '{}' is of version {}, and this pellucid reads {}",
                                 path, facts.text("version"), format_version));
  if (facts.text("hash") != content_hash(words)) facts.fail("its content does not match its hash");
  Checkpoint out{film_of(words, facts), {}};
  CheckpointFacts& about = out.facts;
  about.aovs = read_aovs(words, facts);
  read_open_blocks(words, facts, out.film);
  read_layers(words, facts, out.film);
  const std::string seconds = facts.text("seconds");
  std::from_chars(seconds.data(), seconds.data() + seconds.size(), about.seconds);
  for (Counter& c : about.counters)
    if (words.metadata.count(key("counter." + c.name)))
      c.count = std::uint64_t(facts.number("counter." + c.name));
  about.cuts = read_cuts(words, facts);
  const std::string identity = key("identity.");
  for (const auto& [name, value] : words.metadata) {
    if (name.rfind(identity, 0) == 0)
      about.identity[name.substr(identity.size())] = facts.text(name.substr(std::strlen(prefix)));
    else if (name.rfind(prefix, 0) != 0 &&
             (name.rfind("pellucid:", 0) == 0 || name.rfind("worldTo", 0) == 0))
      about.evidence[name] = value;  // the rest is the file format's own
  }
  return out;
}

void merge_checkpoint(Checkpoint& into, const std::string& into_name, const Checkpoint& other,
                      const std::string& other_name) {
  const std::string what = difference(into.facts.identity, other.facts.identity);
  if (!what.empty())
    throw InputError(
        fmt::format("'{}' and '{}' are not of the same picture: {}", into_name, other_name, what));
  if (into.film.passes.overlaps(other.film.passes))
    throw InputError(fmt::format("'{}' ({}) and '{}' ({}) share passes, which would count twice",
                                 into_name, into.film.passes.text(), other_name,
                                 other.film.passes.text()));
  into.film.merge(other.film);
  into.facts.seconds += other.facts.seconds;
  for (std::size_t i = 0; i < into.facts.counters.size(); ++i)
    into.facts.counters[i].count += other.facts.counters[i].count;
  add_cuts(into.facts.cuts, other.facts.cuts);
  add_missing(into.facts.aovs, other.facts.aovs);
  for (const char* place : {"pellucid:device", "pellucid:driver", "pellucid:version"})
    join_evidence(into.facts.evidence, other.facts.evidence, place);
  for (const char* of_one : {"pellucid:relmseUpper", "pellucid:relmseConfidence"})
    into.facts.evidence.erase(of_one);
}

std::string kernels_hash(const Integrator& integrator, const std::string& kernel_dir) {
  const KernelFiles files(kernel_dir);
  Hasher hasher;
  for (const Pass& pass : integrator.passes)
    hasher.add(files.expand("passes/" + pass.name + ".cl", ""));
  return hasher.hex();
}

}  // namespace pellucid
