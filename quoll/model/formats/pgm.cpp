#include <algorithm>
#include <optional>
#include <utility>

#include "quoll/model/formats/ros_map.hpp"

namespace quoll {
namespace {

bool blank(char letter) {
  return letter == ' ' || (letter >= '\t' && letter <= '\r');
}

class PgmReader {
 public:
  PgmReader(std::string_view content, const std::string& path) : text_(content), path_(path) {}

  Result<GrayImage> read() {
    const bool bytes = text_.starts_with("P5");
    if (!bytes && !text_.starts_with("P2")) return wrong("expected a PGM image (P2 or P5)");
    at_ = 2;
    GrayImage image;
    for (const auto& [number, name] : {std::pair{&image.width, "a width in pixels"},
                                       {&image.height, "a height in pixels"},
                                       {&image.white, "a white level from 1 to 65535"}}) {
      const auto value = number_at();
      if (!value || *value == 0) return wrong(std::string("expected ") + name);
      *number = *value;
    }
    if (image.white > 65535) return wrong("expected a white level from 1 to 65535");
    if (bytes) return read_bytes(std::move(image));
    return read_text(std::move(image));
  }

 private:
  Error wrong(std::string expected) const {
    std::uint64_t line = 1;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < at_ && i < text_.size(); ++i) {
      if (text_[i] != '\n') continue;
      ++line;
      begin = i + 1;
    }
    return {path_, line, at_ - begin + 1, std::move(expected), ""};
  }

  void skip_blanks() {
    while (at_ < text_.size() && (blank(text_[at_]) || text_[at_] == '#')) {
      if (text_[at_] == '#') at_ = std::min(text_.find('\n', at_), text_.size());
      if (at_ < text_.size()) ++at_;
    }
  }

  // The next number, of at most nine digits; the place stays at what is none.
  std::optional<std::uint32_t> number_at() {
    skip_blanks();
    std::uint32_t value = 0;
    std::size_t digits = 0;
    for (; at_ + digits < text_.size() && digits < 10; ++digits) {
      const char letter = text_[at_ + digits];
      if (letter < '0' || letter > '9') break;
      if (digits == 9) return std::nullopt;
      value = value * 10 + static_cast<std::uint32_t>(letter - '0');
    }
    if (digits == 0) return std::nullopt;
    at_ += digits;
    return value;
  }

  Error too_few(const GrayImage& image) const {
    return wrong("expected " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                 " pixels, found a file that ends before");
  }

  Result<GrayImage> read_bytes(GrayImage image) {
    if (at_ == text_.size() || !blank(text_[at_]))
      return wrong("expected a blank before the image");
    ++at_;
    const std::uint64_t pixels = std::uint64_t{image.width} * image.height;
    const std::uint64_t size = image.white > 255 ? 2 : 1;
    if (pixels > (text_.size() - at_) / size) return too_few(image);
    image.levels.reserve(pixels);
    for (std::uint64_t i = 0; i < pixels; ++i, at_ += size) {
      std::uint32_t level = static_cast<unsigned char>(text_[at_]);
      if (size == 2) level = level << 8U | static_cast<unsigned char>(text_[at_ + 1]);
      if (level > image.white) return too_bright(image);
      image.levels.push_back(static_cast<std::uint16_t>(level));
    }
    return ended(std::move(image));
  }

  Result<GrayImage> read_text(GrayImage image) {
    const std::uint64_t pixels = std::uint64_t{image.width} * image.height;
    // A level takes a digit and a blank before it.
    if (pixels > (text_.size() - at_) / 2) return too_few(image);
    image.levels.reserve(pixels);
    for (std::uint64_t i = 0; i < pixels; ++i) {
      const auto level = number_at();
      if (!level) return at_ == text_.size() ? too_few(image) : wrong("expected a level");
      if (*level > image.white) return too_bright(image);
      image.levels.push_back(static_cast<std::uint16_t>(*level));
    }
    return ended(std::move(image));
  }

  Error too_bright(const GrayImage& image) const {
    return wrong("expected a level up to " + std::to_string(image.white));
  }

  Result<GrayImage> ended(GrayImage image) {
    while (at_ < text_.size() && blank(text_[at_])) ++at_;
    if (at_ < text_.size()) {
      return wrong("expected " + std::to_string(image.width) + " x " +
                   std::to_string(image.height) + " pixels, found more");
    }
    return image;
  }

  std::string_view text_;
  const std::string& path_;
  std::size_t at_ = 0;
};

}  // namespace

Result<GrayImage> parse_pgm(std::string_view content, const std::string& path) {
  return PgmReader(content, path).read();
}

}  // namespace quoll
