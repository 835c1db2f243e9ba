#include "scabo/mesh/image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scabo/base/disjoint_sets.hpp"
#include "scabo/base/error.hpp"
#include "scabo/mesh/quadtree/forest.hpp"

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

  /// Throws InputError if two parts that have no side in common touch at a corner.
  void check_corners() const {
    const Level& pixels = levels_.front();
    const auto solid = [&](int x, int y) { return pixels.at(x, y) >= 0; };
    struct Corner {
      std::array<int, 2> first, second;  // the pixels that touch, the upper one first
    };
    std::vector<Corner> corners;
    for (int y = pixels.height - 1; y > 0; --y)  // from the top, as in the file
      for (int x = 0; x + 1 < pixels.width; ++x) {
        const bool falling = solid(x, y) && solid(x + 1, y - 1), rising = solid(x + 1, y) && solid(x, y - 1);
        if (falling && !solid(x + 1, y) && !solid(x, y - 1)) corners.push_back({{x, y}, {x + 1, y - 1}});
        if (rising && !solid(x, y) && !solid(x + 1, y - 1)) corners.push_back({{x + 1, y}, {x, y - 1}});
      }
    if (corners.empty()) return;
    const auto number = [&](int x, int y) { return std::size_t(y) * pixels.width + x; };
    DisjointSets parts(pixels.regions.size());
    for (int y = 0; y < pixels.height; ++y)
      for (int x = 0; x < pixels.width; ++x) {
        if (!solid(x, y)) continue;
        if (solid(x + 1, y)) parts.join(number(x, y), number(x + 1, y));
        if (solid(x, y + 1)) parts.join(number(x, y), number(x, y + 1));
      }
    const Corner* worst = nullptr;
    std::size_t count = 0;
    for (const Corner& at : corners) {
      if (parts.root(number(at.first[0], at.first[1])) == parts.root(number(at.second[0], at.second[1]))) continue;
      if (count++ == 0) worst = &at;
    }
    if (worst == nullptr) return;
    const auto text = [&](const std::array<int, 2>& at) {
      return fmt::format("({}, {})", at[0], pixels.height - 1 - at[1]);
    };
    throw InputError(
        {}, {{{},
              fmt::format("the image has parts that hang together only at a corner, {}that of pixels {} and {} "
                          "(column and row from the top left, from 0): give a pixel beside it a material, or make "
                          "the parts separate bodies",
                          count > 1 ? fmt::format("at {} places, first at ", count) : "", text(worst->first),
                          text(worst->second))}});
  }

 private:
  struct Level {
    int width, height;
    std::vector<int> regions;

    int at(int x, int y) const {
      return x < width && y < height ? regions[std::size_t(y) * width + x] : int(TreeCell::outside);
    }
  };

  static int region_of(int label, const ImageOptions& options) {
    if (options.regions.empty()) return label < 0 ? int(TreeCell::outside) : label;
    const auto found = options.regions.find(label);
    return found == options.regions.end() ? int(TreeCell::outside) : found->second;
  }

  std::vector<Level> levels_;
};

}  // namespace

PolygonMesh image_mesh(const files::Image& image, const ImageOptions& options) {
  ensure(image.width > 0 && image.height > 0 && image.labels.size() == std::size_t(image.width) * image.height,
         "an image without pixels, or with a wrong number of labels");
  const double largest = options.size > 0.0 ? options.size / options.pixel * (1.0 + 1e-9) : 1e9;
  int levels = 0;  // of the tree; its roots have 2^levels pixels on a side
  while ((2 << levels) <= std::min(image.width, image.height) && double(2 << levels) <= largest) ++levels;
  const int side = 1 << levels;
  const Blocks blocks(image, options, levels);
  blocks.check_corners();
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
  PolygonMesh mesh;
  mesh.nodes = nodes.positions;
  std::vector<int> polygon;
  for (int index : leaves) {
    const TreeCell& leaf = forest.cells[index];
    if (leaf.region < 0) continue;
    nodes.polygon(leaf, polygon);
    mesh.cells.push_back({polygon, forest.middle(leaf), leaf.region, {}, false});
  }
  if (mesh.cells.empty()) throw InputError({}, {{{}, "the image has no pixel of any material"}});

  // Nodes are whole multiples of half the smallest cell, so that these comparisons are exact.
  const Vec2 size = options.pixel * Vec2(image.width, image.height);
  mesh.left.resize(4);
  for (int line = 0; line < 4; ++line) {
    const int along = line % 2;  // x on the bottom and top
    const double across = line == 1 || line == 2 ? size[1 - along] : 0.0;
    for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
      if (mesh.nodes[k][1 - along] == across) mesh.left[line].push_back(int(k));
    }
    std::sort(mesh.left[line].begin(), mesh.left[line].end(), [&](int a, int b) {
      return line < 2 ? mesh.nodes[a][along] < mesh.nodes[b][along] : mesh.nodes[a][along] > mesh.nodes[b][along];
    });
  }
  mesh.right = mesh.left;
  return mesh;
}

}  // namespace scabo::mesh
