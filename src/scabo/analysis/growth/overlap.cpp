#include "scabo/analysis/growth/overlap.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/base/components.hpp"
#include "scabo/mesh/plane/crack_faces.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::analysis {

std::string overlap(const Prepared& prepared, const FieldState& fields) {
  constexpr double rounding = 1e-6;  // of the largest opening of the crack
  for (std::size_t b = 0; b < prepared.model.bodies.size(); ++b) {
    const model::Body& body = prepared.model.bodies[b];
    const Vector& u = fields.displacements[b];
    const std::vector<int> touching = mesh::cracks_in_contact(prepared.model, static_cast<int>(b));
    for (std::size_t c = 0; c < body.cracks.size(); ++c) {
      if (std::find(touching.begin(), touching.end(), static_cast<int>(c)) != touching.end()) continue;
      double widest = 0.0, least = 0.0;
      Vec2 where = Vec2::Zero();
      for (const mesh::FacePair& pair : mesh::face_pairs(prepared.mesh.bodies[b], static_cast<int>(c))) {
        const Vec2 apart = u.segment<2>(place_of(pair.right)) - u.segment<2>(place_of(pair.left));
        const double opening = apart.dot(pair.normal.normalized());
        widest = std::max(widest, apart.norm());
        if (opening < least) {
          least = opening;
          where = prepared.mesh.bodies[b].nodes[static_cast<std::size_t>(pair.left)];
        }
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
