// What a model of Quoll holds and the Unified Markov Binary format has no place for. Other programs
// may pass over it: parameters of the tool in index.json, and annotations of the group "quoll".

#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "quoll/base/bytes.hpp"
#include "quoll/model/formats/umb.hpp"

namespace quoll::umb {
namespace {

Error error(std::string expected) {
  return Error{"", 0, 0, std::move(expected), ""};
}

/// One number of eight bytes per state; nullptr = absent or of another length.
const std::string_view* words(const Files& files, std::string_view name, std::uint64_t states) {
  const std::string_view* const found = find(files, name);
  return found && found->size() == states * 8 ? found : nullptr;
}

Result<Layout> layout_of(const Tree& tree, const Files& files, const MdpArrays& arrays) {
  Own::Picture picture;
  if (const auto read = assign(picture, tree); !read) {
    return error("index.json: file-data.parameters.layout: " + read.error().expected);
  }
  const std::uint64_t states = arrays.choice_begin.size() - 1;
  const std::string_view* const cells = words(files, own_cells, states);
  const std::uint64_t most = std::uint64_t{picture.rows} * picture.columns;
  if (!cells || most > UINT32_MAX || picture.right.size() != arrays.action_names.size() ||
      picture.down.size() != picture.right.size()) {
    return error("index.json: file-data.parameters.layout: a cell per state and a direction per " +
                 std::string("action expected"));
  }
  Layout layout;
  layout.rows = picture.rows;
  layout.columns = picture.columns;
  for (std::uint64_t s = 0; s < states; ++s) {
    const auto cell = load_little<std::uint64_t>(cells->data() + 8 * s);
    if (cell >= most) return error(std::string(own_cells) + ": cells of the layout expected");
    layout.cell.push_back(static_cast<std::uint32_t>(cell));
  }
  for (std::size_t i = 0; i < picture.right.size(); ++i) {
    layout.direction.emplace_back(picture.right[i], picture.down[i]);
  }
  if (!picture.frame.empty()) {
    if (picture.frame.size() != 4) return error("index.json: layout.frame: 4 numbers expected");
    layout.frame = {picture.frame[0], picture.frame[1], picture.frame[2], picture.frame[3]};
  }
  return layout;
}

}  // namespace

Result<void> read_own(const Tree& parameters, const Files& files, MdpArrays& arrays) {
  const std::uint64_t states = arrays.choice_begin.size() - 1;
  const Tree* const layout = parameters.find("layout");
  Tree flat = parameters;
  if (layout) {
    auto read = layout_of(*layout, files, arrays);
    if (!read) return read.error();
    arrays.layout = *std::move(read);
    std::erase_if(std::get<Tree::Object>(flat.value),
                  [](const auto& member) { return member.first == "layout"; });
  }
  Own own;
  if (const auto read = assign(own, flat); !read) {
    return error("index.json: file-data.parameters: " + read.error().expected);
  }
  arrays.discount = own.discount;
  arrays.alternating = own.alternating;
  if (own.names == "cells" && arrays.layout) {
    arrays.state_names = Names::cells(arrays.layout->columns, arrays.layout->cell);
  } else if (own.names == "numbered") {
    arrays.state_names = Names::numbered(own.prefix, states);
  }
  if (const std::string_view* const ends = find(files, own_ends)) {
    auto list = set_bits(*ends, states);
    if (!list) return error(std::string(own_ends) + ": " + list.error().expected);
    arrays.terminal = *std::move(list);
  }
  if (!find(files, own_starts)) return {};
  const std::string_view* const starts = words(files, own_starts, states);
  if (!starts) return error(std::string(own_starts) + ": a number per state expected");
  for (const State s : arrays.start) {
    arrays.start_probability.push_back(
        std::bit_cast<double>(load_little<std::uint64_t>(starts->data() + 8 * std::size_t{s})));
  }
  return {};
}

}  // namespace quoll::umb
