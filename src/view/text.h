#pragma once

#include <string>

#include "tufted/view/picture.h"
#include "view/color_maps.h"

namespace tufted::view {

/// Draws lines, boxes and text on a picture. Coordinates are pixels from the upper left corner.
class Canvas {
 public:
  explicit Canvas(Picture& picture);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void fill(int left, int top, int right, int bottom, const Rgb& color);
  void line(double x0, double y0, double x1, double y1, double width, const Rgb& color);
  void triangle(const std::array<Eigen::Vector2d, 3>& corners, const Rgb& color);
  /// @param text UTF-8; other bytes are drawn as U+FFFD
  /// @param x,y left end of the baseline
  void text(const std::string& text, double x, double y, double size, const Rgb& color);
  /// The width of a text.
  double widthOf(const std::string& text, double size);
  /// The text or, if it is wider than `width`, its beginning and an ellipsis.
  std::string shorten(const std::string& text, double size, double width);

 private:
  void blend(int x, int y, double share, const Rgb& color);

  struct Font;
  Picture& picture_;
  Font* font_;
};

}  // namespace tufted::view
