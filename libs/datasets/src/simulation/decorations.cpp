// SPDX-License-Identifier: BSD-3-Clause
#include "decorations.h"

#include <algorithm>
#include <map>

#include "materials.h"

namespace vmcl {
namespace {

using DecorationPainter = void (*)(const Canvas&);

/// Paints a frame along the border and returns what is left inside.
Canvas framed(const Canvas& canvas, double thickness, const cv::Scalar& color) {
  canvas.fill(color);
  const auto inside = [&](double border) {
    return canvas.part(border, border, canvas.width() - 2 * border, canvas.height() - 2 * border);
  };
  inside(thickness * 0.8).fill(shaded(color, 0.4));
  return inside(thickness);
}

void paintShape(const Canvas& canvas) {
  Random& random = canvas.random();
  const cv::Scalar color = randomColor(random);
  const double x = random.uniform(0, canvas.width()), y = random.uniform(0, canvas.height());
  const double size = std::min(canvas.width(), canvas.height()) * random.uniform(0.08, 0.3);
  const auto near = [&](double center) { return center + random.uniform(-size, size); };
  switch (random.below(3)) {
    case 0:
      canvas.ellipse(x, y, size, size * random.uniform(0.4, 1), random.uniform(0, 180), color);
      break;
    case 1:
      canvas.polygon({{near(x), near(y)}, {near(x), near(y)}, {near(x), near(y)}}, color);
      break;
    default:
      canvas.line(x, y, near(x), near(y), size * 0.12, color);
  }
}

void paintPainting(const Canvas& canvas) {
  Random& random = canvas.random();
  const cv::Scalar frames[] = {{30, 45, 70}, {20, 20, 20}, {90, 150, 190}, {225, 228, 230}};
  const Canvas picture = framed(canvas, 0.035, frames[random.below(4)]);
  picture.gradient(randomColor(random), randomColor(random));
  const int shapes = 12 + static_cast<int>(random.below(14));
  for (int i = 0; i < shapes; ++i) paintShape(picture);
  picture.mottle(0.12, 0.03, 0.03);
}

void paintPoster(const Canvas& canvas) {
  Random& random = canvas.random();
  canvas.fill(varied({225, 230, 235}, 0.1, random));
  const double line = canvas.height() / 12;
  for (double y = canvas.height() - 1.4 * line; y > 0.3 * line; y -= line) {
    std::string words;
    for (int i = 0; i < 40; ++i) words += random.uniform() < 0.2 ? ' ' : static_cast<char>('A' + random.below(26));
    if (random.uniform() < 0.35) {
      canvas.rectangle(0.08 * canvas.width(), y, canvas.width() * random.uniform(0.3, 0.8), line * 0.8,
                       randomColor(random));
    } else {
      canvas.part(0.08 * canvas.width(), y - 0.2 * line, canvas.width() * 0.84, line)
          .text(0, 0.2 * line, line * random.uniform(0.3, 0.65), words, shaded(randomColor(random), 0.4));
    }
  }
  for (int i = 0; i < 4; ++i) paintShape(canvas);
}

void paintWindow(const Canvas& canvas) {
  Random& random = canvas.random();
  const Canvas view = framed(canvas, 0.06, {235, 238, 240});
  view.gradient({250, 240, 225}, {245, 200, 150});
  for (int hill = 0; hill < 5; ++hill)
    view.ellipse(random.uniform(0, view.width()), 0, random.uniform(0.2, 0.6), random.uniform(0.15, 0.4), 0,
                 varied({60, 130, 90}, 0.3, random));
  for (int tree = 0; tree < 6; ++tree) {
    const double x = random.uniform(0, view.width()), tall = random.uniform(0.2, 0.5);
    view.line(x, 0, x, tall, 0.02, {40, 60, 80});
    view.ellipse(x, tall, random.uniform(0.06, 0.14), random.uniform(0.08, 0.16), 0,
                 varied({50, 110, 60}, 0.4, random));
  }
  view.rectangle(view.width() / 2 - 0.02, 0, 0.04, view.height(), {235, 238, 240});
  view.rectangle(0, view.height() * 0.62, view.width(), 0.03, {235, 238, 240});
}

void paintDoor(const Canvas& canvas) {
  const cv::Scalar color = varied({120, 150, 180}, 0.25, canvas.random());
  const Canvas leaf = framed(canvas, 0.07, shaded(color, 1.2));
  paintWood(leaf, color);
  for (const double y : {0.1, 0.55}) {
    leaf.rectangle(0.15 * leaf.width(), y * leaf.height(), 0.7 * leaf.width(), 0.35 * leaf.height(),
                   shaded(color, 0.6));
    paintWood(
        leaf.part(0.17 * leaf.width(), y * leaf.height() + 0.02, 0.66 * leaf.width(), 0.35 * leaf.height() - 0.04),
        shaded(color, 0.92));
  }
  leaf.line(leaf.width() * 0.92, leaf.height() * 0.5, leaf.width() * 0.8, leaf.height() * 0.5, 0.025, {60, 70, 75});
}

const std::map<std::string, DecorationPainter>& decorationPainters() {
  static const std::map<std::string, DecorationPainter> decorationPainters{
      {"door", paintDoor}, {"painting", paintPainting}, {"poster", paintPoster}, {"window", paintWindow}};
  return decorationPainters;
}

}  // namespace

bool isDecoration(const std::string& kind) { return decorationPainters().contains(kind); }

std::string decorationNames() {
  std::string names;
  for (const auto& [name, painter] : decorationPainters()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

void paintDecoration(const std::string& kind, const Canvas& canvas) { decorationPainters().at(kind)(canvas); }

}  // namespace vmcl
