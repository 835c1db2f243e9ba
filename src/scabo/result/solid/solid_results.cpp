#include "scabo/result/solid/solid_results.hpp"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "scabo/result/contact_table.hpp"
#include "scabo/result/old_results.hpp"
#include "scabo/result/report.hpp"
#include "scabo/result/solid/solid_cells.hpp"
#include "scabo/result/solid/solid_faces.hpp"
#include "scabo/result/version.hpp"

namespace scabo::result {

namespace {

using Json = nlohmann::ordered_json;  // keys in the order of the documentation

constexpr std::string_view columns_of_solids =
    "step,increment,contact,pair,x,y,z,normal_x,normal_y,normal_z,area,gap,slip_x,slip_y,slip_z,"
    "normal_force,pressure,shear_x,shear_y,shear_z,state\n";

Json json_of(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

/// Of the pairs of one contact; forces on side b.
struct SolidTotals {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(), tangential = Eigen::Vector3d::Zero();
  double largest_pressure = 0.0, largest_gap = 0.0;
  int open = 0, stick = 0, slip = 0;
};

SolidTotals totals_of(const analysis::SolidIncrement& increment, std::size_t contact) {
  SolidTotals totals;
  for (const analysis::SolidPair& pair : increment.pairs) {
    if (pair.contact != static_cast<int>(contact)) continue;
    const Eigen::Vector3d normal = pair.normal_force() * pair.normal;
    totals.normal += normal;
    totals.tangential += pair.force - normal;
    totals.largest_pressure = std::max(totals.largest_pressure, pair.normal_force() / pair.area);
    totals.largest_gap = std::max(totals.largest_gap, pair.gap);
    totals.open += pair.state == contact::ContactState::open;
    totals.stick += pair.state == contact::ContactState::stick;
    totals.slip += pair.state == contact::ContactState::slip;
  }
  return totals;
}

Json json_of(const SolidTotals& totals) {
  return {{"normal_force", json_of(totals.normal)},
          {"tangential_force", json_of(totals.tangential)},
          {"max_pressure", totals.largest_pressure},
          {"max_gap", totals.largest_gap},
          {"open", totals.open},
          {"stick", totals.stick},
          {"slip", totals.slip}};
}

/// Forces of the supports on the bodies.
std::vector<Eigen::Vector3d> reactions_of(const analysis::PosedSolids& posed, std::size_t supports,
                                          const analysis::SolidIncrement& increment) {
  std::vector<Eigen::Vector3d> sums(supports, Eigen::Vector3d::Zero());
  for (std::size_t b = 0; b < increment.reactions.size(); ++b)
    for (std::size_t c = 0; c < posed.model.bodies[b].supports.size(); ++c) {
      const system::Constraint& held = posed.model.bodies[b].supports[c];
      sums[static_cast<std::size_t>(held.support)][held.component] +=
          increment.reactions[b][static_cast<Eigen::Index>(c)];
    }
  return sums;
}

Json figures_of(const contact::Certificate& certificate) {
  return {{"equilibrium", certificate.equilibrium},
          {"penetration", certificate.penetration},
          {"tension", certificate.tension},
          {"friction_excess", certificate.friction_excess},
          {"complementarity", certificate.complementarity},
          {"slip_direction", certificate.slip_direction},
          {"rigid_balance", certificate.rigid_balance}};
}

Json json_of(const model::SpaceModel& model, const analysis::PosedSolids& posed,
             const analysis::SolidIncrement& increment, std::size_t number) {
  const auto& [step, of_step] = posed.step_and_number[number];
  const bool solved = increment.status == contact::Status::solved;
  Json json = {{"step", step + 1},
               {"increment", of_step},
               {"reached", static_cast<double>(of_step) / model.steps[step].increments},
               {"factors", Json::object()}};
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    json["factors"][model.loads[i].name] = increment.factors.loads[static_cast<Eigen::Index>(i)];
  for (std::size_t i = 0; i < model.supports.size(); ++i)
    if (model.supports[i].named)
      json["factors"][model.supports[i].name] = increment.factors.supports[static_cast<Eigen::Index>(i)];
  json["converged"] = solved;
  json["newton_iterations"] = increment.iterations;
  json["contacts"] = Json::object();
  json["reactions"] = Json::object();
  json["certificate"] = nullptr;
  if (!solved) return json;
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    json["contacts"][model.contacts[c].name] = json_of(totals_of(increment, c));
  const std::vector<Eigen::Vector3d> reactions = reactions_of(posed, model.supports.size(), increment);
  for (std::size_t i = 0; i < reactions.size(); ++i) json["reactions"][model.supports[i].name] = json_of(reactions[i]);
  json["certificate"] = figures_of(increment.certificate);
  return json;
}

/// An infeasible problem is told as one that no forces can balance.
const char* status_of(contact::Status status) {
  switch (status) {
    case contact::Status::solved:
      return "solved";
    case contact::Status::mechanism:
      return "mechanism";
    case contact::Status::collapse:
      return "collapse";
    case contact::Status::not_converged:
    case contact::Status::infeasible:
      return "not_converged";
  }
  throw BrokenInvariant("a status without a name");
}

std::string rows_of(const model::SpaceModel& model, const analysis::PosedSolids& posed,
                    const analysis::SolidIncrement& increment, std::size_t number) {
  const auto& [step, of_step] = posed.step_and_number[number];
  fmt::memory_buffer rows;
  std::vector<int> counts(model.contacts.size(), 0);
  for (const analysis::SolidPair& pair : increment.pairs) {
    const auto c = static_cast<std::size_t>(pair.contact);
    const double N = pair.normal_force();
    const Eigen::Vector3d shear = (pair.force - N * pair.normal) / pair.area;
    fmt::format_to(std::back_inserter(rows), "{},{},{},{}", step + 1, of_step, csv_quoted(model.contacts[c].name),
                   ++counts[c]);
    for (const Eigen::Vector3d& vector : {pair.point, pair.normal})
      for (const double value : vector) fmt::format_to(std::back_inserter(rows), ",{}", value);
    fmt::format_to(std::back_inserter(rows), ",{},{},{},{},{},{},{},{},{},{},{}\n", pair.area, pair.gap, pair.slip.x(),
                   pair.slip.y(), pair.slip.z(), N, N / pair.area, shear.x(), shear.y(), shear.z(),
                   name_of(pair.state));
  }
  return fmt::to_string(rows);
}

}  // namespace

std::string solid_summary_content(const model::SpaceModel& model, const analysis::PosedSolids& posed,
                                  const std::vector<analysis::SolidIncrement>& increments, bool running) {
  Eigen::Index nodes = 0;
  std::size_t cells = 0;
  for (const analysis::SolidBody& body : posed.model.bodies) {
    nodes += body.mesh.nodes.cols();
    cells += body.mesh.cells.size();
  }
  Json json;
  json["scabo"] = version();
  json["title"] = model.title;
  json["analysis"] = "space";
  const bool made = !increments.empty();
  json["status"] = running ? "running" : made ? status_of(increments.back().status) : "not_converged";
  json["reason"] = made && !increments.back().reason.empty() ? Json(increments.back().reason) : Json();
  json["warnings"] = texts_of(model.warnings);
  json["model"] = {{"nodes", nodes}, {"dofs", 3 * nodes}, {"finite_elements", cells}, {"steps", Json::array()}};
  for (const model::SpaceStep& step : model.steps) json["model"]["steps"].push_back(step.name);
  json["increments"] = Json::array();
  for (std::size_t k = 0; k < increments.size(); ++k)
    json["increments"].push_back(json_of(model, posed, increments[k], k));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string report_solids(const model::SpaceModel& model, const analysis::PosedSolids& posed,
                          const analysis::SolidIncrement& increment) {
  const auto row = [](const std::string& name, const Eigen::Vector3d& force) {
    return std::vector<std::string>{name, fmt::format("{:.6g}", force.x()), fmt::format("{:.6g}", force.y()),
                                    fmt::format("{:.6g}", force.z())};
  };
  std::vector<std::vector<std::string>> rows = {{"force on side b, on the body", "x", "y", "z"}};
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const SolidTotals totals = totals_of(increment, c);
    rows.push_back(row(model.contacts[c].name + ", normal", totals.normal));
    rows.push_back(row(model.contacts[c].name + ", tangential", totals.tangential));
  }
  const std::vector<Eigen::Vector3d> reactions = reactions_of(posed, model.supports.size(), increment);
  for (std::size_t i = 0; i < reactions.size(); ++i) rows.push_back(row(model.supports[i].name, reactions[i]));
  return table(rows);
}

SolidResults::SolidResults(std::filesystem::path path, const model::SpaceModel& model,
                           const analysis::PosedSolids& posed)
    : path_(std::move(path)),
      model_(model),
      posed_(posed),
      lock_(prepare_directory(path_, solid_summary_content(model, posed, {}, true))),
      table_(path_ / "contact.csv"),
      collection_(path_ / "fields.pvd") {
  replace_file(path_ / "summary.json", solid_summary_content(model, posed, {}, true));
  table_.append(columns_of_solids);
  if (!model_.contacts.empty()) faces_.emplace(path_ / "contact.pvd");
}

void SolidResults::add(const analysis::SolidIncrement& increment) {
  const std::size_t number = made_.size();
  made_.push_back(increment);
  made_.back().u.clear();
  if (increment.status == contact::Status::solved) {
    table_.append(rows_of(model_, posed_, increment, number));
    const std::string file = fmt::format("fields_{:04d}.vtu", number + 1);
    replace_file(path_ / file, vtu_content(solid_cells(posed_.model, increment.u)));
    collection_.add(static_cast<double>(number + 1), file);
    if (faces_) {
      const std::string of_faces = fmt::format("contact_{:04d}.vtu", number + 1);
      replace_file(path_ / of_faces, vtu_content(solid_faces(posed_.model, increment)));
      faces_->add(static_cast<double>(number + 1), of_faces);
    }
  }
  replace_file(path_ / "summary.json", solid_summary_content(model_, posed_, made_, true));
}

void SolidResults::finish() {
  replace_file(path_ / "summary.json", solid_summary_content(model_, posed_, made_, false));
}

}  // namespace scabo::result
