// Small models for the tests of mesh/, built without the reader.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "scabo/mesh/mesh.hpp"
#include "scabo/mesh/plane/divide.hpp"
#include "scabo/mesh/plane/interface.hpp"
#include "scabo/model/model.hpp"

namespace scabo::test {

constexpr double pi = std::numbers::pi;

inline Vec2 polar(const Vec2& centre, double radius, double angle) {
  return centre + radius * Vec2(std::cos(angle), std::sin(angle));
}

inline model::Edge line(const std::string& name, const Vec2& start, const Vec2& end) {
  model::Edge edge;
  edge.names = {name};
  edge.start = start;
  edge.end = end;
  return edge;
}

inline model::Edge arc(const std::string& name, const Vec2& centre, double radius, double from, double sweep) {
  model::Edge edge = line(name, polar(centre, radius, from), polar(centre, radius, from + sweep));
  edge.arc = model::Arc{centre, radius, from, sweep};
  return edge;
}

inline model::Outline outline(std::vector<model::Edge> edges) {
  model::Outline outline;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    edges[i].start = edges[(i + edges.size() - 1) % edges.size()].end;
    outline.corners.push_back({{"vertex_" + std::to_string(i + 1)}, edges[i].start});
  }
  outline.edges = std::move(edges);
  return outline;
}

inline model::Outline polygon(const std::vector<Vec2>& vertices, const std::vector<std::string>& names) {
  std::vector<model::Edge> edges;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    edges.push_back(line(names[i], vertices[i], vertices[(i + 1) % vertices.size()]));
  }
  return outline(std::move(edges));
}

inline model::Outline rectangle(const Vec2& corner, const Vec2& size) {
  const Vec2 x(size.x(), 0.0);
  const Vec2 y(0.0, size.y());
  model::Outline made = polygon({corner, corner + x, corner + size, corner + y}, {"bottom", "right", "top", "left"});
  made.rectangle = true;
  return made;
}

/// An elastic body; its scaling centre is the mean of its corners.
inline model::Body elastic(const std::string& name, model::Outline shape, double size, int order = 2) {
  model::Body body;
  body.name = name;
  body.material = 0;
  body.mesh.size = size;
  body.mesh.order = order;
  body.mesh.source = {7, 11, "bodies." + name + ".mesh"};
  for (const model::Edge& edge : shape.edges) {
    body.mesh.centre += edge.start / static_cast<double>(shape.edges.size());
  }
  body.outline = std::move(shape);
  return body;
}

inline model::Body rigid(const std::string& name, model::Outline shape) {
  model::Body body;
  body.name = name;
  body.rigid = true;
  body.outline = std::move(shape);
  return body;
}

inline model::Place edge_of(const model::Model& model, const std::string& body, const std::string& edge) {
  model::Place place;
  place.kind = model::Place::Kind::edge;
  place.text = body + "." + edge;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].name != body) continue;
    place.body = static_cast<int>(b);
    const std::vector<model::Edge>& edges = model.bodies[b].outline.edges;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (edges[e].names.front() == edge) place.index = static_cast<int>(e);
    }
  }
  return place;
}

/// Two bodies and the contact `joint` between an edge of the first (A) and one of the second.
inline model::Model pair_of(model::Body a, const std::string& edge_a, model::Body b, const std::string& edge_b) {
  model::Model model;
  model.file = "model.yaml";
  const std::string name_a = a.name;
  const std::string name_b = b.name;
  model.bodies = {std::move(a), std::move(b)};
  model::Contact joint;
  joint.name = "joint";
  joint.a = edge_of(model, name_a, edge_a);
  joint.b = edge_of(model, name_b, edge_b);
  joint.source = {24, 3, "contacts.joint"};
  model.contacts = {joint};
  return model;
}

inline model::Model swapped(model::Model model) {
  std::swap(model.contacts[0].a, model.contacts[0].b);
  return model;
}

/// Turned by `angle` about the origin, scaled, then moved: x -> scale Q x + move.
struct Similarity {
  double angle = 0.0;
  double scale = 1.0;
  Vec2 move = Vec2::Zero();

  Vec2 turn(const Vec2& x) const {
    return {std::cos(angle) * x.x() - std::sin(angle) * x.y(), std::sin(angle) * x.x() + std::cos(angle) * x.y()};
  }
  Vec2 operator()(const Vec2& x) const { return scale * turn(x) + move; }

  model::Model operator()(model::Model model) const {
    for (model::Body& body : model.bodies) {
      body.mesh.size *= scale;
      body.mesh.centre = (*this)(body.mesh.centre);
      for (model::Corner& corner : body.outline.corners) corner.position = (*this)(corner.position);
      for (model::Edge& edge : body.outline.edges) {
        edge.start = (*this)(edge.start);
        edge.end = (*this)(edge.end);
        if (!edge.arc) continue;
        edge.arc->centre = (*this)(edge.arc->centre);
        edge.arc->radius *= scale;
        edge.arc->start_angle += angle;
      }
    }
    for (model::Contact& contact : model.contacts) contact.gap *= scale;
    return model;
  }
};

inline std::string message_of(const model::Model& model) {
  try {
    mesh::make_mesh(model);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// What is wrong with the first contact if its sides stay as they are.
inline std::string message_unmatched(const model::Model& model, int contact = 0) {
  std::vector<mesh::BodyMesh> bodies;
  for (const model::Body& body : model.bodies) bodies.push_back(mesh::divide_boundary(body));
  const auto matched = mesh::match_interface(model, contact, bodies);
  const Diagnostic* wrong = std::get_if<Diagnostic>(&matched);
  return wrong ? wrong->at.path + ": " + wrong->message : "no error";
}

}  // namespace scabo::test
