#include "scabo/result/solid/solid_faces.hpp"

#include <array>
#include <map>

namespace scabo::result {

namespace {

constexpr std::uint8_t vtk_triangle = 5, vtk_quad = 9;

void add(const Eigen::Vector3d& vector, std::vector<double>& values) {
  values.insert(values.end(), vector.data(), vector.data() + 3);
}

void add_point(const mesh::SolidMesh& mesh, const analysis::SolidPair& pair, std::int32_t number, SolidFaces& faces) {
  const double N = pair.normal_force();
  add(mesh.nodes.col(pair.corner), faces.points);
  faces.contact.push_back(pair.contact + 1);
  faces.pair.push_back(number);
  faces.state.push_back(static_cast<std::uint8_t>(pair.state));
  faces.pressure.push_back(N / pair.area);
  faces.gap.push_back(pair.gap);
  add((pair.force - N * pair.normal) / pair.area, faces.shear);
  add(pair.slip, faces.slip);
  add(pair.normal, faces.normal);
}

}  // namespace

SolidFaces solid_faces(const analysis::SolidModel& model, const analysis::SolidIncrement& increment) {
  SolidFaces faces;
  std::vector<std::map<int, std::int32_t>> point_of(model.contacts.size());  // of the corners of each contact
  std::vector<const analysis::SolidContact::Side*> sides(model.contacts.size());
  for (const analysis::SolidPair& pair : increment.pairs) {
    const auto c = static_cast<std::size_t>(pair.contact);
    sides[c] = pair.on_a ? &model.contacts[c].a : &model.contacts[c].b;
    const auto number = static_cast<std::int32_t>(point_of[c].size() + 1);
    point_of[c][pair.corner] = static_cast<std::int32_t>(faces.pair.size());
    add_point(model.bodies[static_cast<std::size_t>(sides[c]->body)].mesh, pair, number, faces);
  }
  for (std::size_t c = 0; c < sides.size(); ++c) {
    if (sides[c] == nullptr) continue;
    for (const mesh::SolidFacet& facet : sides[c]->facets) {
      const std::size_t corners = mesh::corners_of(facet);
      std::array<std::int32_t, 4> points{};
      bool whole = true;
      for (std::size_t k = 0; k < corners; ++k) {
        const auto found = point_of[c].find(facet[k]);
        whole = whole && found != point_of[c].end();
        if (whole) points[k] = found->second;
      }
      if (!whole) continue;
      faces.connectivity.insert(faces.connectivity.end(), points.begin(),
                                points.begin() + static_cast<std::ptrdiff_t>(corners));
      faces.offsets.push_back(static_cast<std::int32_t>(faces.connectivity.size()));
      faces.types.push_back(corners == 3 ? vtk_triangle : vtk_quad);
      faces.cell_contact.push_back(static_cast<std::int32_t>(c + 1));
    }
  }
  return faces;
}

}  // namespace scabo::result
