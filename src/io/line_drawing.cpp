// lines.svg: a plan of lines, for pages and print.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "io/line_files.h"
#include "io/number.h"
#include "io/output_file.h"

namespace tufted::io {
namespace {

constexpr double panel = 800;   ///< longer side of the drawn lines, in pixels; fits into a screen
constexpr double margin = 20;   ///< around the lines, in pixels
constexpr double legend = 180;  ///< width of the legend and least width of the drawing; fits eight digits
constexpr int most_named = 20;  ///< values in the legend; more would be higher than the lines
/// From the least to the greatest value: blue, green, orange, which differ in print without colours as well.
constexpr std::array<std::array<double, 3>, 3> line_colors = {{{31, 78, 156}, {42, 157, 120}, {233, 138, 21}}};

/// A length of pixels as text, to a hundredth.
std::string text(double pixels) {
  return shortestText(std::round(100 * pixels) / 100);
}

/// A value as text; report.json has all digits.
std::string rounded(double value) {
  std::array<char, 32> digits;  // eight, a sign, a point and an exponent
  return {digits.data(),
          std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 8).ptr};
}

/// @param share of the way from the least value to the greatest, by their ranks
std::string colorAt(double share) {
  const std::size_t from = share < 0.5 ? 0 : 1;
  std::string color = "rgb(";
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double level =
        std::lerp(line_colors[from][channel], line_colors[from + 1][channel], 2 * share - double(from));
    color.append(channel > 0 ? "," : "").append(std::to_string(std::lround(level)));
  }
  return color + ")";
}

/// The greatest of 1, 2 and 5 times a power of ten that is at most `length`, which is positive.
double roundLength(double length) {
  const double power = std::pow(10, std::floor(std::log10(length)));
  return power * (length >= 5 * power ? 5 : length >= 2 * power ? 2 : 1);
}

class Drawing {
 public:
  explicit Drawing(const std::vector<Polyline>& lines) {
    for (const Polyline& line : lines) {
      if (!line.points.allFinite() || line.points.rows() == 0 || !std::isfinite(line.value)) continue;
      drawn_.push_back(&line);
      values_.push_back(line.value);
      for (const auto& point : line.points.rowwise()) box_.extend(halved(point));
    }
    std::sort(values_.begin(), values_.end());
    values_.erase(std::unique(values_.begin(), values_.end()), values_.end());
    const double extent = drawn_.empty() ? 0 : box_.sizes().maxCoeff();
    scale_ = extent > panel / std::numeric_limits<double>::max() ? panel / extent : 0;
  }

  void write(OutputFile& to) const {
    const Eigen::Vector2d size = drawn_.empty() ? Eigen::Vector2d(0, 0) : Eigen::Vector2d(scale_ * box_.sizes());
    const bool has_legend = values_.size() > 1 || (values_.size() == 1 && values_[0] != 0);
    const double rows = has_legend ? std::min<double>(double(values_.size()), most_named) : 0;
    const double width = std::max(size.x(), legend) + 2 * margin, height = std::max(size.y(), margin * rows);
    to.write("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + text(width + (has_legend ? legend : 0)) +
             "\" height=\"" + text(height + 4 * margin) +
             "\" font-family=\"sans-serif\" font-size=\"13\">\n<title>Plan of lines</title>\n<desc>Seen from above: "
             "x to the right, y up.</desc>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<g fill=\"none\" "
             "stroke-width=\"1.5\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n");
    for (const Polyline* line : drawn_) {
      to.write("<path stroke=\"" + colorOf(line->value) + "\" d=\"");
      // A line of one place has a second point, without which round caps are not drawn.
      for (Eigen::Index k = 0; k < std::max<Eigen::Index>(2, line->points.rows()); ++k) {
        const Eigen::Vector2d at = halved(line->points.row(std::min(k, line->points.rows() - 1))) - box_.min();
        to.write(k == 0 ? "M" : "L");
        to.write(text(margin + scale_ * at.x()).append(" ").append(text(margin + size.y() - scale_ * at.y())));
      }
      to.write(line->is_closed ? "Z\"/>\n" : "\"/>\n");
    }
    to.write("</g>\n");
    if (scale_ > 0) {
      const double length = roundLength(panel / 4 / scale_ * 2), y = height + 2 * margin;
      to.write("<path stroke=\"black\" d=\"M" + text(margin) + " " + text(y) + "h" + text(scale_ * (length / 2)) +
               "\"/>\n");
      writeWords(to, margin, y + margin, rounded(length) + " in the unit of the points");
    } else {
      writeWords(to, margin, height + 3 * margin, drawn_.empty() ? "No lines" : "All lines are at one place");
    }
    for (int row = 0; row < rows; ++row) {
      // The largest value stands at the top; of many values, evenly spaced ones are named.
      const double share = rows > 1 ? 1 - row / (rows - 1) : 0;
      const double value = values_[std::size_t(std::lround(share * double(values_.size() - 1)))];
      const double y = margin * (row + 1);
      to.write("<path stroke-width=\"3\" stroke=\"" + colorOf(value) + "\" d=\"M" + text(width) + " " + text(y) +
               "h20\"/>\n");
      writeWords(to, width + 1.5 * margin, y + 4, rounded(value));
    }
    to.write("</svg>\n");
  }

 private:
  /// x and y, halved so that differences of any two do not overflow.
  static Eigen::Vector2d halved(const Eigen::RowVector3d& point) { return {point.x() / 2, point.y() / 2}; }
  static void writeWords(OutputFile& to, double x, double y, const std::string& words) {
    to.write("<text x=\"" + text(x) + "\" y=\"" + text(y) + "\">" + words + "</text>\n");
  }
  std::string colorOf(double value) const {
    const auto rank = std::lower_bound(values_.begin(), values_.end(), value) - values_.begin();
    return colorAt(values_.size() > 1 ? double(rank) / double(values_.size() - 1) : 0);
  }

  std::vector<const Polyline*> drawn_;  ///< those that are finite
  std::vector<double> values_;          ///< in order, each once
  Eigen::AlignedBox2d box_;             ///< of halved points
  double scale_ = 0;                    ///< pixels per half unit of the points; 0: all lie at one place
};

}  // namespace

void writeLinesSvg(const OutputPath& to, const std::vector<Polyline>& lines) {
  OutputFile file(to);
  Drawing(lines).write(file);
  file.close();
}

}  // namespace tufted::io
