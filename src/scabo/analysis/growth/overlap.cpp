#include "scabo/analysis/growth/overlap.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/base/components.hpp"
#include "scabo/mesh/plane/crack_faces.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::analysis {

namespace {

/// Opposite nodes of the faces of a crack under these displacements.
struct Apart {
  Vec2 at = Vec2::Zero();  ///< undeformed
  double opening = 0.0;    ///< along the normal
  double distance = 0.0;
};
std::vector<Apart> apart(const Prepared& prepared, const FieldState& fields, std::size_t body, int crack) {
  const mesh::BodyMesh& mesh = prepared.mesh.bodies[body];
  const Vector& u = fields.displacements[body];
  std::vector<Apart> found;
  for (const mesh::FacePair& pair : mesh::face_pairs(mesh, crack)) {
    const Vec2 moved = u.segment<2>(place_of(pair.right)) - u.segment<2>(place_of(pair.left));
    found.push_back(
        {mesh.nodes[static_cast<std::size_t>(pair.left)], moved.dot(pair.normal.normalized()), moved.norm()});
  }
  return found;
}

}  // namespace

double largest_opening(const Prepared& prepared, const FieldState& fields, int body, int crack) {
  double widest = 0.0;
  for (const Apart& pair : apart(prepared, fields, static_cast<std::size_t>(body), crack))
    widest = std::max(widest, pair.opening);
  return widest;
}

std::string overlap(const Prepared& prepared, const FieldState& fields) {
  constexpr double rounding = 1e-6;  // of the largest opening of the crack
  for (std::size_t b = 0; b < prepared.model.bodies.size(); ++b) {
    const model::Body& body = prepared.model.bodies[b];
    const std::vector<int> touching = mesh::cracks_in_contact(prepared.model, static_cast<int>(b));
    for (std::size_t c = 0; c < body.cracks.size(); ++c) {
      if (std::find(touching.begin(), touching.end(), static_cast<int>(c)) != touching.end()) continue;
      double widest = 0.0, least = 0.0;
      Vec2 where = Vec2::Zero();
      for (const Apart& pair : apart(prepared, fields, b, static_cast<int>(c))) {
        widest = std::max(widest, pair.distance);
        if (pair.opening >= least) continue;
        least = pair.opening;
        where = pair.at;
      }
      if (least < -rounding * widest)
        return fmt::format(
            "the faces of crack '{0}.{1}' overlap by {2:.3g} near {3}: give a contact between '{0}.{1}.left' and "
            "'{0}.{1}.right', so that they touch",
            body.name, body.cracks[c].name, -least, model::point_text(where));
    }
  }
  return {};
}

}  // namespace scabo::analysis
