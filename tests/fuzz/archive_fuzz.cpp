// Loading must answer any bytes with values or one Error: the fields of an archive, which no
// checksum protects here, and the container of a run file. What loads whole is saved as the same
// bytes.

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "quoll/base/archive.hpp"
#include "quoll/base/file.hpp"
#include "quoll/base/random.hpp"

namespace {

// A field of each type an archive knows.
struct Inner {
  std::uint16_t small = 0;
  std::vector<float> values;
  template <class Archive>
  void persist(Archive& archive) {
    archive("small", small);
    archive("values", values);
  }
};
struct Outer {
  bool flag = false;
  std::int8_t byte = 0;
  std::uint64_t steps = 0;
  double step_size = 0;
  std::string name;
  quoll::Rng dice;
  std::vector<std::uint32_t> visits;
  std::vector<std::string> names;
  std::vector<Inner> inner;
  template <class Archive>
  void persist(Archive& archive) {
    archive("flag", flag);
    archive("byte", byte);
    archive("steps", steps);
    archive("step_size", step_size);
    archive("name", name);
    archive("dice", dice);
    archive("visits", visits);
    archive("names", names);
    archive("inner", inner);
  }
};

void load_fields(std::span<const std::byte> bytes) {
  quoll::Archive in(bytes);
  Outer outer;
  in("outer", outer);
  if (!in.good()) {
    if (in.error().expected.empty()) std::abort();
    return;
  }
  if (!in.at_end()) return;
  quoll::Archive out;
  out("outer", outer);
  const std::vector<std::byte>& saved = out.bytes();
  if (!std::equal(saved.begin(), saved.end(), bytes.begin(), bytes.end())) std::abort();
}

void load_container(std::span<const std::byte> bytes) {
  static const std::string path =
      (std::filesystem::temp_directory_path() / ("quoll_fuzz_" + std::to_string(getpid())))
          .string();
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  const auto content = quoll::load_archive(path, "run");
  if (content) load_fields(*content);
  std::filesystem::remove(path);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  if (size > 0 && data[0] == 'Q') {
    load_container(bytes);
  } else {
    load_fields(bytes);
  }
  return 0;
}
