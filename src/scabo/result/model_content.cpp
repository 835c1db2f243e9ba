#include "scabo/result/model_content.hpp"

#include <nlohmann/json.hpp>
#include <set>

#include "scabo/result/report.hpp"

namespace scabo::result {

namespace {

using ModelJson = nlohmann::ordered_json;

std::string_view law_of(const model::Material& material) {
  if (!material.law) return "isotropic";
  return std::holds_alternative<model::Orthotropic>(*material.law) ? "orthotropic" : "anisotropic";
}

ModelJson content_of(const model::Material& material) {
  ModelJson json = {{"name", material.name}, {"law", law_of(material)}};
  json["young"] = material.law ? ModelJson() : ModelJson(material.young);
  json["poisson"] = material.law ? ModelJson() : ModelJson(material.poisson);
  json["density"] = material.density ? ModelJson(*material.density) : ModelJson();
  return json;
}

ModelJson content_of(const model::Model& model, const model::Body& body, const mesh::BodyMesh& divided) {
  std::set<int> used;
  for (const mesh::Cell& cell : divided.cells) used.insert(cell.materials.begin(), cell.materials.end());
  ModelJson materials = ModelJson::array();
  for (const int material : used) materials.push_back(model.materials[material].name);
  ModelJson json = {{"name", body.name}, {"rigid", body.rigid}, {"unbounded", body.outside}, {"materials", materials}};
  if (body.thickness) json["thickness"] = *body.thickness;
  json["nodes"] = divided.nodes.size();
  json["super_elements"] = divided.count(mesh::CellKind::superelement);
  json["finite_elements"] = divided.count(mesh::CellKind::finite_element);
  return json;
}

}  // namespace

nlohmann::ordered_json model_content(const model::Model& model, const mesh::Mesh& mesh) {
  ModelJson json;
  json["plane"] = model.analysis.revolved()                      ? "axisymmetric"
                  : model.analysis.plane == model::Plane::stress ? "stress"
                                                                 : "strain";
  json["thickness"] = model.analysis.thickness;
  if (model.analysis.revolved()) json["forces_of"] = model.analysis.forces_of();
  json["materials"] = ModelJson::array();
  for (const model::Material& material : model.materials) json["materials"].push_back(content_of(material));
  json["bodies"] = ModelJson::array();
  for (std::size_t i = 0; i < mesh.bodies.size(); ++i)
    json["bodies"].push_back(content_of(model, model.bodies[i], mesh.bodies[i]));
  json["contacts"] = ModelJson::array();
  for (const mesh::Interface& interface : mesh.interfaces) {
    const model::Contact& contact = model.contacts[interface.contact];
    json["contacts"].push_back(
        {{"name", contact.name}, {"between", {contact.a.text, contact.b.text}}, {"law", describe_law(contact)}});
  }
  json["steps"] = ModelJson::array();
  for (const model::Step& step : model.steps) json["steps"].push_back(step.name);
  return json;
}

}  // namespace scabo::result
