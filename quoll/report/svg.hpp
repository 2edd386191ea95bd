#pragma once
// A small writer of SVG pictures, and what every picture hands back.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace quoll {

/// A rectangle: left, top, width, height, in pixels; y grows downwards.
struct Box {
  double x = 0, y = 0, width = 0, height = 0;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
  bool overlaps(const Box& other, double gap = 0) const;
  bool contains(const Box& inner) const;
};

/// A text in a picture and the place reserved for it.
struct SvgLabel {
  std::string text;
  Box box;
};

/// A finished picture. No two labels' boxes overlap, and all lie inside the canvas.
struct Picture {
  std::string svg;               ///< a complete file
  double width = 0, height = 0;  ///< of the canvas
  std::vector<SvgLabel> labels;
  std::vector<Box> nodes;  ///< boxes of states that no arrow's label may touch (graphs only)
};

/// Text for element content and attributes: & < > " ' escaped, valid UTF-8, no control characters.
std::string xml_escape(std::string_view text);

/// Width of `text` from above: classes of letters as wide as in DejaVu Sans, the widest usual font.
/// bold).
double text_width(std::string_view text, double size, bool bold = false);

struct TextStyle {
  double size = 14;
  std::string_view color = "#1f2933";
  bool bold = false;
  std::string_view anchor = "middle";  ///< start, middle or end
};

/// The place of a text whose anchor stands at (x, baseline).
Box text_box(double x, double baseline, std::string_view text, const TextStyle& style);

/// Colours shared by all pictures; Okabe and Ito, Color Universal Design, 2008, on a grey text.
namespace palette {
inline constexpr std::string_view ink = "#1f2933", grey = "#6b7682", pale = "#d9dee4";
inline constexpr std::string_view blue = "#0072b2", orange = "#d55e00", green = "#009e73";
inline constexpr std::string_view amber = "#e69f00", wall = "#3e4650";
}  // namespace palette

/// Collects elements; the canvas size is given last.
class SvgWriter {
 public:
  /// `attributes` is written as it is, e.g. R"(fill="#fff" stroke="none")".
  void rect(const Box& box, double radius, std::string_view attributes);
  void line(double x1, double y1, double x2, double y2, std::string_view attributes);
  void path(std::string_view data, std::string_view attributes);
  void circle(double x, double y, double radius, std::string_view attributes);
  /// A text on the baseline point; its box is remembered as a label.
  void text(double x, double baseline, std::string_view text, const TextStyle& style);

  /// The whole file: white background, sans-serif, <title> for readers of screens.
  Picture finish(double width, double height, std::string_view title) const;

 private:
  std::string body_;
  std::vector<SvgLabel> labels_;
};

/// A value for a label: 4 significant digits, but whole up to a million.
std::string label_number(double value);

/// A coordinate with at most 2 decimals.
std::string svg_number(double value);

/// A colour-blind-safe sequential scale from light (0) to dark (1), as "#rrggbb"; monotone in
/// lightness, so it survives a grey print. YlGnBu of Brewer, ColorBrewer.org, without its two
/// darkest.
std::string scale_color(double share);
/// Whether dark text is readable on scale_color(share).
bool scale_is_light(double share);

}  // namespace quoll
