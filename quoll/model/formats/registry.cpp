#include <array>
#include <utility>
#include <vector>

#include "quoll/base/file.hpp"
#include "quoll/base/text.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/letters.hpp"

namespace quoll {

namespace {

constexpr auto table = std::to_array<Format>({
    {"toml", ".toml", "named states and actions, written by hand", read_toml, write_toml, nullptr},
    {"csv", ".csv", "one outcome per row: state,action,next_state,probability,reward", read_csv,
     write_csv, read_csv_path},
    {"grid", ".txt", "a picture in letters: walls, start, goal, pits", read_grid, write_grid,
     nullptr},
    {"umb", ".umb", "arrays as they lie in memory: Unified Markov Binary, also compressed",
     read_umb, write_umb, read_umb_path},
    {"gymnasium", ".json",
     "env.P of a Gymnasium world: {state: {action: [[p, next, reward, done]]}}", read_gymnasium,
     write_gymnasium, nullptr},
    {"mdp", ".mdp", "Cassandra's text format, without observations", read_cassandra,
     write_cassandra_mdp, nullptr},
    {"pomdp", ".pomdp", "Cassandra's text format, read as if the state were seen", read_cassandra,
     write_cassandra_pomdp, nullptr},
    {"petsc", ".bin", "a matrix of PETSc, with --with rewards=FILE of another one", nullptr,
     nullptr, nullptr, read_petsc, petsc_parameters},
    {"moving-ai", ".map", "a map of the Moving AI benchmarks, with --with goal=x,y or scen=FILE",
     nullptr, nullptr, nullptr, read_moving_ai, moving_ai_parameters},
    {"ros-map", ".yaml", "an occupancy map of ROS, with --with goal=x,y in metres", nullptr,
     nullptr, nullptr, read_ros_map, ros_map_parameters},
    {"pgm", ".pgm", "the image of such a map alone, with --with goal=x,y in pixels", nullptr,
     nullptr, nullptr, read_pgm_map, ros_map_parameters},
    {"prism", ".tra",
     "transitions of PRISM and Storm, with .sta, .lab, .srew and .trew beside them", nullptr,
     nullptr, read_prism_path, read_prism, prism_parameters, write_prism},
    {"drn", ".drn", "states, actions, labels and rewards of Storm in one file", read_drn, write_drn,
     read_drn_path},
});

Error placed(Error error, const std::string& path) {
  if (error.file.empty()) error.file = path;
  return error;
}

template <class Named>
Names names_of(const std::vector<Named>& list) {
  Names names;
  for (const Named& one : list) names.push_back(one.name);
  return names;
}

Result<void> takes(const Format& format, const Parameters& given) {
  if (format.read_with != nullptr || given.empty()) return {};
  return Error{"--with", 0, 0,
               "a world from a " + std::string(format.extension) +
                   " file takes no parameters, not '" + given[0].first + "'",
               ""};
}

}  // namespace

std::span<const Format> formats() {
  return table;
}

Result<const Format*> format_of(const std::string& path) {
  for (const Format& format : table) {
    if (path.size() > format.extension.size() && path.ends_with(format.extension)) return &format;
  }
  Error error;
  error.file = path;
  error.expected = "expected a file name that ends in ";
  std::vector<std::string_view> extensions;
  for (const Format& format : table) {
    if (!extensions.empty()) error.expected += &format == &table.back() ? " or " : ", ";
    error.expected += format.extension;
    extensions.push_back(format.extension);
  }
  const std::size_t dot = path.rfind('.');
  if (dot != std::string::npos) {
    error.nearest = nearest(std::string_view(path).substr(dot), extensions);
  }
  return error;
}

Result<MdpArrays> read_model_arrays(const std::string& path, const Parameters& given) {
  const Result<const Format*> format = format_of(path);
  if (!format) return format.error();
  if (const Result<void> fitting = takes(**format, given); !fitting) return fitting.error();
  if ((*format)->read_path != nullptr) {
    Result<MdpArrays> arrays = (*format)->read_path(path, given);
    if (!arrays) return placed(arrays.error(), path);
    return arrays;
  }
  const Result<std::string> content = read_file(path);
  if (!content) return placed(content.error(), path);
  return parse_model_arrays(*content, path, given);
}

Result<MdpArrays> parse_model_arrays(std::string_view content, const std::string& path,
                                     const Parameters& given) {
  const Result<const Format*> format = format_of(path);
  if (!format) return format.error();
  if (const Result<void> fitting = takes(**format, given); !fitting) return fitting.error();
  Result<MdpArrays> arrays = (*format)->read_with != nullptr
                                 ? (*format)->read_with(content, path, given)
                                 : (*format)->read_arrays(content, path);
  if (!arrays) return placed(arrays.error(), path);
  return arrays;
}

Result<Mdp> read_model(const std::string& path, const Parameters& given) {
  Result<MdpArrays> arrays = read_model_arrays(path, given);
  if (!arrays) return arrays.error();
  Result<Mdp> mdp = Mdp::make(*std::move(arrays));
  if (!mdp) return placed(mdp.error(), path);
  return mdp;
}

Result<Mdp> parse_model(std::string_view content, const std::string& path,
                        const Parameters& given) {
  Result<MdpArrays> arrays = parse_model_arrays(content, path, given);
  if (!arrays) return arrays.error();
  Result<Mdp> mdp = Mdp::make(*std::move(arrays));
  if (!mdp) return placed(mdp.error(), path);
  return mdp;
}

Result<std::vector<WrittenFile>> write_model(const Mdp& mdp, const std::string& path) {
  const Result<const Format*> format = format_of(path);
  if (!format) return format.error();
  if ((*format)->write_files != nullptr) return (*format)->write_files(mdp, path);
  if ((*format)->write == nullptr) {
    return Error{path, 0, 0,
                 "expected a format that can be written, which " +
                     std::string((*format)->extension) + " is not",
                 ""};
  }
  Result<std::string> content = (*format)->write(mdp);
  if (!content) return placed(content.error(), path);
  return std::vector<WrittenFile>{{path, *std::move(content)}};
}

Result<void> quotable_names(const Mdp& mdp) {
  const MdpArrays& a = mdp.arrays();
  std::vector<std::string_view> names{a.reward_name};
  for (const Label& label : a.labels) names.push_back(label.name);
  for (const RewardStructure& other : a.other_rewards) names.push_back(other.name);
  for (const std::string_view name : names) {
    if (name.find('"') == std::string_view::npos) continue;
    return Error{
        "", 0, 0,
        "expected names of labels and rewards without quotation marks, found " + std::string(name),
        ""};
  }
  return {};
}

Result<void> one_player(const Mdp& mdp) {
  if (!mdp.alternating()) return {};
  return Error{"", 0, 0, "this format holds no model of two players", ""};
}

Result<void> proper_names(const Mdp& mdp) {
  const auto proper = [](const Names& names, const std::string& what) -> Result<void> {
    for (std::uint64_t i = 0; i < names.size(); ++i) {
      const std::string_view reason = name_fault(names[i]);
      if (reason.empty()) continue;
      return Error{"", 0, 0,
                   "name of " + what + " " + std::to_string(i) + ": " + std::string(reason), ""};
    }
    return {};
  };
  const Result<void> states = proper(mdp.arrays().state_names, "state");
  if (!states) return states;
  const Result<void> actions = proper(mdp.arrays().action_names, "action");
  if (!actions) return actions;
  const Result<void> labels = proper(names_of(mdp.arrays().labels), "label");
  return labels ? proper(names_of(mdp.arrays().other_rewards), "reward structure") : labels;
}

}  // namespace quoll
