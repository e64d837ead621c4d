#pragma once

#include <string>

#include "tufted/view/picture.h"
#include "view/color_maps.h"

namespace tufted::view {

/// Lines, boxes and letters on a picture. Coordinates are pixels from the upper left.
class Canvas {
 public:
  explicit Canvas(Picture& picture);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void fill(int left, int top, int right, int bottom, const Rgb& color);
  void line(double x0, double y0, double x1, double y1, double width, const Rgb& color);
  void triangle(const std::array<Eigen::Vector2d, 3>& corners, const Rgb& color);
  /// @param text UTF-8; other bytes are U+FFFD
  /// @param y of the line that letters stand on
  void text(const std::string& text, double x, double y, double size, const Rgb& color);
  /// How wide a text is.
  double widthOf(const std::string& text, double size);
  /// The text, shortened by an ellipsis to fit.
  std::string shorten(const std::string& text, double size, double width);

 private:
  void blend(int x, int y, double share, const Rgb& color);

  struct Font;
  Picture& picture_;
  Font* font_;
};

}  // namespace tufted::view
