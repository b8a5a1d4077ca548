// Films on the host: passes split, resumed and merged in any way give the same bits; checkpoints
// come back whole or not at all.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "base/error.h"
#include "base/files.h"
#include "render/checkpoint.h"
#include "shared/film_sums.h"

namespace pellucid {
namespace {

constexpr int width = 5, height = 3;
constexpr int lsb = -FILM_FRACTION_BITS;

/// Radiance of a pixel and channel in one pass: any pure function will do.
float sample(std::uint64_t pass, std::size_t pixel, int c) {
  std::mt19937 engine(unsigned(pass * 1000003u + pixel * 31u + unsigned(c)));
  return std::ldexp(float(engine() >> 8), -20 - int(engine() % 30));
}

/// What the device does with one pass.
void add_pass(Film& film, std::uint64_t pass) {
  const std::uint64_t block = pass / film.block_size;
  film.select_block(block);
  film.passes.add({pass, pass + 1});
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const float x = sample(pass, i, c);
      uint bits;
      std::memcpy(&bits, &x, sizeof bits);
      WideValue v = wide_from_float(bits);
      v.exponent -= lsb;
      wide_add(film.pixels[i].block[c], FILM_SUM_WORDS, wide_round(v));
    }
    // A few values that come often: the first of equal ones must win in any order.
    film_keep_peak(&film.pixels[i], std::floor(8 * sample(pass, i, 0)), uint(pass));
    ++film.pixels[i].count[0];
    film.pixels[i].count[1] += 7;
  }
  if (!film.passes.contains(film.block_range(block))) return;
  for (FilmPixel& p : film.pixels) film_end_block(&p);
  film.current.reset();
}

Film film_of(std::vector<std::uint64_t> passes, std::uint64_t block_size) {
  Film film(width, height, {0, 0, width, height}, lsb, block_size);
  for (std::uint64_t pass : passes) add_pass(film, pass);
  return film;
}

std::vector<std::uint64_t> range(std::uint64_t first, std::uint64_t last) {
  std::vector<std::uint64_t> all;
  for (std::uint64_t i = first; i < last; ++i) all.push_back(i);
  return all;
}

void expect_same(Film a, Film b, const std::string& what) {
  a.set_aside();
  b.set_aside();
  EXPECT_EQ(a.passes.text(), b.passes.text()) << what;
  EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(FilmPixel)), 0)
      << what;
  EXPECT_EQ(a.open, b.open) << what;
  const std::vector<float> x = film_image(a, true, true).data, y = film_image(b, true, true).data;
  ASSERT_EQ(x.size(), y.size());
  EXPECT_EQ(std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]), 0) << what;
}

TEST(PassSet, KeepsRangesJoinedAndSorted) {
  PassSet set;
  set.add({32, 48});
  set.add({0, 16});
  EXPECT_EQ(set.text(), "0:16,32:48");
  set.add({16, 20});
  EXPECT_EQ(set.text(), "0:20,32:48");
  EXPECT_EQ(set.count(), 36u);
  EXPECT_EQ(set.count({10, 40}), 18u);
  EXPECT_TRUE(set.contains({5, 20}));
  EXPECT_FALSE(set.contains({5, 21}));
  EXPECT_THROW(set.add({19, 21}), InternalError);
  set.add({20, 32});
  EXPECT_EQ(set.text(), "0:48");
}

TEST(PassSet, TellsWhatIsMissing) {
  const PassSet set = PassSet::parse("4:8,12:16");
  const auto gaps = set.missing({0, 20});
  ASSERT_EQ(gaps.size(), 3u);
  EXPECT_EQ(gaps[0].first, 0u);
  EXPECT_EQ(gaps[0].last, 4u);
  EXPECT_EQ(gaps[1].first, 8u);
  EXPECT_EQ(gaps[1].last, 12u);
  EXPECT_EQ(gaps[2].first, 16u);
  EXPECT_EQ(gaps[2].last, 20u);
  EXPECT_TRUE(set.missing({5, 7}).empty());
  EXPECT_TRUE(set.overlaps(PassSet::parse("7:9")));
  EXPECT_FALSE(set.overlaps(PassSet::parse("8:12,16:99")));
}

TEST(PassSet, RefusesWhatIsNoList) {
  for (const char* text : {"", "1", "2:1", "1:1", "0:4,", "0:4,2:6", "a:b", "-1:4", "0:4 5:6"})
    EXPECT_THROW(PassSet::parse(text), InputError) << text;
  EXPECT_EQ(PassSet::parse("none").count(), 0u);
}

TEST(FilmTest, AnyOrderOfPassesGivesTheSameBits) {
  std::mt19937 engine(1);
  for (std::uint64_t block_size : {1, 4, 16}) {
    const Film whole = film_of(range(0, 37), block_size);
    std::vector<std::uint64_t> passes = range(0, 37);
    std::shuffle(passes.begin(), passes.end(), engine);
    expect_same(whole, film_of(passes, block_size), "shuffled");
  }
}

TEST(FilmTest, AnySplitMergesToTheSameBits) {
  std::mt19937 engine(2);
  for (std::uint64_t block_size : {1, 4, 16})
    for (int run = 0; run < 20; ++run) {
      const Film whole = film_of(range(3, 53), block_size);
      std::vector<std::uint64_t> cuts = {3, 53};
      for (int i = 0; i < 4; ++i) cuts.push_back(3 + engine() % 50);
      std::sort(cuts.begin(), cuts.end());
      std::vector<Film> parts;
      for (std::size_t i = 1; i < cuts.size(); ++i)
        if (cuts[i] > cuts[i - 1])
          parts.push_back(film_of(range(cuts[i - 1], cuts[i]), block_size));
      std::shuffle(parts.begin(), parts.end(), engine);
      Film all = parts.front();
      for (std::size_t i = 1; i < parts.size(); ++i) all.merge(parts[i]);
      expect_same(whole, all, "blocks of " + std::to_string(block_size));
    }
}

TEST(FilmTest, MeanAndVarianceAreThoseOfTheSamples) {
  for (std::uint64_t block_size : {1, 4}) {
    const Film film = film_of(range(0, 42), block_size);
    const Image image = film_image(film, true, true);
    const std::uint64_t blocks = 42 / block_size;
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      double sum = 0, block_sum = 0, block_square = 0;
      for (std::uint64_t b = 0; b < blocks; ++b) {
        double total = 0;
        for (std::uint64_t k = 0; k < block_size; ++k)
          total += double(sample(b * block_size + k, i, 0));
        block_sum += total;
        block_square += total * total;
      }
      for (std::uint64_t p = 0; p < 42; ++p) sum += double(sample(p, i, 0));
      const double of_total =
          (block_square - block_sum * block_sum / double(blocks)) / double(blocks - 1);
      const float* pixel = &image.data[i * image.channels.size()];
      EXPECT_NEAR(pixel[0], sum / 42, 1e-6 * sum / 42);
      EXPECT_NEAR(pixel[3], of_total / (double(block_size) * 42), 1e-5 * pixel[3]);
      EXPECT_EQ(pixel[6], 42.0f);
    }
  }
}

TEST(FilmTest, VarianceOfOneBlockIsUnknown) {
  const Image image = film_image(film_of(range(0, 7), 4), true, false);
  EXPECT_TRUE(std::isnan(image.data[3]));
  EXPECT_TRUE(std::isnan(summarise(film_of(range(0, 7), 4)).relmse));
  EXPECT_FALSE(std::isnan(summarise(film_of(range(0, 8), 4)).relmse));
}

class CheckpointTest : public ::testing::Test {
 protected:
  std::string path = ::testing::TempDir() + "pellucid_checkpoint_test";
  ~CheckpointTest() override { std::filesystem::remove(path); }

  void write(const Film& film) { write_checkpoint(path, film, example(film).facts); }

  static Checkpoint example(const Film& film) {
    Checkpoint c{film, {{{"seed", "7"}, {"scene", "abc"}}, {}, make_counters(), {}, 12.5, {}}};
    c.facts.evidence["pellucid:scene"] = std::string("example");
    c.facts.counters[1].count = 5;
    c.facts.cuts[CUT_light] = {3, 0xfffffff0u, 7};
    c.facts.aovs = {{"Z", {}}, {"N.X", {}}};
    for (int i = 0; i < width * height; ++i) {
      c.facts.aovs[0].data.push_back(float(i) / 3);
      c.facts.aovs[1].data.push_back(-float(i));
    }
    return c;
  }
};

TEST_F(CheckpointTest, ComesBackBitForBit) {
  for (std::uint64_t block_size : {1, 16}) {
    Film film = film_of(range(5, 40), block_size);
    write(film);
    const Checkpoint back = read_checkpoint(path);
    expect_same(film, back.film, "read back");
    EXPECT_EQ(back.film.current, film.current);
    EXPECT_EQ(back.facts.identity, example(film).facts.identity);
    EXPECT_EQ(back.facts.evidence, example(film).facts.evidence);
    EXPECT_EQ(back.facts.counters[1].count, 5u);
    EXPECT_EQ(back.facts.cuts[CUT_light].whole, 3u);
    EXPECT_EQ(back.facts.cuts[CUT_light].part, 0xfffffff0u);
    EXPECT_EQ(back.facts.cuts[CUT_light].paths, 7u);
    EXPECT_EQ(back.facts.cuts[CUT_camera].paths, 0u);
    EXPECT_EQ(back.facts.seconds, 12.5);
    ASSERT_EQ(back.facts.aovs.size(), 2u);
    for (std::size_t a = 0; a < 2; ++a) {
      EXPECT_EQ(back.facts.aovs[a].name, example(film).facts.aovs[a].name);
      EXPECT_EQ(back.facts.aovs[a].data, example(film).facts.aovs[a].data);
    }
    // Going on gives what an uninterrupted render gives.
    Film further = back.film;
    for (std::uint64_t pass = 40; pass < 50; ++pass) add_pass(further, pass);
    expect_same(film_of(range(5, 50), block_size), further, "gone on with");
  }
}

TEST_F(CheckpointTest, WindowsOfAPictureComeBack) {
  Film film(100, 80, {10, 20, width, height}, lsb, 1);
  add_pass(film, 0);
  write(film);
  const Film back = read_checkpoint(path).film;
  EXPECT_TRUE(back.window == film.window);
  EXPECT_EQ(back.width, 100);
  EXPECT_EQ(back.height, 80);
}

TEST_F(CheckpointTest, CutAnywhereItIsRefused) {
  write(film_of(range(0, 20), 16));
  const std::string whole = read_text(path);
  for (int i = 0; i < 40; ++i) {
    std::ofstream(path, std::ios::binary) << whole.substr(0, whole.size() * std::size_t(i) / 40);
    EXPECT_THROW(read_checkpoint(path), InputError) << "cut at " << i << "/40";
  }
}

TEST_F(CheckpointTest, DamagedItIsRefusedOrUnharmed) {
  const Film film = film_of(range(0, 20), 16);
  write(film);
  const std::string whole = read_text(path);
  std::mt19937 engine(3);
  for (int i = 0; i < 400; ++i) {
    std::string damaged = whole;
    damaged[engine() % damaged.size()] ^= char(1u << engine() % 8);
    std::ofstream(path, std::ios::binary) << damaged;
    try {  // a flipped bit may hit what carries no meaning, but sums never change
      expect_same(film, read_checkpoint(path).film, "after a flipped bit");
    } catch (const InputError&) {
    }
  }
}

TEST_F(CheckpointTest, OnlyFilmsOfOnePictureMerge) {
  Checkpoint a = example(film_of(range(0, 8), 1)), b = example(film_of(range(8, 12), 1));
  merge_checkpoint(a, "a", b, "b");
  EXPECT_EQ(a.film.passes.text(), "0:12");
  EXPECT_EQ(a.facts.seconds, 25.0);
  EXPECT_EQ(a.facts.aovs.size(), 2u) << "the same channels once";
  EXPECT_THROW(merge_checkpoint(a, "a", b, "b"), InputError) << "the same passes twice";
  b.film = film_of(range(20, 21), 1);
  b.facts.identity["seed"] = "8";
  try {
    merge_checkpoint(a, "first", b, "second");
    FAIL();
  } catch (const InputError& e) {
    for (const char* part : {"first", "second", "seed", "7", "8"})
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace pellucid
