// Which files make one model.

#include <dirent.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/prism.hpp"

namespace quoll {
namespace {

using Kind = PrismPart::Kind;

struct PrismSettings {
  std::string states, labels, rewards;

  void describe(Describer& d) {
    d("states", states, "a file of states (.sta); without it the one beside the transitions");
    d("labels", labels, "a file of labels (.lab); without it the one beside the transitions");
    d("rewards", rewards, "files of rewards, between commas; without it those beside");
  }
};

struct Ending {
  std::string_view text;
  Kind kind;
};
constexpr std::array<Ending, 8> endings{{{".sta", Kind::states},
                                         {".lab", Kind::labels},
                                         {".state.rew", Kind::rewards},
                                         {".trans.rew", Kind::rewards},
                                         {".srew", Kind::rewards},
                                         {".trew", Kind::rewards},
                                         {".rews", Kind::rewards},
                                         {".rewt", Kind::rewards}}};

struct Found {
  Kind kind;
  std::string path, name;
};

std::string_view file_name(std::string_view path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string_view::npos ? path : path.substr(slash + 1);
}

std::string_view without_ending(std::string_view name, std::string_view ending) {
  return name.ends_with(ending) ? name.substr(0, name.size() - ending.size()) : name;
}

bool is_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

// What a file of rewards is called behind the model's own name: "time" of model.time.srew,
// model_time.srew, model-time.srew, "2" of model2.srew; nothing if it belongs to another model.
std::optional<std::string_view> middle_name(std::string_view middle) {
  if (middle.empty() || is_number(middle)) return middle;
  if (middle.size() < 2 || std::string_view("._-").find(middle.front()) == std::string_view::npos) {
    return std::nullopt;
  }
  return middle.substr(1);
}

bool exists(const std::string& path) {
  struct stat status = {};
  return stat(path.c_str(), &status) == 0;
}

std::vector<std::string> files_in(const std::string& folder) {
  struct Close {
    void operator()(DIR* list) const { closedir(list); }
  };
  const std::unique_ptr<DIR, Close> list(opendir(folder.empty() ? "." : folder.c_str()));
  std::vector<std::string> names;
  while (list) {
    const dirent* const entry = readdir(list.get());
    if (entry == nullptr) break;
    names.emplace_back(entry->d_name);
  }
  // model2 before model10.
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return std::pair(a.size(), std::string_view(a)) < std::pair(b.size(), std::string_view(b));
  });
  return names;
}

// The files in the folder that are called like the transitions.
std::vector<Found> beside(const std::string& path) {
  const std::string folder = path.substr(0, path.size() - file_name(path).size());
  const std::string stem(without_ending(file_name(path), ".tra"));
  std::vector<Found> found;
  for (const std::string& name : files_in(folder)) {
    if (!name.starts_with(stem)) continue;
    for (const Ending& ending : endings) {
      if (!name.ends_with(ending.text) || name.size() < stem.size() + ending.text.size()) continue;
      const std::string_view middle = std::string_view(name).substr(
          stem.size(), name.size() - stem.size() - ending.text.size());
      const auto called = middle_name(middle);
      const bool whole = middle.empty();
      if (!called || (!whole && ending.kind != Kind::rewards)) break;
      // model_b.srew is of model_b.tra, if there is one.
      if (!whole && exists(folder + stem + std::string(middle) + ".tra")) break;
      found.push_back({ending.kind, folder + name, std::string(*called)});
      break;
    }
  }
  return found;
}

// The name of rewards in a file that was given.
std::string given_rewards_name(std::string_view file, const std::string& path) {
  std::string_view name = file_name(file);
  for (const Ending& ending : endings) {
    if (ending.kind == Kind::rewards && name.ends_with(ending.text)) {
      name = without_ending(name, ending.text);
      break;
    }
  }
  const std::string_view stem = without_ending(file_name(path), ".tra");
  if (!name.starts_with(stem)) return std::string(name);
  return std::string(middle_name(name.substr(stem.size())).value_or(name));
}

}  // namespace

Result<std::vector<PrismPart>> prism_parts(const std::string& path, const Parameters& given,
                                           bool look_beside) {
  const Result<PrismSettings> settings = read_parameters<PrismSettings>(path, given);
  if (!settings) return settings.error();
  std::vector<Found> found;
  if (look_beside) found = beside(path);
  const auto replace = [&](Kind kind, const std::string& files) {
    if (files.empty()) return;
    std::erase_if(found, [&](const Found& one) { return one.kind == kind; });
    for (const std::string_view file : split(files, ',')) {
      found.push_back({kind, std::string(file), given_rewards_name(file, path)});
    }
  };
  replace(Kind::states, settings->states);
  replace(Kind::labels, settings->labels);
  replace(Kind::rewards, settings->rewards);
  // Names of states are wanted for what the others say.
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return a.kind < b.kind; });
  std::vector<PrismPart> parts;
  for (Found& one : found) {
    Result<Lines> lines = Lines::open(one.path);
    if (!lines) return lines.error();
    parts.push_back({one.kind, std::move(one.path), std::move(one.name), *std::move(lines)});
  }
  return parts;
}

Result<void> no_strangers_beside(const std::string& path, const std::vector<WrittenFile>& files) {
  for (const Found& one : beside(path)) {
    const bool ours = std::any_of(files.begin(), files.end(),
                                  [&](const WrittenFile& file) { return file.path == one.path; });
    if (ours) continue;
    return Error{one.path, 0, 0, "exists already and would be read as part of " + path, ""};
  }
  return {};
}

std::vector<ParameterText> prism_parameters() {
  return parameters_of<PrismSettings>();
}

}  // namespace quoll
