// Where something acts on bodies in space: faces as facets, edges, points and sets of nodes.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "scabo/analysis/space/face_resultants.hpp"
#include "scabo/base/error.hpp"
#include "scabo/mesh/space/shaped_solid.hpp"
#include "scabo/model/solid_model.hpp"

namespace scabo::analysis {

/// Mistakes of geometry are added to `mistakes`; the place is then empty. All arguments outlive it.
class SolidPlaces {
 public:
  SolidPlaces(const model::SpaceModel& model, const std::vector<SolidBody>& bodies, std::vector<Diagnostic>& mistakes)
      : model_(model), bodies_(bodies), mistakes_(mistakes) {}

  /// The next of `bodies`, with the faces of its shape.
  void add_body(const SolidBody& body, std::map<std::string, std::vector<mesh::SolidFacet>> of_shape);

  std::vector<mesh::SolidFacet> facets(const model::SpaceFace& face);
  /// Of a set of nodes those whose nodes are all in it, maybe none.
  std::vector<mesh::SolidEdge> edges(const model::SpaceFace& edge);
  /// Of a set of nodes those sides whose corners are all in it, maybe none.
  std::vector<mesh::SolidFacet> facets_of_set(const model::SpaceFace& set) const;
  const std::vector<int>& set_of_nodes(const model::SpaceFace& at) const;
  /// A point, or all of a set.
  std::vector<int> single_nodes(const model::SpaceFace& at);
  /// Of a face, an edge or a point, or of a set of nodes with the sides whose corners it has.
  std::set<int> held_nodes(const model::SpaceFace& at);
  SolidPlaceOfAction place_of_action(const model::SpaceFace& on);

 private:
  std::vector<mesh::SolidFacet> named_facets(const model::SpaceFace& face) const;
  const std::vector<mesh::SolidFacet>& boundary(const model::SpaceFace& at) const {
    return boundaries_[static_cast<std::size_t>(at.body)];
  }
  const mesh::SolidMesh& mesh_of(const model::SpaceFace& at) const {
    return bodies_[static_cast<std::size_t>(at.body)].mesh;
  }
  const files::ImportedSolidMesh& file_of(const model::SpaceFace& at) const {
    return *model_.bodies[static_cast<std::size_t>(at.body)].mesh;
  }
  void refuse(const model::SpaceFace& at, const std::string& why) {
    mistakes_.push_back({at.source, "'" + at.text + "' " + why});
  }

  const model::SpaceModel& model_;
  const std::vector<SolidBody>& bodies_;
  std::vector<Diagnostic>& mistakes_;
  std::vector<std::vector<mesh::SolidFacet>> boundaries_;                        // of each body
  std::vector<std::map<std::string, std::vector<mesh::SolidFacet>>> of_shapes_;  // faces of each body with a shape
};

}  // namespace scabo::analysis
