#include "quoll/base/compression.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>

#if defined(QUOLL_ZLIB)
#include <zlib.h>
#endif
#if defined(QUOLL_LZMA)
#include <lzma.h>
#endif

namespace quoll {
namespace {

using namespace std::string_view_literals;
constexpr std::string_view gzip = "\x1f\x8b\x08"sv;
constexpr std::string_view xz =
    "\xfd"
    "7zXZ\0"sv;

// The next piece of the content is written behind what is there; the string keeps its size.
[[maybe_unused]] constexpr std::size_t piece = std::size_t{1} << 20;

[[maybe_unused]] Error refused(const std::string& path, std::string expected) {
  return Error{path, 0, 0, std::move(expected), ""};
}

// Makes room for one more piece. Without exceptions a failed allocation ends the program, so it is
// tried first.
[[maybe_unused]] bool grow(std::string& content) {
  const std::size_t wanted = content.size() + piece;
  if (wanted > content.capacity()) {
    const std::size_t doubled = std::max(wanted, 2 * content.capacity());
    void* volatile memory = std::malloc(doubled);
    std::free(memory);
    if (memory == nullptr) return false;
    content.reserve(doubled);
  }
  content.resize(wanted);
  return true;
}

#if defined(QUOLL_ZLIB)
Result<std::string> gunzip(std::string_view bytes, const std::string& path) {
  z_stream stream{};
  if (inflateInit2(&stream, 16 + MAX_WBITS) != Z_OK) return refused(path, "not enough memory");
  std::string content;
  std::size_t done = 0;
  std::size_t given = 0;
  int state = Z_OK;
  bool room = true;
  bool members = true;
  while (members && room) {
    do {
      if (done == content.size() && !(room = grow(content))) break;
      if (stream.avail_in == 0) {
        const std::size_t next = std::min<std::size_t>(bytes.size() - given, piece);
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + given));
        stream.avail_in = static_cast<uInt>(next);
        given += next;
      }
      const std::size_t left = content.size() - done;
      stream.next_out = reinterpret_cast<Bytef*>(content.data() + done);
      stream.avail_out = static_cast<uInt>(left);
      state = inflate(&stream, Z_NO_FLUSH);
      done += left - stream.avail_out;
    } while (state == Z_OK &&
             (given < bytes.size() || stream.avail_in > 0 || stream.avail_out == 0));
    // A file may hold several members, one after the other.
    const std::size_t at = given - stream.avail_in;
    members = state == Z_STREAM_END && bytes.substr(at).starts_with(gzip);
    if (members) inflateReset(&stream);
  }
  inflateEnd(&stream);
  if (!room) return refused(path, "too large for the memory once decompressed");
  if (state != Z_STREAM_END) return refused(path, "cut or damaged gzip bytes");
  content.resize(done);
  return content;
}
#endif

#if defined(QUOLL_LZMA)
Result<std::string> unxz(std::string_view bytes, const std::string& path) {
  constexpr std::uint64_t most_memory = std::uint64_t{1} << 28;
  lzma_stream stream = LZMA_STREAM_INIT;
  if (lzma_stream_decoder(&stream, most_memory, LZMA_CONCATENATED) != LZMA_OK) {
    return refused(path, "not enough memory");
  }
  stream.next_in = reinterpret_cast<const std::uint8_t*>(bytes.data());
  stream.avail_in = bytes.size();
  std::string content;
  std::size_t done = 0;
  lzma_ret state = LZMA_OK;
  bool room = true;
  while (state == LZMA_OK) {
    if (done == content.size() && !(room = grow(content))) break;
    const std::size_t left = content.size() - done;
    stream.next_out = reinterpret_cast<std::uint8_t*>(content.data() + done);
    stream.avail_out = left;
    state = lzma_code(&stream, LZMA_FINISH);
    done += left - stream.avail_out;
  }
  lzma_end(&stream);
  if (!room) return refused(path, "too large for the memory once decompressed");
  if (state != LZMA_STREAM_END) return refused(path, "cut or damaged xz bytes");
  content.resize(done);
  return content;
}
#endif

}  // namespace

bool is_compressed(std::string_view bytes) {
  return bytes.starts_with(gzip) || bytes.starts_with(xz);
}

Result<std::string> decompress([[maybe_unused]] std::string_view bytes, const std::string& path) {
  const bool is_gzip = bytes.starts_with(gzip);
#if defined(QUOLL_ZLIB)
  if (is_gzip) return gunzip(bytes, path);
#endif
#if defined(QUOLL_LZMA)
  if (!is_gzip) return unxz(bytes, path);
#endif
  return Error{path, 0, 0,
               std::string("compressed, and this build reads no ") + (is_gzip ? "gzip" : "xz") +
                   "; decompress it first: " + (is_gzip ? "gunzip" : "unxz") + " -c FILE >OTHER",
               ""};
}

}  // namespace quoll
