// Meshes of images, and PNG files.
#include "scabo/mesh/plane/image.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <variant>
#include <vector>

#include "models.hpp"
#include "scabo/base/error.hpp"
#include "scabo/files/png.hpp"
#include "scabo/mesh/plane/many_cells.hpp"
#include "support/random.hpp"

namespace scabo::mesh {
namespace {

/// Widths of the cells by their lower left corners; checks that cells are squares.
std::map<std::pair<double, double>, std::pair<double, int>> squares_of(const PolygonMesh& mesh) {
  std::map<std::pair<double, double>, std::pair<double, int>> found;
  for (const PolygonCell& cell : mesh.cells) {
    Vec2 lower = mesh.nodes[cell.nodes[0]], upper = lower;
    for (int node : cell.nodes) {
      lower = lower.cwiseMin(mesh.nodes[node]);
      upper = upper.cwiseMax(mesh.nodes[node]);
    }
    EXPECT_EQ(upper.x() - lower.x(), upper.y() - lower.y());
    EXPECT_EQ(Vec2(0.5 * (lower + upper)), cell.centre);
    found[{lower.x(), lower.y()}] = {upper.x() - lower.x(), cell.region};
  }
  return found;
}

/// Every side has a twin in another cell, or lies on the border of the image.
void check_sides(const PolygonMesh& mesh, const Vec2& size) {
  std::map<std::pair<int, int>, int> sides;
  for (const PolygonCell& cell : mesh.cells) {
    for (std::size_t i = 0; i < cell.nodes.size(); ++i) {
      const bool first = sides.emplace(std::pair(cell.nodes[i], cell.nodes[(i + 1) % cell.nodes.size()]), 0).second;
      ASSERT_TRUE(first);
    }
  }
  for (const auto& [side, unused] : sides) {
    if (sides.count({side.second, side.first})) continue;
    const Vec2 middle = 0.5 * (mesh.nodes[side.first] + mesh.nodes[side.second]);
    ASSERT_TRUE(middle.x() == 0.0 || middle.y() == 0.0 || middle.x() == size.x() || middle.y() == size.y());
  }
}

TEST(ImageMesh, HasNoMoreNodesThanAreAllowed) {
  model::Body body = test::elastic("core", test::rectangle({0.0, 0.0}, {3.0, 2.0}), 1.0);
  body.mesh.kind = model::MeshKind::quadtree;
  body.image =
      model::ImageShape{std::make_shared<files::Image>(files::Image{3, 2, {1, 2, 1, 2, 1, 2}}), 1.0, {{1, 0}, {2, 0}}};
  body.mesh.order = 3;
  const int nodes = 12 + 2 * 17;  // corners and two on each side of six pixels
  const auto made = divide_into_cells(body, {}, nodes);
  ASSERT_TRUE(std::holds_alternative<BodyMesh>(made)) << std::get<Diagnostic>(made).message;
  EXPECT_EQ(std::get<BodyMesh>(made).nodes.size(), nodes);
  const auto refused = divide_into_cells(body, {}, nodes - 1);
  ASSERT_TRUE(std::holds_alternative<Diagnostic>(refused));
  EXPECT_THAT(
      std::get<Diagnostic>(refused).message,
      testing::HasSubstr("6 cells with about 46 nodes, more than the 45 allowed: use an image of fewer pixels or a "
                         "lower 'order'"));
}

TEST(ImageMesh, RefusesPartsWithoutASideInCommon) {
  const auto message = [](int width, int height, const std::vector<int>& labels) -> std::string {
    try {
      image_mesh({width, height, labels}, {0.5, 0.0, {{3, 0}, {4, 1}}});
    } catch (const InputError& error) {
      return error.diagnostics().front().message;
    }
    return "";
  };
  EXPECT_THAT(message(3, 3,
                      {3, 3, 7,  //
                       3, 4, 7,  //
                       7, 7, 3}),
              testing::HasSubstr("hang together only at a corner, that of pixels (1, 1) and (2, 2)"));
  EXPECT_THAT(message(3, 3,
                      {3, 7, 3,  //
                       7, 4, 7,  //
                       3, 3, 3}),
              testing::HasSubstr("at 2 places, first at that of pixels (0, 0) and (1, 1)"));
  EXPECT_THAT(message(2, 2,
                      {7, 3,  //
                       4, 7}),
              testing::HasSubstr("pixels (1, 0) and (0, 1)"));
  // The same corner in a part that is joined by sides elsewhere, and a part alone.
  EXPECT_EQ(message(3, 3,
                    {3, 7, 3,  //
                     3, 3, 7,  //
                     7, 3, 3}),
            "the image has parts that hang together only at a corner, that of pixels (2, 0) and (1, 1) (column and row "
            "from the top left, from 0): give a pixel beside it a material, or make the parts separate bodies");
  EXPECT_EQ(message(3, 3,
                    {3, 3, 3,  //
                     3, 7, 3,  //
                     3, 3, 7}),
            "");
  EXPECT_EQ(
      message(3, 3,
              {3, 3, 7,  //
               7, 7, 7,  //
               3, 4, 3}),
      "the image has 2 parts that have no side in common, the smallest of 2 pixels at (0, 0) (column and row from "
      "the top left, from 0), but a body is connected: leave the pixels of all but one without a material, or "
      "make the parts separate bodies");
  EXPECT_THAT(message(3, 1, {3, 7, 3}), testing::HasSubstr("has 2 parts that have no side in common, the smallest of 1 "
                                                           "pixel at (0, 0)"));
}

TEST(ImageMesh, FourByFourPixelsByHand) {
  // The upper right quarter has one pixel of label 7 at its lower left: it is divided, the other three quarters are
  // not.
  const files::Image image{4,
                           4,
                           {3, 3, 3, 3,  //
                            3, 3, 7, 3,  //
                            3, 3, 3, 3,  //
                            3, 3, 3, 3}};
  const PolygonMesh mesh = image_mesh(image, {0.5, 0.0, {{3, 0}, {7, 1}}});
  using Squares = std::map<std::pair<double, double>, std::pair<double, int>>;
  EXPECT_EQ(squares_of(mesh), (Squares{{{0, 0}, {1, 0}},
                                       {{1, 0}, {1, 0}},
                                       {{0, 1}, {1, 0}},
                                       {{1, 1}, {0.5, 1}},
                                       {{1.5, 1}, {0.5, 0}},
                                       {{1, 1.5}, {0.5, 0}},
                                       {{1.5, 1.5}, {0.5, 0}}}));
  EXPECT_EQ(mesh.nodes.size(), 9u + 5u);
  check_sides(mesh, {2, 2});
  // The lower right quarter has a hanging node in its upper side, the upper left one in its right side.
  std::vector<std::size_t> counts;
  for (const PolygonCell& cell : mesh.cells) counts.push_back(cell.nodes.size());
  EXPECT_EQ(std::count(counts.begin(), counts.end(), 5u), 2);
  EXPECT_EQ(std::count(counts.begin(), counts.end(), 4u), 5);
  const auto places = [&](int line) {
    std::vector<std::pair<double, double>> found;
    for (int node : mesh.left[line]) found.push_back({mesh.nodes[node].x(), mesh.nodes[node].y()});
    return found;
  };
  using Places = std::vector<std::pair<double, double>>;
  EXPECT_EQ(places(0), (Places{{0, 0}, {1, 0}, {2, 0}}));
  EXPECT_EQ(places(1), (Places{{2, 0}, {2, 1}, {2, 1.5}, {2, 2}}));
  EXPECT_EQ(places(2), (Places{{2, 2}, {1.5, 2}, {1, 2}, {0, 2}}));
  EXPECT_EQ(places(3), (Places{{0, 2}, {0, 1}, {0, 0}}));
}

TEST(ImageMesh, VoidPixelsHaveNoCells) {
  const files::Image image{3,
                           2,
                           {0, 5, 0,  //
                            0, 0, -1}};
  const PolygonMesh mesh = image_mesh(image, {});
  const auto squares = squares_of(mesh);
  EXPECT_EQ(squares.size(), 5u);
  EXPECT_EQ(squares.count({2, 0}), 0u);
  EXPECT_EQ(squares.at({1, 1}).second, 5);
  EXPECT_THROW(image_mesh({1, 1, {-4}}, {}), InputError);
}

// Chains of sides run along the smallest rectangle around the cells; an empty pixel on it parts them and takes its
// corner.
TEST(ImageMesh, EmptyPixelsInterruptTheBorder) {
  const files::Image image{4,
                           3,
                           {7, 3, 7, 3,  //
                            7, 3, 3, 3,  //
                            7, 7, 7, 7}};
  const ImageMesh mesh = image_mesh(image, {1.0, 0.0, {{3, 0}}});
  using Places = std::vector<std::vector<std::pair<double, double>>>;
  const auto along = [&](int side) {
    Places found;
    for (const std::size_t line : mesh.lines_of_side[side]) {
      found.emplace_back();
      for (const int node : mesh.left[line]) found.back().push_back({mesh.nodes[node].x(), mesh.nodes[node].y()});
    }
    return found;
  };
  EXPECT_EQ(along(0), (Places{{{1, 1}, {2, 1}, {3, 1}, {4, 1}}}));
  EXPECT_EQ(along(1), (Places{{{4, 1}, {4, 2}, {4, 3}}}));
  EXPECT_EQ(along(2), (Places{{{4, 3}, {3, 3}}, {{2, 3}, {1, 3}}}));
  EXPECT_EQ(along(3), (Places{{{1, 3}, {1, 2}, {1, 1}}}));
  const ImageMesh corner = image_mesh({2, 2, {7, 3, 3, 3}}, {1.0, 0.0, {{3, 0}}});
  EXPECT_EQ(corner.corners[3], -1);
  for (const int side : {0, 1, 2}) EXPECT_GE(corner.corners[side], 0) << side;
  EXPECT_EQ(corner.nodes[corner.corners[2]], Vec2(2, 2));
}

TEST(ImageMesh, LargestSize) {
  const files::Image image{64, 32, std::vector<int>(64 * 32, 0)};
  EXPECT_EQ(image_mesh(image, {0.1, 0.0, {}}).cells.size(), 2u);
  EXPECT_EQ(image_mesh(image, {0.1, 0.8, {}}).cells.size(), 32u);
  EXPECT_EQ(image_mesh(image, {0.1, 0.01, {}}).cells.size(), 64u * 32u);
}

TEST(ImageMesh, RandomDiscs) {
  std::mt19937 random(8);
  const int n = 512;
  files::Image image{n, n, std::vector<int>(n * n, 0)};
  for (int k = 0; k < 80; ++k) {
    const double x = test::uniform(random, 0, n), y = test::uniform(random, 0, n), r = test::uniform(random, 3, 40);
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        if ((i + 0.5 - x) * (i + 0.5 - x) + (j + 0.5 - y) * (j + 0.5 - y) < r * r) image.labels[j * n + i] = 255;
      }
    }
  }
  const double pixel = 1e-4;
  const PolygonMesh mesh = image_mesh(image, {pixel, 0.0, {{0, 0}, {255, 1}}});
  check_sides(mesh, Vec2(n * pixel, n * pixel));
  // Each pixel is covered once by a cell of its label, so that the sums agree as whole numbers.
  std::vector<int> covered(n * n, 0), width(n * n, 0);
  for (const PolygonCell& cell : mesh.cells) {
    const auto number = [&](double x) { return int(std::lround(x / pixel)); };
    double half = 0.0;
    for (int node : cell.nodes) half = std::max(half, (mesh.nodes[node] - cell.centre).cwiseAbs().maxCoeff());
    const int side = number(2.0 * half), x = number(cell.centre.x() - half), y = number(cell.centre.y() - half);
    for (int j = y; j < y + side; ++j) {
      for (int i = x; i < x + side; ++i) {
        ++covered[j * n + i];
        width[j * n + i] = side;
        ASSERT_EQ(image.labels[(n - 1 - j) * n + i], cell.region == 1 ? 255 : 0);
      }
    }
  }
  EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), n * n);
  int worst = 1;
  for (int j = 0; j + 1 < n; ++j) {
    for (int i = 0; i + 1 < n; ++i) {
      for (const auto& [a, b] : {std::pair(0, 1), std::pair(0, n), std::pair(0, n + 1), std::pair(1, n)}) {
        const int one = width[j * n + i + a], other = width[j * n + i + b];
        worst = std::max({worst, one / other, other / one});
      }
    }
  }
  EXPECT_EQ(worst, 2);
  EXPECT_LT(mesh.cells.size(), 60000u);
}

/// PNG files made here: chunks with their sums, and data of stored (not compressed) blocks.
class PngFile {
 public:
  PngFile(int width, int height, int depth, int colours) {
    bytes = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    std::vector<std::uint8_t> header;
    for (int value : {width, height}) {
      for (int shift : {24, 16, 8, 0}) header.push_back(std::uint8_t(value >> shift));
    }
    for (int value : {depth, colours, 0, 0, 0}) header.push_back(std::uint8_t(value));
    chunk("IHDR", header);
  }

  void chunk(const std::string& name, const std::vector<std::uint8_t>& data) {
    number(std::uint32_t(data.size()));
    const std::size_t from = bytes.size();
    bytes.insert(bytes.end(), name.begin(), name.end());
    bytes.insert(bytes.end(), data.begin(), data.end());
    std::uint32_t sum = 0xffffffffu;
    for (std::size_t k = from; k < bytes.size(); ++k) {
      sum ^= bytes[k];
      for (int bit = 0; bit < 8; ++bit) sum = sum & 1 ? 0xedb88320u ^ (sum >> 1) : sum >> 1;
    }
    number(~sum);
  }

  /// Rows of samples, each with its filter byte 0, then the end of the file.
  std::vector<std::uint8_t> finish(const std::vector<std::vector<std::uint8_t>>& rows) {
    std::vector<std::uint8_t> raw, data{0x78, 0x01};
    for (const auto& row : rows) {
      raw.push_back(0);
      raw.insert(raw.end(), row.begin(), row.end());
    }
    const std::size_t n = raw.size();
    for (std::size_t value : {std::size_t(1), n & 255, n >> 8, ~n & 255, (~n >> 8) & 255})
      data.push_back(std::uint8_t(value));
    std::uint32_t a = 1, b = 0;
    for (std::uint8_t byte : raw) {
      data.push_back(byte);
      a = (a + byte) % 65521;
      b = (b + a) % 65521;
    }
    for (std::uint32_t value : {b >> 8, b & 255, a >> 8, a & 255}) data.push_back(std::uint8_t(value));
    chunk("IDAT", data);
    chunk("IEND", {});
    return bytes;
  }

  std::vector<std::uint8_t> bytes;

 private:
  void number(std::uint32_t value) {
    for (int shift : {24, 16, 8, 0}) bytes.push_back(std::uint8_t(value >> shift));
  }
};

files::Image read_bytes(const std::vector<std::uint8_t>& bytes) {
  const auto file = std::filesystem::path(testing::TempDir()) / ("image_test_" + std::to_string(::getpid()) + ".png");
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  struct Remove {
    std::filesystem::path file;
    ~Remove() { std::filesystem::remove(file); }
  } remove{file};
  return files::read_png(file.string());
}

TEST(PngImage, GreyOfAllDepths) {
  const files::Image eight = read_bytes(PngFile(3, 2, 8, 0).finish({{0, 100, 255}, {1, 2, 3}}));
  EXPECT_EQ(eight.width, 3);
  EXPECT_EQ(eight.height, 2);
  EXPECT_THAT(eight.labels, testing::ElementsAre(0, 100, 255, 1, 2, 3));
  EXPECT_THAT(read_bytes(PngFile(2, 1, 16, 0).finish({{0x12, 0x34, 0xff, 0xfe}})).labels,
              testing::ElementsAre(0x1234, 0xfffe));
  EXPECT_THAT(read_bytes(PngFile(4, 1, 1, 0).finish({{0b01100000}})).labels, testing::ElementsAre(0, 255, 255, 0));
  EXPECT_THAT(read_bytes(PngFile(2, 1, 8, 4).finish({{9, 0, 200, 255}})).labels, testing::ElementsAre(9, 200));
}

TEST(PngImage, ColoursBecomeGrey) {
  // 0.299 * 255 = 76.245, 0.587 * 255 = 149.685, 0.114 * 255 = 29.07
  EXPECT_THAT(read_bytes(PngFile(4, 1, 8, 2).finish({{255, 0, 0, 0, 255, 0, 0, 0, 255, 77, 77, 77}})).labels,
              testing::ElementsAre(76, 150, 29, 77));
  PngFile palette(3, 1, 8, 3);
  palette.chunk("PLTE", {10, 10, 10, 255, 255, 255, 255, 0, 0});
  EXPECT_THAT(palette.finish({{2, 1, 0}}).size(), testing::Gt(60u));
  EXPECT_THAT(read_bytes(palette.bytes).labels, testing::ElementsAre(76, 255, 10));
}

TEST(PngImage, BrokenFilesAreRefusedWithTheirName) {
  const auto message_of = [](const std::vector<std::uint8_t>& bytes) -> std::string {
    try {
      read_bytes(bytes);
    } catch (const InputError& error) {
      EXPECT_THAT(error.file(), testing::EndsWith(".png"));
      return error.diagnostics().front().message;
    }
    return "no error";
  };
  EXPECT_THROW(files::read_png("/nowhere/at/all.png"), InputError);
  EXPECT_EQ(message_of({}), "the image cannot be read: it is not a PNG file");
  EXPECT_EQ(message_of({'B', 'M', 1, 2, 3, 4, 5, 6, 7, 8, 9}), "the image cannot be read: it is not a PNG file");
  EXPECT_THAT(message_of(PngFile(1 << 19, 1 << 19, 8, 0).finish({{1}})), testing::HasSubstr("more than 2^28 pixels"));
  EXPECT_THAT(message_of(PngFile(0, 3, 8, 0).finish({{1}})), testing::HasSubstr("cannot be read"));
  const std::vector<std::uint8_t> good = PngFile(3, 2, 8, 0).finish({{0, 100, 255}, {1, 2, 3}});
  // Cut off anywhere before its data end, and with every byte of its beginning changed: refused or read, never a crash.
  for (std::size_t length = 0; length < good.size() - 20; ++length) {
    EXPECT_NE(message_of({good.begin(), good.begin() + std::ptrdiff_t(length)}), "no error") << length;
  }
  for (std::size_t place = 0; place < good.size(); ++place) {
    for (int flip : {0x01, 0x80, 0xff}) {
      std::vector<std::uint8_t> bytes = good;
      bytes[place] = std::uint8_t(bytes[place] ^ flip);
      message_of(bytes);
    }
  }
}

}  // namespace
}  // namespace scabo::mesh
