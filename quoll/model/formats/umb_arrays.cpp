// The arrays of a Unified Markov Binary file, each checked against its length before anything of
// that size is allocated.

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "quoll/base/bytes.hpp"
#include "quoll/base/text.hpp"
#include "quoll/model/formats/umb.hpp"

namespace quoll::umb {
namespace {

Error error(std::string expected) {
  return Error{"", 0, 0, std::move(expected), ""};
}

}  // namespace

Result<const std::string_view*> file_of(const Files& files, const std::string& name,
                                        std::uint64_t bytes) {
  const std::string_view* const found = find(files, name);
  if (found && found->size() != bytes) {
    return error(name + ": " + std::to_string(bytes) + " bytes expected, found " +
                 std::to_string(found->size()));
  }
  return found;
}

Result<std::vector<std::uint64_t>> offsets(const Files& files, const std::string& name,
                                           std::uint64_t from, std::uint64_t to) {
  const auto file = file_of(files, name, (from + 1) * 8);
  if (!file) return file.error();
  std::vector<std::uint64_t> list;
  if (!*file) {
    if (from == to) return list;
    return error(name + ": missing, although " + std::to_string(from) + " and " +
                 std::to_string(to) + " differ");
  }
  list.resize(from + 1);
  std::uint64_t before = 0;
  bool ascending = true;
  for (std::uint64_t i = 0; i <= from; ++i) {
    list[i] = load_little<std::uint64_t>((*file)->data() + 8 * i);
    ascending = ascending && list[i] >= before;
    before = list[i];
  }
  if (ascending && list.front() == 0 && before == to) return list;
  return error(name + ": numbers that ascend from 0 to " + std::to_string(to) + " expected");
}

template <class List>
Result<void> numbers(const Files& files, const std::string& name, const Type& type,
                     std::uint64_t count, List& list) {
  const bool rational = type.name == "rational" && type.bits == 128;
  if (!rational && (type.name != "double" || type.bits != 64)) {
    return error(name + ": type double, or rational of 128 bits, expected, found " + type.name +
                 " of " + std::to_string(type.bits));
  }
  const auto file = file_of(files, name, count * type.bits / 8);
  if (!file) return file.error();
  if (!*file) return {};
  list.reserve(count);
  const char* const bytes = (*file)->data();
  if (!rational) {
    for (std::uint64_t i = 0; i < count; ++i) {
      list.push_back(std::bit_cast<double>(load_little<std::uint64_t>(bytes + 8 * i)));
    }
    return {};
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto over = load_little<std::uint64_t>(bytes + 16 * i);
    const auto under = load_little<std::uint64_t>(bytes + 16 * i + 8);
    if (under == 0) return error(name + ": fraction " + std::to_string(i) + " over 0");
    list.push_back(static_cast<double>(static_cast<std::int64_t>(over)) /
                   static_cast<double>(under));
  }
  return {};
}

template Result<void> numbers(const Files&, const std::string&, const Type&, std::uint64_t,
                              std::vector<double>&);
template Result<void> numbers(const Files&, const std::string&, const Type&, std::uint64_t,
                              Column&);

Result<std::vector<State>> set_bits(std::string_view file, std::uint64_t states) {
  if (file.size() != (states + 63) / 64 * 8) {
    return error(std::to_string((states + 63) / 64 * 8) + " bytes expected, found " +
                 std::to_string(file.size()));
  }
  std::vector<State> list;
  for (std::uint64_t word = 0; word * 8 < file.size(); ++word) {
    auto rest = load_little<std::uint64_t>(file.data() + 8 * word);
    for (; rest != 0; rest &= rest - 1) {
      const std::uint64_t state = 64 * word + static_cast<unsigned>(std::countr_zero(rest));
      if (state >= states) return error("zeros expected behind the last state's bit");
      list.push_back(static_cast<State>(state));
    }
  }
  return list;
}

Result<Names> strings(const Files& files, const std::string& folder, std::uint64_t count) {
  const std::string_view* const mapping = find(files, folder + "string-mapping.bin");
  const std::string_view* const text = find(files, folder + "strings.bin");
  if (!mapping || !text || mapping->size() / 8 != count + 1 || mapping->size() % 8 != 0) {
    return error(folder + "string-mapping.bin: " + counted(count, "string") + " expected");
  }
  std::vector<std::uint64_t> offsets(count + 1);
  bool ascending = true;
  for (std::uint64_t i = 0; i <= count; ++i) {
    offsets[i] = load_little<std::uint64_t>(mapping->data() + 8 * i);
    ascending = ascending && offsets[i] >= (i == 0 ? 0 : offsets[i - 1]);
  }
  if (!ascending || offsets.front() != 0 || offsets.back() != text->size()) {
    return error(folder + "string-mapping.bin: numbers that ascend from 0 to the size of " +
                 "strings.bin expected");
  }
  return Names::stored(std::string(*text), std::move(offsets));
}

}  // namespace quoll::umb
