#include "tufted/view/picture.h"

#include <string>

#include "tufted/errors.h"
#include "view/field_colors.h"
#include "view/legend.h"
#include "view/marks.h"
#include "view/projection.h"
#include "view/samples.h"
#include "view/shading.h"
#include "view/text.h"

namespace tufted {

namespace {

/// Least width and height of a picture in pixels.
constexpr int least_size = 16;
/// Greatest width and height of a picture in pixels: the largest takes 7 GB for its samples.
constexpr int most_size = 8192;

void checkSize(const char* name, int size) {
  if (size < least_size || size > most_size)
    throw InvalidInput(std::string("drawPicture: ") + name + " " + std::to_string(size) + ", must be from " +
                       std::to_string(least_size) + " to " + std::to_string(most_size));
}

}  // namespace

Picture drawPicture(const Scene& scene, const PictureOptions& options) {
  checkScene(scene, "drawPicture");
  checkSize("width", options.width);
  checkSize("height", options.height);
  view::checkCamera(options.camera, "drawPicture");
  const view::FieldColors colors = view::colorsOf(scene, options);
  const view::Layout layout = view::layoutOf(scene, colors, options);
  const view::NormalizedPoints points = view::normalize(scene, options.threads);
  const int scale = view::samples_per_pixel;
  const view::Viewport viewport = {
      .left = 0, .right = scale * layout.right, .top = scale * layout.top, .bottom = scale * options.height};
  const view::Projection projection = view::project(points, options.camera, viewport);
  const view::SeenScene seen =
      view::look(scene, points, projection, scale * options.width, scale * options.height, options.threads);
  Picture picture = view::shade(seen, colors, options);
  view::Canvas canvas(picture);
  if (colors.field != nullptr && colors.field->kind == FieldKind::vector) view::drawArrows(seen, colors, canvas);
  view::drawSources(seen, colors.sources, layout.text_size, canvas);
  view::drawPath(seen, layout.text_size, canvas);
  view::drawLegend(scene, colors, options, layout, canvas);
  return picture;
}

WholeFile preparePicture(const std::filesystem::path& path, const Scene& scene, const PictureOptions& options) {
  return {path, pngOf(drawPicture(scene, options))};
}

void writePicture(const std::filesystem::path& path, const Scene& scene, const PictureOptions& options) {
  preparePicture(path, scene, options).giveName();
}

}  // namespace tufted
