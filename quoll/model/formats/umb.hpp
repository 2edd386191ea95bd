#pragma once
// Parts of the Unified Markov Binary format (github.com/pmc-tools/umb, spec.md, version 1.0) that
// several sources share: a tar archive of arrays, named and counted by its index.json.

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/base/tree.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll::umb {

/// The files of an archive by name; the views lead into it.
using Files = std::map<std::string, std::string_view, std::less<>>;

/// The content of a file; nullptr = absent, which means a default.
const std::string_view* find(const Files& files, std::string_view name);

/// The value at a path of keys, or nullptr.
const Tree* at(const Tree& tree, std::initializer_list<std::string_view> keys);

/// A type of values as index.json writes it.
struct Type {
  std::string name;        ///< "double", "uint", ...
  std::uint64_t bits = 0;  ///< of one value
};
/// Errors say what is wrong with it.
Result<Type> type_of(const Tree* tree);

/// The names of the states that their valuations give: "(x=2,b=true)", or the text alone where a
/// text is all there is. Errors say why they cannot serve as names.
Result<Names> state_names(const Tree& description, const Files& files, std::uint64_t states);

/// The strings of a folder as names of `count` things. Errors say what does not fit.
Result<Names> strings(const Files& files, const std::string& folder, std::uint64_t count);

/// A file of exactly so many bytes; nullptr = absent.
Result<const std::string_view*> file_of(const Files& files, const std::string& name,
                                        std::uint64_t bytes);

/// `from` + 1 offsets that ascend from 0 to `to`. Absent, and empty, means from == to.
Result<std::vector<std::uint64_t>> offsets(const Files& files, const std::string& name,
                                           std::uint64_t from, std::uint64_t to);

/// Appends doubles, or fractions of 64-bit integers (both parts rounded to double), to a vector or
/// Column; nothing if the file is absent.
template <class List>
Result<void> numbers(const Files& files, const std::string& name, const Type& type,
                     std::uint64_t count, List& list);

/// The indices below `states` whose bits are set, as annotations of type bool keep them.
Result<std::vector<State>> set_bits(std::string_view file, std::uint64_t states);

/// What only Quoll writes, as parameters of the tool. persist() also gives the names of the fields
/// in index.json.
struct Own {
  /// A Layout; its cells are an annotation.
  struct Picture {
    std::uint32_t rows = 0, columns = 0;
    std::vector<std::int32_t> right, down;  ///< per action
    std::vector<double> frame;              ///< side, x, y, yaw; or empty
    template <class Archive>
    void persist(Archive& archive) {
      archive("rows", rows);
      archive("columns", columns);
      archive("right", right);
      archive("down", down);
      archive("frame", frame);
    }
  };
  double discount = 1.0;
  bool alternating = false;
  std::string names;   ///< of states: "numbered", "cells" of the layout, or "stored"
  std::string prefix;  ///< of numbered ones
  template <class Archive>
  void persist(Archive& archive) {
    archive("discount", discount);
    archive("alternating", alternating);
    archive("names", names);
    archive("prefix", prefix);
  }
};
/// The files of its annotations: declared ends, start probabilities, cells of the layout.
inline constexpr std::string_view own_ends = "annotations/quoll/terminal/states/values.bin";
inline constexpr std::string_view own_starts = "annotations/quoll/start/states/values.bin";
inline constexpr std::string_view own_cells = "annotations/quoll/cell/states/values.bin";

/// Discount, turns, layout, names by rule, ends and start probabilities.
Result<void> read_own(const Tree& parameters, const Files& files, MdpArrays& arrays);

}  // namespace quoll::umb
