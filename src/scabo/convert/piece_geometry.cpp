#include "scabo/convert/piece_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace scabo::convert {

using files::Facet;
using files::ImportedMesh;

namespace {

/// Smallest distance of a point from the chords of the sides of a piece.
double distance(const ImportedMesh& mesh, const Vec2& x, const DeckPiece& piece) {
  double least = HUGE_VAL;
  for (const Facet& side : piece.sides) {
    const Vec2 &a = mesh.nodes[static_cast<std::size_t>(side.start)],
               &b = mesh.nodes[static_cast<std::size_t>(side.end)];
    const Vec2 along = b - a;
    const double s = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (x - a - s * along).norm());
  }
  return least;
}

}  // namespace

double length_of(const ImportedMesh& mesh, const DeckPiece& piece) {
  double length = 0.0;
  for (const Facet& side : piece.sides) length += files::length_of(mesh, side);
  return length;
}

double least_distance(const ImportedMesh& mesh, const DeckPiece& of, const DeckPiece& from) {
  double least = HUGE_VAL;
  for (const Facet& side : of.sides)
    for (const int node : {side.start, side.end})
      least = std::min(least, distance(mesh, mesh.nodes[static_cast<std::size_t>(node)], from));
  return least;
}

bool are_opposite(const ImportedMesh& mesh, const DeckPiece& of, const DeckPiece& to) {
  for (const Facet& side : of.sides)
    for (const Facet& other : to.sides) {
      const Vec2 &a = mesh.nodes[static_cast<std::size_t>(other.start)],
                 &b = mesh.nodes[static_cast<std::size_t>(other.end)];
      const Vec2 &c = mesh.nodes[static_cast<std::size_t>(side.start)],
                 &d = mesh.nodes[static_cast<std::size_t>(side.end)];
      const Vec2 along = b - a, middle = 0.5 * (c + d) - a;
      const double s = middle.dot(along) / along.squaredNorm();
      if (s >= 0.0 && s <= 1.0 && (d - c).dot(along) < 0.0) return true;
    }
  return false;
}

}  // namespace scabo::convert
