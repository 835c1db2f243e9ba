// One small mesh in every format. Linear: a square [0, 1] x [0, 1] (region_1), two triangles on [1, 2] x [0, 1]
// (region_2).
//
//   4 ---- 5 ---- 6      boundary_3: the sides 1 2 and 2 3; points_4: node 6
//   |      |  / |
//   1 ---- 2 ---- 3
//
// Quadratic: the same with middle nodes; that of side 4 1 bulges by 0.15, which adds 2/3 * 0.15 to the area.
#pragma once

#include <string>
#include <vector>

namespace sample {

struct Cell {
  int gmsh, vtk, tag;
  std::vector<int> nodes;
};
struct Mesh {
  std::vector<std::vector<double>> nodes;  // x, y, z; numbers from 1
  std::vector<Cell> cells;                 // of all dimensions
};

Mesh linear();
Mesh quadratic();

std::string msh22(const Mesh& mesh, bool binary);
std::string msh41(const Mesh& mesh, bool binary);
std::string inp(const Mesh& mesh);
enum class Vtu { text, base64, base64_zlib, raw, raw_zlib, appended_base64 };
std::string vtu(const Mesh& mesh, Vtu form, bool wide_header = false);

/// `text` with the first `from` replaced; fails loudly if there is none.
std::string replaced(std::string text, const std::string& from, const std::string& to);

// The linear mesh, written by hand.
extern const char* const msh22_by_hand;
extern const char* const msh41_by_hand;
extern const char* const inp_by_hand;
extern const char* const vtu_by_hand;

}  // namespace sample
