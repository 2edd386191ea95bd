// The rules that hold over all sources (docs/design.md, sections 4, 5 and 9): who may include whom,
// what the core does without, and the size of a file.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

// Section 4: a file includes only lower floors or its own folder.
const std::map<std::string, int> floors = {
    {"base", 0},   {"model", 1},  {"nn", 1},   {"env", 2},   {"act", 2},
    {"solve", 3},  {"verify", 3}, {"plan", 4}, {"learn", 5}, {"experiment", 6},
    {"report", 7}, {"dist", 7},   {"cli", 8}};

// Section 5: these compile without exceptions and run in WebAssembly.
const std::set<std::string> core = {"base", "model", "env", "act", "solve", "verify", "learn"};

// The text without comments and without what stands in quotes, line by line; raw strings excepted.
std::vector<std::string> code_lines(const std::string& text) {
  static const std::regex line_comment("//.*$");
  static const std::regex quoted(R"re("(\\.|[^"\\])*")re");
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.find("#include") == std::string::npos) line = std::regex_replace(line, quoted, "\"\"");
    lines.push_back(std::regex_replace(line, line_comment, ""));
  }
  return lines;
}

// "base/error.hpp" -> "base"; "quoll.hpp" -> "".
std::string folder_of(const std::string& path) {
  const auto slash = path.find('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

bool may_include(const std::string& from, const std::string& to) {
  if (from.empty() || from == to) return true;  // quoll.hpp gathers everything
  if (!floors.contains(from) || !floors.contains(to)) return false;
  if (from == "verify") return to == "base" || to == "model";
  return floors.at(to) < floors.at(from);
}

// What is wrong with the file at `path` (below quoll/); each entry is one line for a person.
std::vector<std::string> violations(const std::string& path, const std::string& text) {
  static const std::regex own(R"re(^\s*#\s*include\s*"([^"]*)")re");
  static const std::regex system(R"re(^\s*#\s*include\s*<([^>]*)>)re");
  static const std::regex not_in_core(
      R"re(\bthrow\b|<iostream>|<format>|std::views|std::ranges::views)re");
  static const std::regex nowhere(
      R"re(std::(uniform|normal|bernoulli|discrete|exponential|geometric|poisson)\w*_)re"
      R"re(distribution|)re"
      R"re(std::shuffle|std::hash\b|ffast-math)re");
  std::vector<std::string> found;
  const std::string folder = folder_of(path);
  const bool header = path.ends_with(".hpp");
  const auto lines = code_lines(text);
  if (!folder.empty() && !floors.contains(folder))
    found.push_back(path + ": a folder without a floor");
  if (lines.size() > 400) found.push_back(path + ": over 400 lines");
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string place = path + ":" + std::to_string(i + 1) + ": ";
    std::smatch match;
    if (std::regex_search(lines[i], match, own)) {
      const std::string target = match[1];
      if (target.ends_with(".inc")) continue;  // generated: a source's own matter
      if (!target.starts_with("quoll/")) {
        found.push_back(place + "include as \"quoll/folder/file.hpp\"");
      } else if (!may_include(folder, folder_of(target.substr(6)))) {
        found.push_back(place + folder + " may not include " + target);
      }
    }
    if (header && std::regex_search(lines[i], match, system) &&
        match[1].str().find_first_of("./") != std::string::npos &&
        !match[1].str().ends_with("mmintrin.h")) {  // the compiler's own: vector registers
      found.push_back(place + "a header includes only the standard library and Quoll");
    }
    if (core.contains(folder) && path != "base/raise.cpp" &&
        std::regex_search(lines[i], match, not_in_core)) {
      found.push_back(place + "not in the core: " + match[0].str());
    }
    if (std::regex_search(lines[i], match, nowhere)) {
      found.push_back(place + "differs between machines: " + match[0].str());
    }
  }
  return found;
}

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Floors, EverySourceKeepsTheRules) {
  const std::filesystem::path root = std::filesystem::path(QUOLL_SOURCE) / "quoll";
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string path = entry.path().lexically_relative(root).generic_string();
    if (!path.ends_with(".hpp") && !path.ends_with(".cpp")) continue;
    ++files;
    for (const auto& line : violations(path, read(entry.path()))) ADD_FAILURE() << "quoll/" << line;
  }
  EXPECT_GT(files, 20u);
}

// Two types of one name are one to the linker, whatever header a source took.
TEST(Floors, ATypeOfAHeaderHasANameOfItsOwn) {
  const std::filesystem::path root = std::filesystem::path(QUOLL_SOURCE) / "quoll";
  const std::regex head("^(?:struct|class) ([A-Z][A-Za-z0-9]*)(?: final)? ?(?::[^:]|\\{)");
  std::map<std::string, std::string> home;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".hpp") continue;
    const std::string path = std::filesystem::relative(entry.path(), root).generic_string();
    std::istringstream lines(read(entry.path()));
    for (std::string line; std::getline(lines, line);) {
      std::smatch found;
      if (!std::regex_search(line, found, head)) continue;
      const auto [first, fresh] = home.emplace(found[1].str(), path);
      EXPECT_TRUE(fresh) << found[1].str() << " stands in " << first->second << " and in " << path;
    }
  }
  EXPECT_GT(home.size(), 100u);
}

TEST(Floors, SourcesAreAtMost100ColumnsWideAndHoldNoOpenNotes) {
  const std::regex open_note(
      "TO"
      "DO|FIX"
      "ME|XX"
      "X");
  for (const char* top : {"quoll", "tests", "bench", "examples"}) {
    const auto root = std::filesystem::path(QUOLL_SOURCE) / top;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      const auto extension = entry.path().extension();
      if (extension != ".hpp" && extension != ".cpp") continue;
      std::istringstream lines(read(entry.path()));
      std::size_t number = 0;
      for (std::string line; std::getline(lines, line);) {
        ++number;
        // A character beyond ASCII counts once: its continuation bytes are 10xxxxxx.
        const auto width = std::count_if(line.begin(), line.end(),
                                         [](unsigned char byte) { return (byte & 0xC0) != 0x80; });
        const auto place =
            entry.path().lexically_relative(QUOLL_SOURCE).string() + ":" + std::to_string(number);
        EXPECT_LE(width, 100) << place;
        EXPECT_FALSE(std::regex_search(line, open_note)) << place;
      }
    }
  }
}

TEST(Floors, AViolationIsSeen) {
  const auto count = [](const char* path, const std::string& text) {
    return violations(path, text).size();
  };
  EXPECT_EQ(count("base/a.cpp", "#include \"quoll/model/mdp.hpp\"\n"), 1u);
  EXPECT_EQ(count("verify/a.cpp", "#include \"quoll/env/world.hpp\"\n"), 1u);
  EXPECT_EQ(count("solve/a.cpp", "#include \"quoll/verify/verify.hpp\"\n"), 1u);
  EXPECT_EQ(count("model/a.cpp", "#include \"mdp.hpp\"\n"), 1u);
  EXPECT_EQ(count("model/a.hpp", "#include <fmt/core.h>\n"), 1u);
  EXPECT_EQ(count("model/a.cpp", "  throw 1;\n"), 1u);
  EXPECT_EQ(count("model/a.cpp", "#include <iostream>\n"), 1u);
  EXPECT_EQ(count("report/a.cpp", "std::shuffle(a, b, c);\n"), 1u);
  EXPECT_EQ(count("manager/a.cpp", ""), 1u);
  std::string long_file;
  for (int i = 0; i < 401; ++i) long_file += "\n";
  EXPECT_EQ(count("model/a.cpp", long_file), 1u);
}

TEST(Floors, WhatIsAllowedPasses) {
  EXPECT_TRUE(violations("learn/a.cpp", "#include \"quoll/solve/solver.hpp\"\n").empty());
  EXPECT_TRUE(violations("learn/tabular/a.cpp", "#include \"quoll/learn/learner.hpp\"\n").empty());
  EXPECT_TRUE(violations("verify/a.cpp", "#include \"quoll/model/mdp.hpp\"\n").empty());
  EXPECT_TRUE(violations("model/a.cpp", "// never throw here\n\"throw\"\n").empty());
  EXPECT_TRUE(violations("base/raise.cpp", "throw 1;\n").empty());
  EXPECT_TRUE(violations("experiment/a.cpp", "throw 1;\n").empty());
  EXPECT_TRUE(violations("act/a.hpp", "#include <vector>\n#include <emmintrin.h>\n").empty());
}

}  // namespace
