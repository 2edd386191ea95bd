#include "quoll/report/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "quoll/base/utf8.hpp"

namespace quoll {

namespace {

constexpr double ascent = 0.80;  // of the font size: capitals and digits reach 0.73
constexpr double descent = 0.24;

double letter_width(const CodePoint& point) {
  if (point.value >= 0x80) {
    std::string bytes;
    encode(point.value, bytes);
    return 0.86 * static_cast<double>(display_width(bytes));
  }
  const char c = static_cast<char>(point.value);
  if (std::string_view("ijl|.,:;'! I").find(c) != std::string_view::npos) return 0.40;
  if (std::string_view("frt()[]-/\"").find(c) != std::string_view::npos) return 0.47;
  if (std::string_view("mMWw@%").find(c) != std::string_view::npos) return 1.0;
  if (std::string_view("+<=>~#_").find(c) != std::string_view::npos) return 0.84;
  return c >= 'A' && c <= 'Z' ? 0.78 : 0.64;
}

struct Rgb {
  int red, green, blue;
};

// ColorBrewer YlGnBu, nine classes, the first seven.
constexpr std::array<Rgb, 7> stops{{{255, 255, 217},
                                    {237, 248, 177},
                                    {199, 233, 180},
                                    {127, 205, 187},
                                    {65, 182, 196},
                                    {29, 145, 192},
                                    {34, 94, 168}}};

Rgb color_at(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double part = place - static_cast<double>(i);
  const auto mix = [part](int a, int b) { return static_cast<int>(a + (b - a) * part + 0.5); };
  return {mix(stops[i].red, stops[i + 1].red), mix(stops[i].green, stops[i + 1].green),
          mix(stops[i].blue, stops[i + 1].blue)};
}

}  // namespace

bool Box::overlaps(const Box& other, double gap) const {
  return x < other.right() + gap && other.x < right() + gap && y < other.bottom() + gap &&
         other.y < bottom() + gap;
}

bool Box::contains(const Box& inner) const {
  return inner.x >= x && inner.y >= y && inner.right() <= right() && inner.bottom() <= bottom();
}

std::string xml_escape(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const CodePoint point = decode(text);
    switch (point.value) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        // XML 1.0, section 2.2: no controls, and neither U+FFFE nor U+FFFF.
        if (point.value < 0x20 || point.value == 0x7F) {
          out += ' ';
        } else {
          encode(point.value == 0xFFFE || point.value == 0xFFFF ? 0xFFFD : point.value, out);
        }
    }
    text.remove_prefix(point.length);
  }
  return out;
}

double text_width(std::string_view text, double size, bool bold) {
  double width = 0;
  while (!text.empty()) {
    const CodePoint point = decode(text);
    width += letter_width(point);
    text.remove_prefix(point.length);
  }
  return width * size * (bold ? 1.1 : 1.0);
}

std::string label_number(double value) {
  const double size = value < 0 ? -value : value;
  std::string text =
      size >= 1000 && size < 1e6 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
  return text == "-0" ? "0" : text;
}

std::string svg_number(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

void SvgWriter::rect(const Box& box, double radius, std::string_view attributes) {
  body_ += fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}")", svg_number(box.x),
                       svg_number(box.y), svg_number(box.width), svg_number(box.height));
  if (radius > 0) body_ += fmt::format(R"( rx="{}")", svg_number(radius));
  body_ += fmt::format(" {}/>\n", attributes);
}

void SvgWriter::line(double x1, double y1, double x2, double y2, std::string_view attributes) {
  body_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" {}/>\n", svg_number(x1),
                       svg_number(y1), svg_number(x2), svg_number(y2), attributes);
}

void SvgWriter::path(std::string_view data, std::string_view attributes) {
  body_ += fmt::format("<path d=\"{}\" {}/>\n", data, attributes);
}

void SvgWriter::circle(double x, double y, double radius, std::string_view attributes) {
  body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {}/>\n", svg_number(x), svg_number(y),
                       svg_number(radius), attributes);
}

Box text_box(double x, double baseline, std::string_view text, const TextStyle& style) {
  const double width = text_width(text, style.size, style.bold);
  const double left = style.anchor == "start" ? x
                      : style.anchor == "end" ? x - width
                                              : x - width / 2;
  return {left, baseline - ascent * style.size, width, (ascent + descent) * style.size};
}

void SvgWriter::text(double x, double baseline, std::string_view text, const TextStyle& style) {
  body_ += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\"", svg_number(x),
                       svg_number(baseline), svg_number(style.size), style.color);
  if (style.bold) body_ += " font-weight=\"bold\"";
  if (style.anchor != "start") body_ += fmt::format(" text-anchor=\"{}\"", style.anchor);
  body_ += fmt::format(">{}</text>\n", xml_escape(text));
  labels_.push_back({std::string(text), text_box(x, baseline, text, style)});
}

Picture SvgWriter::finish(double width, double height, std::string_view title) const {
  Picture picture;
  picture.width = width;
  picture.height = height;
  picture.labels = labels_;
  picture.svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\">\n<title>{2}</title>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n{3}</svg>\n",
      svg_number(width), svg_number(height), xml_escape(title), body_);
  return picture;
}

std::string scale_color(double share) {
  const Rgb c = color_at(share);
  return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue);
}

bool scale_is_light(double share) {
  const Rgb c = color_at(share);
  return 0.299 * c.red + 0.587 * c.green + 0.114 * c.blue > 140;  // luma, ITU-R BT.601
}

}  // namespace quoll
