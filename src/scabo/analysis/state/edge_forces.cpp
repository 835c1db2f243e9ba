#include "scabo/analysis/state/edge_forces.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "scabo/base/components.hpp"
#include "scabo/element/plane/elasticity.hpp"
#include "scabo/element/plane/finite_element.hpp"
#include "scabo/system/pore_pressure.hpp"

namespace scabo::analysis {

namespace {

/// The sum (1) of one edge.
class SumOverEdge {
 public:
  SumOverEdge(const Prepared& prepared, const State& state, const model::EdgeResultant& edge)
      : prepared_(prepared), state_(state), edge_(edge), body_(prepared.mesh.bodies[body_index()]) {
    for (const int node : mesh::nodes_of(edge.on, prepared.mesh).nodes)
      number_in_part_[prepared.structure.dofs.node_in_part(edge.on.body, node)] = node;
    on_edge_.assign(body_.nodes.size(), false);
    for (const auto& [in_part, node] : number_in_part_) on_edge_[static_cast<std::size_t>(node)] = true;
    find_other_ties();
  }

  void add_stiffness() {
    const system::Dofs& dofs = prepared_.structure.dofs;
    const Vector u = dofs.of_body(edge_.on.body, state_.u[dofs.part_of(edge_.on.body)]);
    for (std::size_t c = 0; c < body_.cells.size(); ++c) {
      const mesh::Cell& cell = body_.cells[c];
      const auto has_node = [&](const mesh::LineElement& element) {
        return std::any_of(element.nodes.begin(), element.nodes.end(),
                           [&](int node) { return on_edge_[static_cast<std::size_t>(node)]; });
      };
      if (std::none_of(cell.boundary.begin(), cell.boundary.end(), has_node)) continue;
      if (const auto& super_element = prepared_.discretisation.cells[body_index()][c]) {
        add_cell(element::dofs_of(cell), super_element->K(), u);
        continue;
      }
      const element::FiniteElement finite = element::finite_element_of(cell, body_.nodes);
      const model::Material& material = prepared_.model.materials[static_cast<std::size_t>(cell.materials.front())];
      const element::SectionLaw law = element::section_law(material, prepared_.model.analysis.plane);
      add_cell(element::dofs_of(finite),
               element::finite_element_stiffness(finite, law, model::extent_of(prepared_.model, edge_.on.body)), u);
    }
  }

  void apply_loads() {
    const double presence = presence_of(prepared_, state_.factors, prepared_.structure.dofs.part_of(edge_.on.body));
    for (std::size_t l = 0; l < prepared_.model.loads.size(); ++l) {
      const model::Load& load = prepared_.model.loads[l];
      const double factor = presence * state_.factors.loads[l];
      if (const auto* pores = std::get_if<model::PorePressure>(&load.kind))
        for (const int contact : pores->contacts) apply_pores(*pores, contact, factor);
      const Vector& forces = prepared_.structure.of_bodies[l][body_index()];
      if (forces.size() == 0) continue;
      const bool elsewhere = !load.on || is_elsewhere(*load.on);
      for (const auto& [in_part, node] : number_in_part_)
        apply(elsewhere, node, factor * forces.segment<2>(place_of(node)));
      if (edge_.on.kind == model::Place::Kind::face && !elsewhere) add_from_within(factor * forces);
    }
  }

  void apply_contacts() {
    for (std::size_t i = 0; i < prepared_.contact.pairs.size(); ++i) {
      const system::ContactSystem::Pair& at = prepared_.contact.pairs[i];
      if (at.is_bar()) continue;
      const mesh::ContactPair& pair =
          prepared_.mesh.interfaces[static_cast<std::size_t>(at.contact)].pairs[static_cast<std::size_t>(at.index)];
      const auto k = static_cast<Eigen::Index>(i);
      apply_pair(at.contact, pair, state_.p[2 * k] * pair.normal + state_.p[2 * k + 1] * tangent_of(pair.normal));
    }
  }

  void apply_reactions() {
    const std::size_t part = prepared_.structure.dofs.part_of(edge_.on.body);
    const std::vector<system::Constraint>& constraints = prepared_.structure.parts[part]->constraints();
    for (std::size_t c = 0; c < constraints.size(); ++c) {
      const model::Place& on = prepared_.model.supports[static_cast<std::size_t>(constraints[c].support)].on;
      const auto found = number_in_part_.find(plane_components.node_of(constraints[c].dof));
      if (on.body != edge_.on.body || found == number_in_part_.end()) continue;
      apply(is_elsewhere(on), found->second,
            state_.reactions[part][static_cast<Eigen::Index>(c)] * constraints[c].direction());
    }
    for (std::size_t i = 0; i < prepared_.contact.pairs.size(); ++i) {
      const system::ContactSystem::Pair& at = prepared_.contact.pairs[i];
      if (!is_held_point(prepared_, at)) continue;
      const system::Constraint& held = *prepared_.structure.bars[static_cast<std::size_t>(at.index)].held;
      const model::Place& on = prepared_.model.supports[static_cast<std::size_t>(held.support)].on;
      if (on.body != edge_.on.body) continue;
      if (const auto found = number_in_part_.find(plane_components.node_of(held.dof)); found != number_in_part_.end())
        apply(is_elsewhere(on), found->second, state_.p[place_of(i)] * held.direction());
    }
  }

  void apply_springs() {
    const std::size_t part = prepared_.structure.dofs.part_of(edge_.on.body);
    for (std::size_t s = 0; s < prepared_.model.springs.size(); ++s) {
      const model::Place& on = prepared_.model.springs[s].on;
      if (on.body != edge_.on.body) continue;
      const Vector against = prepared_.structure.springs.of_spring[s] * state_.u[part];
      for (const auto& [in_part, node] : number_in_part_)
        apply(is_elsewhere(on), node, -against.segment<2>(place_of(in_part)));
    }
  }

  void apply_bars() {
    const std::vector<double> tensions = tensions_of(prepared_, state_);
    for (std::size_t b = 0; b < tensions.size(); ++b) {
      const system::BarSystem& bar = prepared_.structure.bars[b];
      for (const std::size_t end : {0, 1}) {
        const auto& on = prepared_.model.bars[b].between[end].on;
        if (!on || on->body != edge_.on.body) continue;
        const Vec2 force = (end == 0 ? tensions[b] : -tensions[b]) * bar.direction;
        for (const system::PairSide::Node& node : (end == 0 ? bar.a : bar.b).nodes)
          if (const auto found = number_in_part_.find(node.node); found != number_in_part_.end())
            apply(is_elsewhere(*on), found->second, node.weight * force);
      }
    }
  }

  /// What bodies and supports that are being taken away still exert (stages.hpp). Where two of them, on two edges,
  /// pressed on one corner, each edge has half of it.
  void apply_released() {
    const std::size_t part = prepared_.structure.dofs.part_of(edge_.on.body);
    if (state_.released.empty() || state_.released[part].size() == 0) return;
    const Vector forces = state_.factors.release * state_.released[part];
    std::map<int, std::array<int, 2>> contacts_at;  // number of them through this edge, and elsewhere
    for (std::size_t c = 0; c < prepared_.model.contacts.size(); ++c) {
      const model::Contact& contact = prepared_.model.contacts[c];
      const bool of_a = contact.a.body == edge_.on.body, of_b = contact.b.body == edge_.on.body;
      if (of_a == of_b || !is_leaving(of_a ? contact.b.body : contact.a.body)) continue;
      const int elsewhere = is_elsewhere(of_a ? contact.a : contact.b) ? 1 : 0;
      std::set<int> nodes;
      for (const mesh::ContactPair& pair : prepared_.mesh.interfaces[c].pairs)
        nodes.insert(of_a ? pair.node_a : pair.node_b);
      for (const int node : nodes) ++contacts_at[node][static_cast<std::size_t>(elsewhere)];
    }
    for (std::size_t i = 0; 3 * i < state_.released_reactions.size(); ++i) {
      const model::Support& support = prepared_.model.supports[i];
      if (support.on.body != edge_.on.body || !is_leaving(support)) continue;
      for (const int node : mesh::nodes_of(support.on, prepared_.mesh).nodes)
        ++contacts_at[node][is_elsewhere(support.on) ? 1 : 0];
    }
    for (const auto& [in_part, node] : number_in_part_) {
      const auto [here, elsewhere] = contacts_at[node];
      for (const bool is_other : {false, true}) {
        const int share = is_other ? elsewhere : here;
        if (share > 0) apply(is_other, node, forces.segment<2>(place_of(in_part)) * share / (here + elsewhere));
      }
    }
  }

  const EdgeForces& sum() const { return sum_; }

 private:
  std::size_t body_index() const { return static_cast<std::size_t>(edge_.on.body); }

  /// A place of the same body whose forces do not act through the edge.
  bool is_elsewhere(const model::Place& place) const {
    using Kind = model::Place::Kind;
    if (place.kind == Kind::edge || place.kind == Kind::face)
      return place.kind != edge_.on.kind || place.index != edge_.on.index;
    return place.kind == Kind::body;
  }

  /// A body that is taken away in this step, whose forces have not yet fallen to zero.
  bool is_leaving(int body) const {
    const auto b = static_cast<std::size_t>(body);
    return prepared_.is_absent(prepared_.structure.dofs.part_of(body)) && b < state_.factors.presence.size() &&
           state_.factors.presence[b] > 0.0;
  }
  bool is_leaving(const model::Support& support) const {
    const auto first = static_cast<std::ptrdiff_t>(3 * (&support - prepared_.model.supports.data()));
    const auto begin = state_.released_reactions.begin() + first;
    return std::any_of(begin, begin + 3, [](double component) { return component != 0.0; });
  }

  /// Nodes that another edge of the body shares with a tied body, and this one does not.
  void find_other_ties() {
    tied_elsewhere_.assign(body_.nodes.size(), false);
    for (const bool elsewhere : {true, false})
      for (std::size_t t = 0; t < prepared_.model.ties.size(); ++t)
        for (const mesh::ContactPair& pair : prepared_.mesh.ties[t].pairs) {
          mark(prepared_.model.ties[t].a, pair.node_a, elsewhere);
          mark(prepared_.model.ties[t].b, pair.node_b, elsewhere);
        }
  }
  void mark(const model::Place& place, int node, bool elsewhere) {
    if (place.body == edge_.on.body && is_elsewhere(place) == elsewhere)
      tied_elsewhere_[static_cast<std::size_t>(node)] = elsewhere;
  }

  /// A known force on the body at a node of the edge. What acts elsewhere is taken out of K u; a node that is tied
  /// elsewhere has, instead of K u, what acts through the edge.
  void apply(bool elsewhere, int node, const Vec2& force) {
    const bool tied_elsewhere = tied_elsewhere_[static_cast<std::size_t>(node)];
    if (elsewhere && !tied_elsewhere) add(node, -force);
    if (!elsewhere && tied_elsewhere) add(node, force);
  }

  void add(int node, const Vec2& force) {
    sum_.force += force;
    sum_.moment += cross(body_.nodes[static_cast<std::size_t>(node)] - edge_.about, force);
  }

  /// Of a load on this face: what acts on the cell around the scaling centre, whose side faces have no nodes, is at the
  /// nodes of its boundary.
  void add_from_within(const Vector& forces) {
    for (std::size_t node = 0; node < on_edge_.size(); ++node)
      if (!on_edge_[node]) add(static_cast<int>(node), forces.segment<2>(place_of(node)));
  }

  void add_cell(const std::vector<int>& dofs, const Matrix& K, const Vector& u) {
    const Vector forces = K * Vector(u(dofs));
    for (std::size_t k = 0; k < dofs.size(); k += 2) {
      const auto node = static_cast<std::size_t>(plane_components.node_of(dofs[k]));
      if (on_edge_[node] && !tied_elsewhere_[node])
        add(static_cast<int>(node), forces.segment<2>(static_cast<Eigen::Index>(k)));
    }
  }

  /// `on_b`: force on B of a pair.
  void apply_pair(int contact, const mesh::ContactPair& pair, const Vec2& on_b) {
    const model::Contact& of = prepared_.model.contacts[static_cast<std::size_t>(contact)];
    const auto side = [&](const model::Place& place, int node, const Vec2& force) {
      if (place.body == edge_.on.body && on_edge_[static_cast<std::size_t>(node)])
        apply(is_elsewhere(place), node, force);
    };
    side(of.b, pair.node_b, on_b);
    side(of.a, pair.node_a, -on_b);
  }

  /// Of the forces of a fluid on the pairs of an interface those where it has entered.
  Vector entered_of(int contact, const Vector& forces) const {
    Vector there = Vector::Zero(forces.size());
    const std::vector<double>& entered = state_.factors.entered;
    for (std::size_t i = 0; i < entered.size(); ++i)
      if (const auto& pair = prepared_.contact.pairs[i]; pair.contact == contact)
        there[pair.index] = entered[i] * forces[pair.index];
    return there;
  }

  void apply_pores(const model::PorePressure& pores, int contact, double factor) {
    Vector forces = system::pore_forces(pores, contact, prepared_.model, prepared_.mesh);
    if (pores.enters) forces = entered_of(contact, forces);
    const auto& pairs = prepared_.mesh.interfaces[static_cast<std::size_t>(contact)].pairs;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      apply_pair(contact, pairs[i], factor * forces[static_cast<Eigen::Index>(i)] * pairs[i].normal);
  }

  const Prepared& prepared_;
  const State& state_;
  const model::EdgeResultant& edge_;
  const mesh::BodyMesh& body_;
  std::map<int, int> number_in_part_;  // nodes of the edge by their number in the part
  std::vector<bool> on_edge_;          // [node]
  std::vector<bool> tied_elsewhere_;   // [node]
  EdgeForces sum_;
};

}  // namespace

std::vector<EdgeForces> edge_forces(const Prepared& prepared, const State& state) {
  std::vector<EdgeForces> results;
  for (const model::HistoryItem& item : prepared.model.output.history) {
    const auto* edge = std::get_if<model::EdgeResultant>(&item.of);
    if (!edge) continue;
    if (prepared.is_absent(prepared.structure.dofs.part_of(edge->on.body))) {
      results.emplace_back();
      continue;
    }
    SumOverEdge sum(prepared, state, *edge);
    sum.add_stiffness();
    sum.apply_loads();
    sum.apply_contacts();
    sum.apply_reactions();
    sum.apply_springs();
    sum.apply_bars();
    sum.apply_released();
    results.push_back(sum.sum());
  }
  return results;
}

}  // namespace scabo::analysis
