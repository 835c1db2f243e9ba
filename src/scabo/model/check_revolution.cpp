// What bodies of revolution cannot have: all of them lie at x >= 0, consist of finite elements, and move as they are.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/geometry/box.hpp"
#include "scabo/model/checking.hpp"

namespace scabo::model {

namespace {

/// Whether a place lies on the axis x = 0 as a whole.
bool is_on_axis(const Place& place, const Body& body) {
  const double rounding = 1e-9 * geometry::outline_size(body.outline);
  const auto on_axis = [&](const Vec2& x) { return std::abs(x.x()) <= rounding; };
  const auto index = static_cast<std::size_t>(place.index);
  switch (place.kind) {
    case Place::Kind::edge: {
      const Edge& edge = body.outline.edges[index];
      return on_axis(edge.start) && on_axis(edge.end) && on_axis(edge.at(0.5));
    }
    case Place::Kind::corner:
      return on_axis(body.outline.corners[index].position);
    case Place::Kind::near:
      return on_axis(place.near);
    default:
      return false;
  }
}

class Revolution {
 public:
  explicit Revolution(Checking& checking) : checking_(checking), model_(checking.model) {}

  void analysis() {
    checking_.enter({});
    if (model_.analysis.type == AnalysisType::modal)
      checking_.error("analysis", "type", "natural frequencies are those of plane bodies only: write static");
    const auto in_time = [](const Step& step) { return step.dynamic.has_value(); };
    if (const auto step = std::find_if(model_.steps.begin(), model_.steps.end(), in_time); step != model_.steps.end()) {
      checking_.enter(step->source);
      checking_.error("steps", "", "bodies of revolution have no steps in time: leave 'dynamic' out");
    }
    if (model_.output.error || !model_.output.error_of.empty() || model_.tolerance)
      checking_.error(model_.tolerance ? "tolerance" : "output.error", "",
                      "errors are estimated of plane bodies only: compare two mesh sizes instead");
    for (std::size_t i = 0; i < model_.materials.size(); ++i) {
      const Material& material = model_.materials[i];
      if (!material.law || !std::holds_alternative<Anisotropic>(*material.law)) continue;
      checking_.enter(material.source);
      checking_.error(path_of("materials", material.name, i), "anisotropic",
                      "is a law of the plane, which has no stress around the axis: give 'young' or 'orthotropic'");
    }
  }

  void bodies() {
    for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
      const Body& body = model_.bodies[i];
      const std::string path = path_of("bodies", body.name, i);
      checking_.enter(body.source);
      if (checking_.sound_shape(static_cast<int>(i))) check_radii(path, body);
      if (body.rigid) continue;
      if (body.image)
        refuse(path, "shape", "an image shows a plane body: draw the half section as a polygon, or give a mesh file");
      else if (body.outside)
        refuse(path, "outside", "no body of revolution is unbounded: make the body larger than what acts on it");
      else if (body.mesh.kind != MeshKind::fem)
        refuse(path, body.imported ? "mesh.elements" : "mesh.kind",
               "bodies of revolution consist of finite elements: write fem, or leave it out");
      if (!body.cracks.empty()) refuse(path, "cracks", "are those of plane bodies only: leave them out");
      if (body.mesh.tolerance)
        refuse(path, "mesh.tolerance", "errors are estimated of plane bodies only: leave it out and give a size");
    }
  }

  void supports() {
    for (std::size_t i = 0; i < model_.supports.size(); ++i) {
      const Support& support = model_.supports[i];
      if (!checking_.support[i] || !checking_.is_body(support.on.body)) continue;
      const std::string path = path_of("supports", support.source, i);
      checking_.enter(support.source);
      const bool xy = support.axes == SupportAxes::xy;
      const bool radial = xy ? support.displacement[0].has_value()
                             : support.axes == SupportAxes::edge || std::abs(support.along.x()) > 1e-14;
      if (support.rotation)
        checking_.error(path, "rotation", "a body of revolution cannot turn out of its axis: leave 'rotation' out");
      else if (checking_.body(support.on.body).rigid && radial)
        checking_.error(path, "",
                        "a rigid body of revolution moves along its axis only: hold y alone, fix: y or displacement: "
                        "[null, uy]");
      else if (sound(support.on) && radial && is_on_axis(support.on, checking_.body(support.on.body)))
        checking_.error(path, "", "on the axis the radius stays 0 by itself: hold y alone, or leave the support out");
    }
  }

  void springs() {
    for (std::size_t i = 0; i < model_.springs.size(); ++i) {
      const Spring& spring = model_.springs[i];
      checking_.enter(spring.source);
      if (acts_along(spring)) side(path_of("springs", spring.source, i) + ".on", spring.on, "springs act");
    }
  }

  void loads() {
    for (std::size_t i = 0; i < model_.loads.size(); ++i) {
      const Load& load = model_.loads[i];
      if (!checking_.load[i]) continue;
      const std::string path = path_of_load(load, i);
      checking_.enter(load.source);
      if (std::holds_alternative<Moment>(load.kind))
        refuse(path, "moment", "bends a plane body; forces around an axis have no moment: give a traction");
      else if (std::holds_alternative<UniformStress>(load.kind) || std::holds_alternative<GroundStress>(load.kind))
        refuse(path, "field", "the stress of a field is that of plane bodies only: leave it out");
      else if (const auto* gravity = std::get_if<Gravity>(&load.kind); gravity && gravity->value.x() != 0.0)
        checking_.error(path, "gravity", "acts along the axis: write [0, gy]");
      else if (const auto* water = std::get_if<Water>(&load.kind); water && std::abs(water->up.x()) > 1e-14)
        checking_.error(path, "water.up", "is the axis: write [0, 1] or leave it out");
      else if (load.on)
        force(path, load);
    }
  }

  void contacts() {
    for (std::size_t i = 0; i < model_.contacts.size(); ++i) {
      const Contact& contact = model_.contacts[i];
      const std::string path = path_of_joint("contacts", contact.source, contact.name, i);
      checking_.enter(contact.source);
      side(path + ".between.0", contact.a, "a contact acts");
      side(path + ".between.1", contact.b, "a contact acts");
      if (checking_.is_body(contact.a.body) && checking_.is_body(contact.b.body) &&
          checking_.body(contact.a.body).rigid && checking_.body(contact.b.body).rigid)
        checking_.error(path, "between", "two rigid bodies of revolution: one of them must be elastic");
      if (contact.large_slip)
        checking_.error_of_key(path, "slip", "bodies of revolution slide by small distances: leave 'slip' out");
    }
    for (std::size_t i = 0; i < model_.ties.size(); ++i) {
      const std::string path = path_of_joint("ties", model_.ties[i].source, "", i);
      checking_.enter(model_.ties[i].source);
      side(path + ".between.0", model_.ties[i].a, "a tie acts");
      side(path + ".between.1", model_.ties[i].b, "a tie acts");
    }
  }

 private:
  bool sound(const Place& place) const { return checking_.is_body(place.body) && checking_.sound_shape(place.body); }

  void refuse(const std::string& path, const char* key, const char* why) { checking_.error_of_key(path, key, why); }

  void check_radii(const std::string& path, const Body& body) {
    const geometry::Box box = geometry::box_of(body.outline);
    if (box.low.x() >= -1e-9 * geometry::outline_size(body.outline)) return;
    checking_.error(path, body.imported ? "mesh" : "shape",
                    fmt::format("body '{}' {}: x is the radius, from the axis x = 0 outwards; draw the half section "
                                "with x >= 0",
                                body.name,
                                box.high.x() > 0.0 ? fmt::format("crosses the axis, to x = {:.6g}", box.low.x())
                                                   : fmt::format("lies at x = {:.6g}, below 0", box.low.x())));
  }

  /// An edge that has an area.
  void side(const std::string& path, const Place& place, const char* what) {
    if (sound(place) && place.kind == Place::Kind::edge && is_on_axis(place, checking_.body(place.body)))
      checking_.error(path, "",
                      fmt::format("'{}' lies on the axis and has no area on which {}: name another edge",
                                  text_of(model_, place), what));
  }

  void force(const std::string& path, const Load& load) {
    const bool edge = load.on->kind == Place::Kind::edge;
    if (edge) side(path + ".on", *load.on, "a load acts");
    const auto* force = std::get_if<Force>(&load.kind);
    if (!force || force->value.x() == 0.0 || !sound(*load.on)) return;
    const Body& body = checking_.body(load.on->body);
    if (body.rigid)
      checking_.error(path, "force", "a rigid body of revolution takes forces along its axis only: write [0, fy]");
    else if (!edge && is_on_axis(*load.on, body))
      checking_.error(path, "force", "on the axis only forces along it act: write [0, fy]");
  }

  Checking& checking_;
  const Model& model_;
};

}  // namespace

void check_revolution(Checking& checking) {
  const Model& model = checking.model;
  if (!model.analysis.revolved()) {
    for (std::size_t i = 0; i < model.loads.size(); ++i)
      if (std::holds_alternative<Spin>(model.loads[i].kind)) {
        checking.enter(model.loads[i].source);
        checking.error_of_key(path_of_load(model.loads[i], i), "spin",
                              "is about the axis of a body of revolution: write analysis: {plane: axisymmetric}");
      }
    return;
  }
  Revolution revolution(checking);
  revolution.analysis();
  revolution.bodies();
  revolution.supports();
  revolution.springs();
  revolution.loads();
  revolution.contacts();
}

}  // namespace scabo::model
