// Every settings struct: each key is accepted as a flag's text and in a file, printed, restored.

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <set>

#include "quoll/base/file.hpp"
#include "quoll/experiment/config.hpp"
#include "quoll/experiment/settings.hpp"

namespace quoll {
namespace {

// Another value than the default, as a person would write it.
std::string other(const Setting& setting) {
  if (setting.name == "seed") return "18446744073709551615";
  if (std::holds_alternative<bool*>(setting.field)) return "true";
  if (std::holds_alternative<double*>(setting.field)) return setting.high >= 1 ? "0.625" : "0.125";
  if (const auto* choice = std::get_if<Choice>(&setting.field)) {
    return std::string(choice->names.back());
  }
  if (std::holds_alternative<std::string*>(setting.field)) return "it's \"x\" \\ y";
  return "7";
}

std::vector<std::string> texts(const std::vector<Setting>& settings) {
  std::vector<std::string> all;
  for (const Setting& setting : settings) all.push_back(text_of(setting));
  return all;
}

std::vector<Setting> limits_of(RunSettings& settings) {
  Describer list;
  settings.describe_limits(list);
  return list.settings();
}

Result<void> read_text(const std::string& text, RunSettings& settings) {
  const std::string path = testing::TempDir() + "quoll-" + std::to_string(getpid()) + ".toml";
  EXPECT_TRUE(write_file(path, text));
  const Result<void> read = read_config(path, settings_of(settings));
  std::remove(path.c_str());
  return read;
}

TEST(Settings, EveryKeyIsDescribedOnce) {
  RunSettings settings;
  std::vector<Setting> all = settings_of(settings);
  for (const Setting& limit : limits_of(settings)) all.push_back(limit);
  std::set<std::string_view> names;
  for (const Setting& setting : all) {
    EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
    EXPECT_FALSE(setting.sentence.empty()) << setting.name;
    EXPECT_EQ(setting.name.find('-'), std::string_view::npos) << setting.name;
    EXPECT_FALSE(range_of(setting).empty()) << setting.name;
  }
}

TEST(Settings, EveryKeyTakesAFlagsText) {
  RunSettings settings;
  std::vector<Setting> all = settings_of(settings);
  for (const Setting& limit : limits_of(settings)) all.push_back(limit);
  for (const Setting& setting : all) {
    const std::string before = text_of(setting), text = other(setting);
    ASSERT_TRUE(assign(setting, text, "--x")) << setting.name;
    EXPECT_NE(text_of(setting), before) << setting.name;
    ASSERT_TRUE(assign(setting, text_of(setting), "--x")) << setting.name;
    if (std::holds_alternative<std::string*>(setting.field)) continue;
    const std::string kept = text_of(setting);
    EXPECT_FALSE(assign(setting, "no such value", "--x")) << setting.name;
    EXPECT_EQ(text_of(setting), kept) << setting.name;
  }
}

TEST(Settings, EveryKeyGoesThroughAFileAndAnArchive) {
  RunSettings written;
  for (const Setting& setting : settings_of(written)) {
    ASSERT_TRUE(assign(setting, other(setting), "--x")) << setting.name;
  }
  const std::string text = config_text(settings_of(written));
  for (const Setting& setting : settings_of(written)) {
    EXPECT_NE(text.find(std::string(setting.name) + " = "), std::string::npos) << setting.name;
  }
  RunSettings read;
  const Result<void> result = read_text(text, read);
  ASSERT_TRUE(result) << message(result.error());
  EXPECT_EQ(texts(settings_of(read)), texts(settings_of(written)));

  written.learn.until_stable = false;
  Archive out;
  out("settings", written);
  RunSettings restored;
  Archive in{std::span<const std::byte>(out.bytes())};
  in("settings", restored);
  ASSERT_TRUE(in.good() && in.at_end());
  EXPECT_EQ(texts(settings_of(restored)), texts(settings_of(written)));
  EXPECT_FALSE(restored.learn.until_stable);
}

TEST(Settings, AFileSaysWhatIsWrongAndWhere) {
  RunSettings settings;
  const auto unknown = read_text("seed = 1\nmethd = 'q-learning'\n", settings);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().line, 2u);
  EXPECT_EQ(unknown.error().nearest, "method");
  for (const char* text :
       {"seed = -1", "discount = 2", "seed = [1]", "step_size = [[1]]", "seed = 1979-05-27",
        "[seed]\na = 1", "ties = 'never'", "seed = ", "force = 'maybe'"}) {
    const auto wrong = read_text(std::string(text) + "\n", settings);
    EXPECT_FALSE(wrong) << text;
    if (wrong) continue;
    EXPECT_NE(message(wrong.error()).find(".toml"), std::string::npos) << text;
  }
}

TEST(Settings, ASavedChoiceThatDoesNotExistIsRefused) {
  RunSettings settings;
  settings.learn.ties = static_cast<Ties>(9);
  Archive out;
  out("settings", settings);
  RunSettings restored;
  Archive in{std::span<const std::byte>(out.bytes())};
  in("settings", restored);
  EXPECT_FALSE(in.good());
}

TEST(Settings, Durations) {
  EXPECT_EQ(*parse_duration("10s", "--time"), 10.0);
  EXPECT_EQ(*parse_duration("2m", "--time"), 120.0);
  EXPECT_EQ(*parse_duration("1.5h", "--time"), 5400.0);
  EXPECT_EQ(*parse_duration("500ms", "--time"), 0.5);
  EXPECT_EQ(*parse_duration("3", "--time"), 3.0);
  for (const char* text : {"", "s", "-1s", "0s", "1d", "1e3s", "1 2s", "nan", "..s"}) {
    EXPECT_FALSE(parse_duration(text, "--time")) << text;
  }
}

}  // namespace
}  // namespace quoll
