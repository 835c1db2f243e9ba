#include "scabo/mesh/plane/image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "scabo/base/disjoint_sets.hpp"
#include "scabo/base/error.hpp"
#include "scabo/mesh/plane/quadtree/forest.hpp"

namespace scabo::mesh {

namespace {

using quadtree::TreeCell;

/// Regions of blocks of 2^k by 2^k pixels: `cut` where they are not uniform, `outside` beyond the image and where void.
class Blocks {
 public:
  Blocks(const files::Image& image, const ImageOptions& options, int levels) {
    Level pixels{image.width, image.height, {}};
    pixels.regions.resize(std::size_t(image.width) * image.height);
    int last = 0, last_region = TreeCell::outside;
    bool first = true;
    for (int y = 0; y < image.height; ++y) {
      const int* row = image.labels.data() + std::size_t(image.height - 1 - y) * image.width;
      for (int x = 0; x < image.width; ++x) {
        if (first || row[x] != last) {
          last = row[x];
          last_region = region_of(last, options);
          first = false;
        }
        pixels.regions[std::size_t(y) * image.width + x] = last_region;
      }
    }
    levels_.push_back(std::move(pixels));
    for (int k = 1; k <= levels; ++k) {
      const Level& fine = levels_.back();
      Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
      coarse.regions.resize(std::size_t(coarse.width) * coarse.height);
      for (int y = 0; y < coarse.height; ++y) {
        for (int x = 0; x < coarse.width; ++x) {
          const int one = fine.at(2 * x, 2 * y);
          const bool uniform = one == fine.at(2 * x + 1, 2 * y) && one == fine.at(2 * x, 2 * y + 1) &&
                               one == fine.at(2 * x + 1, 2 * y + 1);
          coarse.regions[std::size_t(y) * coarse.width + x] = uniform ? one : TreeCell::cut;
        }
      }
      levels_.push_back(std::move(coarse));
    }
  }

  int at(int level, int x, int y) const { return levels_[level].at(x, y); }

  /// Throws InputError if there are several parts that have no side in common, whether they touch at a corner or not.
  void check_connected() const {
    const Level& pixels = levels_.front();
    if (std::all_of(pixels.regions.begin(), pixels.regions.end(), [](int region) { return region >= 0; })) return;
    DisjointSets parts(pixels.regions.size());
    for (int y = 0; y < pixels.height; ++y)
      for (int x = 0; x < pixels.width; ++x) {
        if (!pixels.is_solid(x, y)) continue;
        if (pixels.is_solid(x + 1, y)) parts.join(pixels.number(x, y), pixels.number(x + 1, y));
        if (pixels.is_solid(x, y + 1)) parts.join(pixels.number(x, y), pixels.number(x, y + 1));
      }
    check_corners(parts);
    std::map<std::size_t, std::size_t> size_of_part;  // by its first pixel
    for (std::size_t k = 0; k < pixels.regions.size(); ++k)
      if (pixels.regions[k] >= 0) ++size_of_part[parts.root(k)];
    if (size_of_part.size() < 2) return;
    const auto smallest = std::min_element(size_of_part.begin(), size_of_part.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
    const auto width = static_cast<std::size_t>(pixels.width);
    const std::array<int, 2> at{static_cast<int>(smallest->first % width), static_cast<int>(smallest->first / width)};
    throw InputError(
        {}, {{{},
              fmt::format("the image has {} parts that have no side in common, the smallest of {} {} at {} (column and "
                          "row from the top left, from 0), but a body is connected: leave the pixels of all but one "
                          "without a material, or make the parts separate bodies",
                          size_of_part.size(), smallest->second, smallest->second == 1 ? "pixel" : "pixels",
                          text_of(at))}});
  }

 private:
  struct Level {
    int width, height;
    std::vector<int> regions;

    int at(int x, int y) const {
      return x < width && y < height ? regions[std::size_t(y) * width + x] : int(TreeCell::outside);
    }
    bool is_solid(int x, int y) const { return at(x, y) >= 0; }
    std::size_t number(int x, int y) const { return std::size_t(y) * width + x; }
  };

  /// Throws InputError if two of the parts touch at a corner.
  void check_corners(DisjointSets& parts) const {
    const Level& pixels = levels_.front();
    const auto solid = [&](int x, int y) { return pixels.is_solid(x, y); };
    struct Corner {
      std::array<int, 2> first, second;  // the pixels that touch, the upper one first
    };
    std::optional<Corner> worst;
    std::size_t count = 0;
    const auto add = [&](const Corner& at) {
      if (parts.root(pixels.number(at.first[0], at.first[1])) == parts.root(pixels.number(at.second[0], at.second[1])))
        return;
      if (count++ == 0) worst = at;
    };
    for (int y = pixels.height - 1; y > 0; --y)  // from the top, as in the file
      for (int x = 0; x + 1 < pixels.width; ++x) {
        const bool falling = solid(x, y) && solid(x + 1, y - 1), rising = solid(x + 1, y) && solid(x, y - 1);
        if (falling && !solid(x + 1, y) && !solid(x, y - 1)) add({{x, y}, {x + 1, y - 1}});
        if (rising && !solid(x, y) && !solid(x + 1, y - 1)) add({{x + 1, y}, {x, y - 1}});
      }
    if (!worst) return;
    throw InputError(
        {}, {{{},
              fmt::format("the image has parts that hang together only at a corner, {}that of pixels {} and {} "
                          "(column and row from the top left, from 0): give a pixel beside it a material, or make "
                          "the parts separate bodies",
                          count > 1 ? fmt::format("at {} places, first at ", count) : "", text_of(worst->first),
                          text_of(worst->second))}});
  }

  /// Column and row from the top left.
  std::string text_of(const std::array<int, 2>& pixel) const {
    return fmt::format("({}, {})", pixel[0], levels_.front().height - 1 - pixel[1]);
  }

  static int region_of(int label, const ImageOptions& options) {
    if (options.regions.empty()) return label < 0 ? int(TreeCell::outside) : label;
    const auto found = options.regions.find(label);
    return found == options.regions.end() ? int(TreeCell::outside) : found->second;
  }

  std::vector<Level> levels_;
};

/// A side of a cell on the rectangle, counter-clockwise around the cells.
struct SideOnRectangle {
  int from = -1, to = -1;
  double at = 0.0;  // of `from`, along its side of the rectangle
};

/// The sides of cells on the four sides of the smallest rectangle around them, each from its start on.
std::array<std::vector<SideOnRectangle>, 4> sides_on_rectangle(const PolygonMesh& mesh, const Vec2& low,
                                                               const Vec2& high) {
  std::array<std::vector<SideOnRectangle>, 4> sides;
  for (const PolygonCell& cell : mesh.cells)
    for (std::size_t i = 0; i < cell.nodes.size(); ++i) {
      const int from = cell.nodes[i], to = cell.nodes[(i + 1) % cell.nodes.size()];
      const Vec2 &a = mesh.nodes[static_cast<std::size_t>(from)], &b = mesh.nodes[static_cast<std::size_t>(to)];
      // Nodes are whole multiples of half the smallest cell, so that these comparisons are exact.
      if (a.y() == low.y() && b.y() == low.y()) sides[0].push_back({from, to, a.x()});
      if (a.x() == high.x() && b.x() == high.x()) sides[1].push_back({from, to, a.y()});
      if (a.y() == high.y() && b.y() == high.y()) sides[2].push_back({from, to, -a.x()});
      if (a.x() == low.x() && b.x() == low.x()) sides[3].push_back({from, to, -a.y()});
    }
  for (auto& side : sides)
    std::sort(side.begin(), side.end(), [](const SideOnRectangle& a, const SideOnRectangle& b) { return a.at < b.at; });
  return sides;
}

/// The chains of sides along the rectangle, and the nodes at its corners.
void add_lines(ImageMesh& mesh) {
  Vec2 low = mesh.nodes.front(), high = low;
  for (const Vec2& node : mesh.nodes) {
    low = low.cwiseMin(node);
    high = high.cwiseMax(node);
  }
  const auto sides = sides_on_rectangle(mesh, low, high);
  const std::array<Vec2, 4> corners{low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y())};
  for (std::size_t side = 0; side < sides.size(); ++side)
    for (const SideOnRectangle& at : sides[side]) {
      std::vector<std::size_t>& lines = mesh.lines_of_side[side];
      if (lines.empty() || mesh.left[lines.back()].back() != at.from) {
        lines.push_back(mesh.left.size());
        mesh.left.push_back({at.from});
      }
      mesh.left[lines.back()].push_back(at.to);
      if (mesh.nodes[static_cast<std::size_t>(at.from)] == corners[side]) mesh.corners[side] = at.from;
    }
  mesh.right = mesh.left;
}

}  // namespace

ImageMesh image_mesh(const files::Image& image, const ImageOptions& options) {
  ensure(image.width > 0 && image.height > 0 && image.labels.size() == std::size_t(image.width) * image.height,
         "an image without pixels, or with a wrong number of labels");
  const double largest = options.size > 0.0 ? options.size / options.pixel * (1.0 + 1e-9) : 1e9;
  int levels = 0;  // of the tree; its roots have 2^levels pixels on a side
  while ((2 << levels) <= std::min(image.width, image.height) && double(2 << levels) <= largest) ++levels;
  const int side = 1 << levels;
  const Blocks blocks(image, options, levels);
  blocks.check_connected();
  quadtree::Forest forest(Vec2::Zero(), Vec2::Constant(options.pixel * side), (image.width + side - 1) / side,
                          (image.height + side - 1) / side);
  const auto set_region = [&](TreeCell& cell) { cell.region = blocks.at(levels - cell.level, cell.x, cell.y); };
  for (TreeCell& root : forest.cells) set_region(root);
  forest.divided = [&](int parent) {
    for (int k = 0; k < 4; ++k) set_region(forest.cells[forest.cells[parent].child + k]);
  };
  for (std::size_t k = 0; k < forest.cells.size(); ++k) {
    if (forest.cells[k].region == TreeCell::cut && forest.cells[k].child < 0) forest.split(int(k));
  }
  forest.balance();

  const std::vector<int> leaves = forest.leaves();
  const quadtree::ForestNodes nodes(forest, leaves);
  ImageMesh mesh;
  mesh.nodes = nodes.positions;
  std::vector<int> polygon;
  for (int index : leaves) {
    const TreeCell& leaf = forest.cells[index];
    if (leaf.region < 0) continue;
    nodes.polygon(leaf, polygon);
    mesh.cells.push_back({polygon, forest.middle(leaf), leaf.region, {}, false});
  }
  if (mesh.cells.empty()) throw InputError({}, {{{}, "the image has no pixel of any material"}});

  add_lines(mesh);
  mesh.right = mesh.left;
  return mesh;
}

}  // namespace scabo::mesh
