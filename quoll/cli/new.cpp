// quoll new KIND: a world file to begin with.

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cctype>

#include "quoll/base/file.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/model/maze.hpp"
#include "quoll/model/templates.hpp"

namespace quoll::cli {
namespace {

struct NewOptions {
  std::string kind, name;
  std::vector<std::string> with;
  std::string file;
  bool force = false;
};

Result<std::string> maze_text(const Parameters& with, const std::string&) {
  MazeSettings settings;
  const std::vector<Setting> known = settings_of(settings);
  for (const auto& [key, text] : with) {
    const Setting* setting = find(known, key);
    if (!setting) {
      Nearest nearest(key);
      for (const Setting& one : known) nearest.offer(one.name);
      return Error{"--with", 0, 0, "a maze has size, seed and braid, not '" + key + "'",
                   nearest.best()};
    }
    const Result<void> assigned = assign(*setting, text, "--with " + key);
    if (!assigned) return assigned.error();
  }
  return to_text(make_maze(settings));
}

Result<std::string> fixed_text(std::string_view text, std::string_view kind,
                               const Parameters& with) {
  if (with.empty()) return std::string(text);
  return Error{"--with", 0, 0,
               "a " + std::string(kind) + " takes no parameters, not '" + with[0].first + "'", ""};
}

/// A name that can be part of a C++ name and of a file's.
Result<std::string> world_text(const Parameters& with, const std::string& name) {
  bool fits = !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) != 0;
  for (const char letter : name) {
    fits = fits && (std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '-');
  }
  if (!fits) {
    return Error{
        "new world", 0, 0,
        "a name of letters, digits and '-' expected, beginning with a letter, not '" + name + "'",
        ""};
  }
  return fixed_text(world_template(name), "world", with);
}

struct Kind {
  std::string_view name;
  std::string_view extension;
  Result<std::string> (*make)(const Parameters& with, const std::string& name);
};

constexpr std::array<Kind, 4> kinds{{
    {"maze", ".txt", maze_text},
    {"template", ".toml",
     [](const Parameters& with, const std::string&) {
       return fixed_text(toml_template(), "template", with);
     }},
    {"csv-template", ".csv",
     [](const Parameters& with, const std::string&) {
       return fixed_text(csv_template(), "csv-template", with);
     }},
    {"world", ".cpp", world_text},
}};

Result<const Kind*> find_kind(const std::string& name) {
  Nearest nearest(name);
  for (const Kind& kind : kinds) {
    if (kind.name == name) return &kind;
    nearest.offer(kind.name);
  }
  return Error{"new", 0, 0, "maze, template, csv-template or world expected, not '" + name + "'",
               nearest.best()};
}

/// A file that could not be read as what it is, or that would replace another.
Result<void> may_write(const NewOptions& options, const Kind& kind) {
  const std::string& file = options.file;
  if (!file.ends_with(kind.extension) || file.size() == kind.extension.size()) {
    return Error{"-o", 0, 0,
                 fmt::format("a name that ends in {} expected for a {}, not '{}'", kind.extension,
                             kind.name, file),
                 ""};
  }
  if (!options.force && access(file.c_str(), F_OK) == 0) {
    return Error{file, 0, 0, "exists already; --force replaces it", ""};
  }
  return {};
}

Exit make_new(const NewOptions& options) {
  const Result<const Kind*> kind = find_kind(options.kind);
  if (!kind) return fail(kind.error());
  WorldOption world;
  world.with = options.with;
  const Result<WorldSource> source = world.source();
  if (!source) return fail(source.error());
  if (!options.file.empty()) {
    const Result<void> may = may_write(options, **kind);
    if (!may) return fail(may.error());
  }
  if (!options.name.empty() && (*kind)->name != "world") {
    return fail({"new", 0, 0, "only a world takes a name; a file is given by -o", ""});
  }
  const Result<std::string> text = (*kind)->make(source->parameters, options.name);
  if (!text) return fail(text.error());
  if (options.file.empty()) return print(*text) ? done : user_error;
  const Result<void> written = write_file(options.file, *text);
  if (!written) return fail(written.error());
  if ((*kind)->name == "world") {
    return print("wrote " + options.file + "; its first lines say how to build it\n") ? done
                                                                                      : user_error;
  }
  return print(fmt::format("wrote {0}\nNext: quoll check {0} | quoll solve {0} | quoll learn {0}\n",
                           options.file))
             ? done
             : user_error;
}

}  // namespace

void declare_new(Options& options) {
  auto given = std::make_shared<NewOptions>();
  options.word("kind", given->kind, "maze, template, csv-template or world");
  options.word("name", given->name, "of a world: what it and its struct are called", false);
  MazeSettings maze;
  std::string keys;
  for (const Setting& setting : settings_of(maze)) {
    keys += fmt::format("{}{} [{}]", keys.empty() ? "" : ", ", setting.name, text_of(setting));
  }
  options.option("--with", &given->with, "KEY=VALUE",
                 "a parameter, may be repeated; of a maze: " + keys);
  options.option("-o,--output", &given->file, "FILE", "the file to write; without: on stdout");
  options.flag("--force", &given->force, "replace a file that exists");
  options.run([given] { return make_new(*given); });
}

}  // namespace quoll::cli
