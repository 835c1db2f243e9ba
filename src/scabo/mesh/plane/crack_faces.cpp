#include "scabo/mesh/plane/crack_faces.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/mesh/plane/node_matching.hpp"
#include "scabo/mesh/plane/replace_elements.hpp"

namespace scabo::mesh {

namespace {

const std::vector<LineElement>& elements_of_face(const BodyMesh& mesh, int crack, bool left) {
  return mesh.faces.at(static_cast<std::size_t>(2 * crack + (left ? 1 : 0)));
}

/// Parts of an element that ends at the points of `like`, in its direction; inner nodes are new.
std::vector<LineElement> parts_like(const LineElement& element, const std::vector<LineElement>& like, BodyMesh& mesh) {
  std::vector<LineElement> parts;
  int from = element.nodes.front();
  for (std::size_t k = 0; k < like.size(); ++k) {
    LineElement& part = parts.emplace_back();
    part.nodes.push_back(from);
    const std::size_t inner = like[k].nodes.size() - (k + 1 < like.size() ? 1 : 2);
    for (std::size_t i = 1; i <= inner; ++i) {
      part.nodes.push_back(static_cast<int>(mesh.nodes.size()));
      const Vec2 x = mesh.nodes[static_cast<std::size_t>(like[k].nodes[i])];
      mesh.nodes.push_back(x);
    }
    if (k + 1 == like.size()) part.nodes.push_back(element.nodes.back());
    from = part.nodes.back();
  }
  return parts;
}

LineElement against(const LineElement& element) { return {{element.nodes.rbegin(), element.nodes.rend()}}; }

}  // namespace

std::vector<FacePair> face_pairs(const BodyMesh& mesh, int crack) {
  const std::vector<LineElement>&left = elements_of_face(mesh, crack, true),
        &right = elements_of_face(mesh, crack, false);
  ensure(left.size() == right.size(), "the two faces of a crack have the same elements");
  std::vector<FacePair> pairs;
  for (std::size_t k = 0; k < left.size(); ++k) {
    const std::vector<int>&here = left[k].nodes, &there = right[right.size() - 1 - k].nodes;
    ensure(here.size() == there.size(), "opposite elements of a crack have the same order");
    const geometry::LineBasis& basis = geometry::LineBasis::of_order(static_cast<int>(here.size()) - 1);
    for (std::size_t i = 0; i < here.size(); ++i) {
      Vec2 along = Vec2::Zero();
      for (std::size_t j = 0; j < here.size(); ++j)
        along += basis.derivatives_at_nodes()(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) *
                 mesh.nodes[static_cast<std::size_t>(here[j])];
      const FacePair pair{here[i], there[there.size() - 1 - i], basis.weights()[i] * tangent_of(along)};
      if (!pairs.empty() && pairs.back().left == pair.left && pairs.back().right == pair.right)
        pairs.back().normal += pair.normal;
      else
        pairs.push_back(pair);
    }
  }
  std::erase_if(pairs, [](const FacePair& pair) { return pair.left == pair.right; });
  return pairs;
}

Interface crack_interface(const model::Model& model, int contact, const std::vector<BodyMesh>& bodies) {
  const model::Contact& named = model.contacts[static_cast<std::size_t>(contact)];
  const BodyMesh& mesh = bodies[static_cast<std::size_t>(named.a.body)];
  const bool left_is_a = named.a.index % 2 == 1;
  Interface interface;
  interface.contact = contact;
  for (const FacePair& pair : face_pairs(mesh, named.a.index / 2)) {
    ContactPair& made = interface.pairs.emplace_back();
    made.node_a = left_is_a ? pair.left : pair.right;
    made.node_b = left_is_a ? pair.right : pair.left;
    made.point_a = made.point_b = mesh.nodes[static_cast<std::size_t>(pair.left)];
    made.normal = (left_is_a ? 1.0 : -1.0) * pair.normal.normalized();
    made.gap = named.gap;
  }
  if (!interface.pairs.empty() && runs_backwards(interface.pairs.front().point_a, interface.pairs.back().point_a))
    std::reverse(interface.pairs.begin(), interface.pairs.end());
  return interface;
}

std::vector<TipFace> tip_faces(const model::Body& body, const BodyMesh& mesh) {
  if (body.open() && !mesh.faces.empty()) return {{0, 0, true, false, false}, {0, 0, true, true, true}};
  std::vector<TipFace> faces;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Cell& cell = mesh.cells[c];
    if (cell.kind != CellKind::superelement || !cell.is_open()) continue;
    for (std::size_t k = 0; k < body.cracks.size(); ++k) {
      const std::vector<Vec2>& path = body.cracks[k].path;
      for (const bool at_end : {false, true}) {
        if (path.empty() || cell.centre != (at_end ? path.back() : path.front())) continue;
        // The boundary runs counter-clockwise around the tip: into the tip, its end lies on the left of the crack.
        for (const bool last : {false, true}) faces.push_back({c, static_cast<int>(k), at_end, last, last == at_end});
      }
    }
  }
  return faces;
}

void divide_faces_alike(BodyMesh& mesh, const std::vector<int>& cracks) {
  for (const int crack : cracks) {
    const std::vector<LineElement> left = elements_of_face(mesh, crack, true),
                                   right = elements_of_face(mesh, crack, false);
    std::vector<LineElement> facing;  // those of the right face in the direction of the left one
    for (auto element = right.rbegin(); element != right.rend(); ++element) facing.push_back(against(*element));
    const auto end_of = [&](const LineElement& element) {
      return mesh.nodes[static_cast<std::size_t>(element.nodes.back())];
    };
    const auto size_of = [&](const LineElement& element) {
      return (end_of(element) - mesh.nodes[static_cast<std::size_t>(element.nodes.front())]).norm();
    };
    Replacements replacements;
    for (std::size_t i = 0, j = 0; i < left.size() && j < facing.size(); ++i, ++j) {
      std::vector<LineElement> of_left{left[i]}, of_right{facing[j]};
      for (;;) {
        const Vec2 apart = end_of(of_right.back()) - end_of(of_left.back());
        const double shorter = std::min(size_of(of_left.back()), size_of(of_right.back()));
        if (apart.norm() <= matching_tolerance * shorter) break;
        const Vec2 along = end_of(of_left.back()) - mesh.nodes[static_cast<std::size_t>(of_left.front().nodes.front())];
        const bool left_is_behind = apart.dot(along) > 0.0;
        if (left_is_behind ? i + 1 == left.size() : j + 1 == facing.size()) break;
        if (left_is_behind)
          of_left.push_back(left[++i]);
        else
          of_right.push_back(facing[++j]);
      }
      if (of_left.size() == 1 && of_right.size() > 1)
        replacements[of_left.front().nodes] = parts_like(of_left.front(), of_right, mesh);
      if (of_right.size() == 1 && of_left.size() > 1)
        replacements[of_right.front().nodes] = parts_like(of_right.front(), of_left, mesh);
    }
    if (!replacements.empty()) replace_elements(mesh, replacements);
  }
}

std::vector<int> cracks_in_contact(const model::Model& model, int body) {
  std::set<int> cracks;
  for (const model::Contact& contact : model.contacts)
    if (contact.a.body == body && contact.a.kind == model::Place::Kind::face) cracks.insert(contact.a.index / 2);
  return {cracks.begin(), cracks.end()};
}

std::vector<int> growing_cracks(const model::Model& model, int body) {
  if (!model::has_growth(model)) return {};
  const std::vector<model::GrowingCrack>& named = model.steps.back().growth->cracks;
  std::vector<int> cracks;
  for (int crack = 0; crack < static_cast<int>(model.bodies[static_cast<std::size_t>(body)].cracks.size()); ++crack)
    if (named.empty() || std::any_of(named.begin(), named.end(), [&](const model::GrowingCrack& one) {
          return one.body == body && one.crack == crack;
        }))
      cracks.push_back(crack);
  return cracks;
}

std::vector<int> cracks_held(const model::Model& model, int body) {
  std::set<int> cracks;
  for (const model::Support& support : model.supports)
    if (support.on.body == body && support.on.kind == model::Place::Kind::face) cracks.insert(support.on.index / 2);
  return {cracks.begin(), cracks.end()};
}

std::vector<int> cracks_with_tractions(const model::Model& model, int body) {
  std::set<int> cracks;
  for (const std::vector<int>& some : {cracks_in_contact(model, body), cracks_held(model, body)})
    cracks.insert(some.begin(), some.end());
  for (const model::Spring& spring : model.springs)
    if (spring.on.body == body && spring.on.kind == model::Place::Kind::face) cracks.insert(spring.on.index / 2);
  return {cracks.begin(), cracks.end()};
}

std::map<int, Vec2> normals_of_face(const BodyMesh& mesh, int face) {
  std::map<int, Vec2> normals;  // integrals of N ds n
  for (const LineElement& element : mesh.faces.at(static_cast<std::size_t>(face))) {
    const auto count = static_cast<Eigen::Index>(element.nodes.size());
    const geometry::LineBasis& basis = geometry::LineBasis::of_order(static_cast<int>(count) - 1);
    for (Eigen::Index i = 0; i < count; ++i) {
      Vec2 along = Vec2::Zero();
      for (Eigen::Index j = 0; j < count; ++j)
        along += basis.derivatives_at_nodes()(i, j) *
                 mesh.nodes[static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(j)])];
      Vec2& sum = normals.emplace(element.nodes[static_cast<std::size_t>(i)], Vec2::Zero()).first->second;
      sum += basis.weights()[static_cast<std::size_t>(i)] * tangent_of(along);
    }
  }
  for (auto& [node, normal] : normals) normal.normalize();
  return normals;
}

}  // namespace scabo::mesh
