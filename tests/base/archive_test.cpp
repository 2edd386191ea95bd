#include "quoll/base/archive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>

#include "quoll/base/random.hpp"

namespace {
/// The largest single allocation of this thread since it was last set to 0.
thread_local std::size_t largest_request = 0;
}  // namespace

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define QUOLL_NEW_IS_TAKEN  // by clang's runtime, which brings its own
#endif
#endif

#if !defined(QUOLL_NEW_IS_TAKEN)
// Replaced to see that a damaged length never reaches the allocator. Not inlined, since the
// compiler would warn of free() for what came from new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  largest_request = std::max(largest_request, size);
  if (void* memory = std::malloc(std::max<std::size_t>(size, 1))) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
#endif

namespace quoll {
namespace {

enum class Rule : std::uint8_t { standard, printed };

struct Visit {
  std::uint32_t state = 0;
  std::string action;
  std::array<double, 16> padding{};  // far larger in memory than its shortest record in the file

  void persist(Archive& archive) {
    archive("state", state);
    archive("action", action);
  }
  bool operator==(const Visit&) const = default;
};

struct Sample {
  bool done = false;
  std::uint8_t tiny = 0;
  std::int16_t small = 0;
  std::int32_t medium = 0;
  std::uint64_t steps = 0;
  float rate = 0;
  double discount = 0;
  Rule rule = Rule::standard;
  std::string name;
  std::vector<float> q;
  std::vector<std::string> names;
  std::vector<Visit> visits;
  std::vector<std::vector<double>> rows;
  std::array<std::uint16_t, 3> counts{};
  std::array<Visit, 2> ends{};
  std::optional<double> limit;
  std::optional<Visit> last;
  std::uint64_t generator = 0;

  void persist(Archive& archive) {
    archive("done", done);
    archive("tiny", tiny);
    archive("small", small);
    archive("medium", medium);
    archive("steps", steps);
    archive("rate", rate);
    archive("discount", discount);
    archive("rule", rule);
    archive("name", name);
    archive("q", q);
    archive("names", names);
    archive("visits", visits);
    archive("rows", rows);
    archive("counts", counts);
    archive("ends", ends);
    archive("limit", limit);
    archive("last", last);
    archive("generator", generator);
  }
  bool operator==(const Sample&) const = default;
};

Sample sample() {
  Sample run;
  run.done = true;
  run.tiny = 200;
  run.small = -2;
  run.medium = std::numeric_limits<std::int32_t>::min();
  run.steps = std::numeric_limits<std::uint64_t>::max();
  run.rate = 0.1f;
  run.discount = -0.0;
  run.rule = Rule::printed;
  run.name = std::string("HALL\0x", 6);
  run.q = {1.0f, -2.5f, std::numeric_limits<float>::infinity()};
  run.names = {"GATE", "", "POOL"};
  run.visits = {{1, "To-CAVE", {}}, {2, "", {}}};
  run.rows = {{1, 2}, {}, {3}};
  run.counts = {7, 8, 9};
  run.ends[1].state = 5;
  run.limit = 2.5;
  run.last = Visit{3, "To-GOAL", {}};
  run.generator = 99;
  return run;
}

std::vector<std::byte> saved(Sample run) {
  Archive archive;
  archive("run", run);
  EXPECT_TRUE(archive.good());
  return archive.bytes();
}

/// What was wrong, or "" when all was read to the end.
std::string load(std::span<const std::byte> bytes, Sample& run) {
  Archive archive(bytes);
  archive("run", run);
  if (!archive.good()) return archive.error().expected;
  return archive.at_end() ? "" : "bytes are left over";
}

TEST(Archive, ReadsBackWhatItWrote) {
  Sample loaded;
  loaded.limit = 1;
  loaded.q = {5, 5, 5, 5, 5};
  EXPECT_EQ(load(saved(sample()), loaded), "");
  EXPECT_EQ(loaded, sample());
  EXPECT_TRUE(std::signbit(loaded.discount));

  Sample full = sample();
  EXPECT_EQ(load(saved(Sample{}), full), "");
  EXPECT_EQ(full, Sample{}) << "what was in the target must not survive";
}

// docs/formats.md: length of the name, name, type, count (8 bytes), values, least significant byte
// first.
TEST(Archive, TheBytesAreAsSpecified) {
  Archive archive;
  std::uint32_t number = 0x01020304;
  archive("ab", number);
  std::string text = "xy";
  archive("t", text);
  const unsigned char expected[] = {2, 'a', 'b', '4', 1, 0, 0, 0, 0, 0, 0, 0, 4,   3,  2,
                                    1, 1,   't', '1', 2, 0, 0, 0, 0, 0, 0, 0, 'x', 'y'};
  ASSERT_EQ(archive.bytes().size(), sizeof expected);
  for (std::size_t i = 0; i < sizeof expected; ++i) {
    EXPECT_EQ(std::to_integer<unsigned>(archive.bytes()[i]), expected[i]) << i;
  }
}

template <class Saved, class Loaded>
std::string mismatch(std::string_view name, Saved value, Loaded target, std::string_view asked) {
  Archive writer;
  writer(name, value);
  Archive reader(writer.bytes());
  reader(asked, target);
  return reader.good() ? "taken" : reader.error().expected;
}

TEST(Archive, TheFirstFieldThatDiffersIsNamed) {
  EXPECT_EQ(mismatch("steps", 1u, 1u, "step"), "field 'step' expected, not 'steps'");
  EXPECT_EQ(mismatch("rate", 1.0f, 1.0, "rate"), "field 'rate' of type 'd' expected, not 'f'");
  EXPECT_EQ(mismatch("s", std::uint64_t{1}, std::uint32_t{1}, "s"),
            "field 's' of type '4' expected, not '8'");
  EXPECT_EQ(mismatch("a", std::array<int, 2>{}, std::array<int, 3>{}, "a"),
            "field 'a' with 3 values expected, not 2");
  EXPECT_EQ(mismatch("a", std::array<std::string, 2>{}, std::array<std::string, 1>{}, "a"),
            "field 'a' with 1 values expected, not 2");
  EXPECT_EQ(mismatch("a", std::vector<int>{1, 2}, 1, "a"),
            "field 'a' with 1 values expected, not 2");
  EXPECT_EQ(mismatch("a\n", 1, 1, "b"), "field 'b' expected, not 'a?'");
  Archive empty(std::span<const std::byte>{});
  int number = 7;
  empty("n", number);
  EXPECT_EQ(empty.error().expected, "field 'n' expected, but the content ends");
  EXPECT_EQ(number, 7);
}

TEST(Archive, AfterAFailureNothingIsRead) {
  Archive writer;
  int one = 1;
  writer("a", one);
  writer("b", one);
  Archive reader(writer.bytes());
  int a = 0;
  int b = 0;
  reader("x", a);
  reader("b", b);
  EXPECT_FALSE(reader.good());
  EXPECT_EQ(b, 0);
  reader.fail("a later reason");
  EXPECT_EQ(reader.error().expected, "field 'x' expected, not 'a'") << "the first reason stays";
}

TEST(Archive, ATruthValueIsZeroOrOne) {
  EXPECT_EQ(mismatch("b", true, false, "b"), "taken");
  Archive writer;
  bool truth = true;
  writer("b", truth);
  auto bytes = writer.bytes();
  bytes.back() = std::byte{2};
  Archive reader(bytes);
  reader("b", truth);
  EXPECT_EQ(reader.error().expected, "a truth value is 0 or 1");
}

TEST(Archive, EveryTruncationIsRefused) {
  const auto bytes = saved(sample());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    // A copy of exactly that size, so that a sanitizer sees a read beyond it.
    const std::vector<std::byte> cut(bytes.begin(), bytes.begin() + size);
    Sample run;
    largest_request = 0;
    EXPECT_NE(load(cut, run), "") << size;
    EXPECT_LE(largest_request, 100 * bytes.size()) << size;
  }
}

TEST(Archive, EveryFlippedByteIsSurvived) {
  const auto bytes = saved(sample());
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (const int flip : {0x01, 0x80, 0xff, 0x20, 0x40}) {
      auto damaged = bytes;
      damaged[at] ^= static_cast<std::byte>(flip);
      Sample run;
      largest_request = 0;
      static_cast<void>(
          load(damaged, run));  // a flipped value is a value; only the container can tell
      EXPECT_LE(largest_request, 100 * bytes.size()) << at;
    }
  }
}

TEST(Archive, RandomDamageIsSurvived) {
  const auto bytes = saved(sample());
  Rng rng = stream(3, "damage");
  for (int round = 0; round < 20'000; ++round) {
    auto damaged = bytes;
    for (std::uint32_t count = 1 + rng.below(4); count > 0; --count) {
      const std::uint32_t at = rng.below(static_cast<std::uint32_t>(damaged.size()));
      damaged[at] = static_cast<std::byte>(rng.below(256));
    }
    Sample run;
    largest_request = 0;
    static_cast<void>(load(damaged, run));
    ASSERT_LE(largest_request, 100 * bytes.size()) << round;
  }
}

// The claim of 2^60 values is refused before any allocation, for flat values, strings and structs.
TEST(Archive, AHugeClaimAllocatesNothing) {
  const auto claim = [](auto value) {
    Archive writer;
    writer("v", value);
    auto bytes = writer.bytes();
    bytes[10] = std::byte{0x10};  // the highest byte of the count, after 1 + 1 + 1 + 7 bytes
    Archive reader(bytes);
    largest_request = 0;
    reader("v", value);
    EXPECT_LT(largest_request, 1000u);
    return reader.error().expected.substr(0, 32);
  };
  const std::string refusal = "field 'v' claims 115292150460684";
  EXPECT_EQ(claim(std::vector<double>{1}), refusal);
  EXPECT_EQ(claim(std::string("x")), refusal);
  EXPECT_EQ(claim(std::vector<std::string>{"x"}), refusal);
  EXPECT_EQ(claim(std::vector<Visit>{{}}), refusal);
  EXPECT_EQ(claim(std::optional<int>{1}), refusal);
}

}  // namespace
}  // namespace quoll
