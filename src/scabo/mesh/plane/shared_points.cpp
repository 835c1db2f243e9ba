#include "scabo/mesh/plane/shared_points.hpp"

#include <map>
#include <utility>
#include <vector>

#include "scabo/mesh/plane/interface.hpp"

namespace scabo::mesh {

namespace {

constexpr double smooth_cosine = 0.9;

/// One end of a contact, seen from a body that it touches.
struct End {
  std::size_t interface = 0, pair = 0;
  double sign = 1.0;  ///< of the normal of the pair, out of this body
};

bool has_chain(const model::Model& model, const model::Contact& contact) {
  const auto is_chain = [&](const model::Place& place) {
    return place.kind == model::Place::Kind::edge && model.bodies[static_cast<std::size_t>(place.body)]
                                                         .outline.edges[static_cast<std::size_t>(place.index)]
                                                         .is_chain();
  };
  return is_chain(contact.a) || is_chain(contact.b);
}

void set_normal(ContactPair& pair, const Vec2& normal, double added) {
  pair.normal = normal;
  std::vector<ContactPair> alone{pair};
  set_gaps(alone, added);
  pair.gap = alone.front().gap;
}

}  // namespace

std::vector<bool> joined_to_others(const model::Model& model) {
  std::vector<bool> joined(model.bodies.size(), false);
  const auto join = [&](const auto& joint) {
    for (const int body : {joint.a.body, joint.b.body}) joined[static_cast<std::size_t>(body)] = true;
  };
  for (const model::Tie& tie : model.ties) join(tie);
  for (const model::Contact& contact : model.contacts)
    if (contact.bond) join(contact);
  return joined;
}

void share_normals(const model::Model& model, Mesh& mesh) {
  std::map<std::pair<int, int>, std::vector<End>> ends;  // by body and node
  for (std::size_t i = 0; i < mesh.interfaces.size(); ++i) {
    const Interface& interface = mesh.interfaces[i];
    const model::Contact& contact = model.contacts[static_cast<std::size_t>(interface.contact)];
    if (contact.bond || interface.pairs.size() < 2 || !has_chain(model, contact)) continue;
    for (const std::size_t pair : {std::size_t{0}, interface.pairs.size() - 1}) {
      if (const int node = interface.pairs[pair].node_a; node >= 0)
        ends[{contact.a.body, node}].push_back({i, pair, 1.0});
      if (const int node = interface.pairs[pair].node_b; node >= 0)
        ends[{contact.b.body, node}].push_back({i, pair, -1.0});
    }
  }
  const std::vector<bool> joined = joined_to_others(model);
  for (const auto& [point, meeting] : ends) {
    if (meeting.size() != 2 || meeting[0].interface == meeting[1].interface) continue;
    const auto pair_of = [&](const End& end) -> ContactPair& { return mesh.interfaces[end.interface].pairs[end.pair]; };
    const auto contact_of = [&](const End& end) -> const model::Contact& {
      return model.contacts[static_cast<std::size_t>(mesh.interfaces[end.interface].contact)];
    };
    const Vec2 first = meeting[0].sign * pair_of(meeting[0]).normal,
               second = meeting[1].sign * pair_of(meeting[1]).normal;
    if (first == second || first.dot(second) < smooth_cosine) continue;
    const auto felt = [&](const End& end) { return feels_two_normals(joined, contact_of(end), pair_of(end).gap); };
    if (!felt(meeting[0]) && !felt(meeting[1])) continue;
    const Vec2 mean = (first + second).normalized();
    for (const End& end : meeting) set_normal(pair_of(end), end.sign * mean, contact_of(end).gap);
  }
}

}  // namespace scabo::mesh
