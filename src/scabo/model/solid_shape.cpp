#include "scabo/model/solid_shape.hpp"

namespace scabo::model {

namespace {

struct Names {
  std::vector<std::string> operator()(const SolidBox&) const {
    return {"left", "right", "front", "back", "bottom", "top"};
  }
  std::vector<std::string> operator()(const SolidCylinder&) const { return {"bottom", "top", "side"}; }
  std::vector<std::string> operator()(const SolidTube&) const { return {"bottom", "top", "inside", "outside"}; }
  std::vector<std::string> operator()(const SolidSphere& sphere) const {
    std::vector<std::string> names{"surface"};
    for (std::size_t k = 0; k < 3; ++k)
      if (sphere.kept[k] != 0) names.push_back(std::string("cut_") + "xyz"[k]);
    return names;
  }
  std::vector<std::string> operator()(const SolidExtrusion& extrusion) const {
    std::vector<std::string> names{"start", "end"};
    for (const geometry::Edge& edge : extrusion.outline.edges)
      names.insert(names.end(), edge.names.begin(), edge.names.end());
    return names;
  }
};

}  // namespace

bool has_hexahedra(const SolidShape& shape) {
  return std::holds_alternative<SolidBox>(shape) || std::holds_alternative<SolidTube>(shape) ||
         std::holds_alternative<SolidExtrusion>(shape);
}

std::vector<std::string> face_names(const SolidShape& shape) { return std::visit(Names{}, shape); }

}  // namespace scabo::model
