#include "scabo/result/solid/solid_results.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "scabo/model/wording.hpp"
#include "scabo/result/contact_table.hpp"
#include "scabo/result/old_results.hpp"
#include "scabo/result/report.hpp"
#include "scabo/result/solid/solid_cells.hpp"
#include "scabo/result/solid/solid_faces.hpp"
#include "scabo/result/solid/solid_figures.hpp"
#include "scabo/result/solid/solid_mechanism_cells.hpp"
#include "scabo/result/solid/solid_outcome.hpp"
#include "scabo/result/summary.hpp"
#include "scabo/result/version.hpp"

namespace scabo::result {

namespace {

using Json = nlohmann::ordered_json;  // keys in the order of the documentation

constexpr std::string_view columns_of_solids =
    "step,increment,contact,pair,x,y,z,normal_x,normal_y,normal_z,area,gap,slip_x,slip_y,slip_z,"
    "normal_force,pressure,shear_x,shear_y,shear_z,state\n";

Json json_of(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

Json json_of(const SolidTotals& totals, const model::Contact& law) {
  Json json = {{"normal_force", json_of(totals.normal)},
               {"tangential_force", json_of(totals.tangential)},
               {"moment", json_of(totals.moment)},
               {"max_pressure", totals.largest_pressure},
               {"max_gap", totals.largest_gap},
               {"open", totals.open},
               {"stick", totals.stick},
               {"slip", totals.slip}};
  if (law.cohesion > 0.0) json["broken"] = totals.broken;
  return json;
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
               {"reached", reached_by(model, posed, number)},
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
  json["moments"] = Json::object();
  if (!posed.model.preloads.empty()) json["preloads"] = Json::object();
  if (!model.springs.empty()) json["springs"] = Json::object();
  if (!model.bars.empty()) json["bars"] = Json::object();
  json["energy"] = nullptr;
  json["certificate"] = nullptr;
  if (posed.model.has_stages()) json["absent"] = Json::array();
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (increment.is_absent(b)) json["absent"].push_back(model.bodies[b].name);
  if (increment.uniqueness) json["uniqueness"] = content_of_uniqueness(*increment.uniqueness);
  if (!solved) return json;
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    json["contacts"][model.contacts[c].name] =
        json_of(totals_of(increment, c, model.contacts[c].about), model.contacts[c].law);
  const std::vector<SolidReaction> reactions = reactions_of(posed, model.supports.size(), increment);
  for (std::size_t i = 0; i < reactions.size(); ++i) {
    json["reactions"][model.supports[i].name] = json_of(reactions[i].force);
    json["moments"][model.supports[i].name] = json_of(reactions[i].moment);
  }
  for (std::size_t i = 0; i < posed.model.preloads.size(); ++i)
    json["preloads"][model.bodies[static_cast<std::size_t>(posed.model.preloads[i].body)].name] = {
        {"force", increment.tensions[i].force}, {"shortening", increment.tensions[i].shortening}};
  for (std::size_t i = 0; i < increment.springs.size(); ++i)
    json["springs"][model.springs[i].name] = json_of(increment.springs[i]);
  for (std::size_t i = 0; i < increment.bars.size(); ++i)
    json["bars"][model.bars[i].name] = {{"tension", increment.bars[i]}};
  const analysis::Energy& energy = increment.energy;
  json["energy"] = {{"external", energy.external},
                    {"elastic", energy.elastic},
                    {"friction", energy.friction},
                    {"friction_error", energy.friction_error}};
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

std::ptrdiff_t super_elements_of(const mesh::SolidMesh& mesh) {
  return std::count_if(mesh.cells.begin(), mesh.cells.end(),
                       [](const std::vector<int>& cell) { return mesh::is_super_element(cell.size()); });
}
std::ptrdiff_t finite_elements_of(const mesh::SolidMesh& mesh) {
  return static_cast<std::ptrdiff_t>(mesh.cells.size()) - super_elements_of(mesh);
}

Json begun_summary(const model::SpaceModel& model, const analysis::PosedSolids& posed) {
  Eigen::Index nodes = 0;
  std::ptrdiff_t finite = 0, super = 0;
  for (const analysis::SolidBody& body : posed.model.bodies) {
    nodes += body.mesh.nodes.cols();
    finite += finite_elements_of(body.mesh);
    super += super_elements_of(body.mesh);
  }
  Json json;
  json["scabo"] = version();
  json["title"] = model.title;
  json["analysis"] = "space";
  json["status"] = "running";
  json["reason"] = nullptr;
  json["warnings"] = texts_of(model.warnings);
  json["model"] = {{"nodes", nodes}, {"dofs", 3 * nodes}, {"finite_elements", finite}, {"steps", Json::array()}};
  if (super > 0) json["model"]["super_elements"] = super;
  for (const model::Step& step : model.steps) json["model"]["steps"].push_back(step.name);
  for (std::size_t b = 0; b < posed.model.bodies.size(); ++b) {
    const mesh::SolidMesh& mesh = posed.model.bodies[b].mesh;
    Json materials = Json::array();
    if (const int material = model.bodies[b].material; material >= 0)
      materials.push_back(model.materials[static_cast<std::size_t>(material)].name);
    json["model"]["bodies"].push_back({{"name", model.bodies[b].name},
                                       {"rigid", model.bodies[b].rigid},
                                       {"materials", materials},
                                       {"nodes", mesh.nodes.cols()},
                                       {"finite_elements", finite_elements_of(mesh)}});
    if (super > 0) json["model"]["bodies"].back()["super_elements"] = super_elements_of(mesh);
  }
  for (const model::SpaceContact& contact : model.contacts)
    json["model"]["contacts"].push_back({{"name", contact.name},
                                         {"between", {contact.a.text, contact.b.text}},
                                         {"law", contact.tied ? "tied" : describe_law(contact.law)}});
  json["increments"] = Json::array();
  return json;
}

std::string text_of(const Json& summary) { return summary.dump(2, ' ', false, Json::error_handler_t::replace) + '\n'; }

std::string log_header(const model::SpaceModel& model, const Json& summary) {
  std::string text = fmt::format("Scabo {}\n", version());
  if (!model.title.empty()) text += model.title + '\n';
  if (!model.file.empty()) text += fmt::format("Model: {}\n", model.file);
  const Json& sizes = summary["model"];
  text += fmt::format("{} in space, {} nodes, {} degrees of freedom, {} tetrahedra{}\n",
                      model.bodies.size() == 1 ? "1 body" : fmt::format("{} bodies", model.bodies.size()),
                      sizes["nodes"].get<long>(), sizes["dofs"].get<long>(), sizes["finite_elements"].get<long>(),
                      sizes.contains("super_elements")
                          ? fmt::format(", {} hexahedra and wedges", sizes["super_elements"].get<long>())
                          : "");
  for (const model::SpaceContact& contact : model.contacts)
    text += fmt::format("{} {}: {} on {}{}\n", contact.tied ? "tie" : "contact", contact.name, contact.b.text,
                        contact.a.text, contact.tied ? "" : "; " + describe_law(contact.law));
  return text + '\n';
}

/// `step press, increment 2 of 10: tip = 0.2; 4 iterations, certificate 2.2e-14`
std::string log_line(const model::SpaceModel& model, const Json& json, const analysis::SolidIncrement& increment) {
  const model::Step& step = model.steps[json["step"].get<std::size_t>() - 1];
  std::string text =
      fmt::format("step {}, increment {} of {}:", step.name, json["increment"].get<int>(), step.increments);
  for (const auto& [name, factor] : json["factors"].items())
    text += fmt::format(" {} = {:.6g},", name, factor.get<double>());
  if (json["factors"].empty())
    text += ' ';
  else
    text.back() = ';', text += ' ';
  text += model::counted(increment.iterations, "iteration");
  if (increment.status == contact::Status::solved)
    text += fmt::format(", certificate {:.2g}", increment.certificate.worst());
  if (increment.uniqueness) text += fmt::format(", unique: {}", increment.uniqueness->verdict);
  if (increment.status == contact::Status::solved) return text + '\n';
  if (increment.mechanism) return text + fmt::format("; {}\n", increment.reason);  // begins with the status
  return text + fmt::format("; {}: {}\n", status_of(increment.status), increment.reason);
}

/// Forces of contacts and supports, for people.
std::string totals_of(const Json& increment) {
  std::vector<std::vector<std::string>> rows = {{"force on side b, on the body", "x", "y", "z"}};
  const auto add = [&](const std::string& name, const Json& force) {
    rows.push_back({name});
    for (const Json& component : force) rows.back().push_back(fmt::format("{:.6g}", component.get<double>()));
  };
  const bool any_absent = increment.contains("absent") && !increment["absent"].empty();
  for (const auto& [name, contact] : increment["contacts"].items()) {
    if (any_absent && contact["open"] == 0 && contact["stick"] == 0 && contact["slip"] == 0) continue;
    add(name + ", normal", contact["normal_force"]);
    add(name + ", tangential", contact["tangential_force"]);
  }
  for (const auto& [name, force] : increment["reactions"].items()) add(name, force);
  if (increment.contains("springs"))
    for (const auto& [name, force] : increment["springs"].items()) add("springs " + name, force);
  std::string text = table(rows);
  if (increment.contains("bars"))
    for (const auto& [name, bar] : increment["bars"].items())
      text += fmt::format("  bar {}: tension {:.6g}\n", name, bar["tension"].get<double>());
  if (increment.contains("preloads"))
    for (const auto& [name, preload] : increment["preloads"].items())
      text += fmt::format("  preload of {}: tension {:.6g}, shortened by {:.6g}\n", name,
                          preload["force"].get<double>(), preload["shortening"].get<double>());
  return text;
}

/// Of an increment that has been added to the summary.
void note_outcome(const analysis::SolidModel& model, const analysis::SolidIncrement& increment, Json& json) {
  json["status"] = status_of(increment.status);
  if (!increment.reason.empty()) json["reason"] = increment.reason;
  if (increment.mechanism) json["mechanism"] = content_of_mechanism(*increment.mechanism, model);
}

std::string which_increment(const Json& summary, const Json& increment) {
  return fmt::format("step {}, increment {}",
                     summary["model"]["steps"][increment["step"].get<std::size_t>() - 1].get<std::string>(),
                     increment["increment"].get<int>());
}

}  // namespace

struct SolidResults::Summary {
  Json json;
};

SolidResults::SolidResults(std::filesystem::path path, const model::SpaceModel& model,
                           const analysis::PosedSolids& posed)
    : path_(std::move(path)),
      model_(model),
      posed_(posed),
      summary_(new Summary{begun_summary(model, posed)}),
      lock_(prepare_directory(path_, text_of(summary_->json))),
      outputs_(model, posed) {
  replace_summary();
  open_files(nullptr);
}

SolidResults::SolidResults(std::filesystem::path path, DirectoryLock lock, const model::SpaceModel& model,
                           const analysis::PosedSolids& posed, const analysis::WrittenResults& written)
    : path_(std::move(path)),
      model_(model),
      posed_(posed),
      summary_(new Summary{begun_summary(model, posed)}),
      lock_(std::move(lock)),
      finished_(written.finished),
      outputs_(model, posed) {
  std::ifstream stream(path_ / "summary.json", std::ios::binary);
  Json before = Json::parse(stream, nullptr, false);
  const auto count = static_cast<std::size_t>(finished_);
  if (!before.is_object() || !before["increments"].is_array() || before["increments"].size() < count)
    throw WriteError("cannot continue", path_ / "summary.json",
                     "it has fewer increments than the run finished: run the model again with `scabo run`");
  for (std::size_t k = 0; k < count; ++k) summary_->json["increments"].push_back(std::move(before["increments"][k]));
  if (before["warnings"].is_array()) summary_->json["warnings"] = std::move(before["warnings"]);
  open_files(&written);
  remove_later_fields(path_, written.fields_written);
  replace_summary();
}

SolidResults::~SolidResults() = default;

void SolidResults::open_files(const analysis::WrittenResults* written) {
  const auto open = [&](const char* name, auto& file) {
    if (written)
      file.emplace(path_ / name, size_in(*written, name));
    else
      file.emplace(path_ / name);
  };
  open("contact.csv", table_);
  if (outputs_.has_points()) open("points.csv", points_);
  if (outputs_.has_lines()) open("lines.csv", lines_);
  if (outputs_.has_history()) open("history.csv", history_);
  open("log.txt", log_);
  open("fields.pvd", collection_);
  if (!model_.contacts.empty()) open("contact.pvd", faces_);
  if (written) return;
  table_->append(columns_of_solids);
  if (points_) points_->append(outputs_.header_of_points());
  if (lines_) lines_->append(outputs_.header_of_lines());
  if (history_) history_->append(outputs_.header_of_history());
  log_->append(log_header(model_, summary_->json));
}

std::vector<GrowingFile*> SolidResults::growing_files() {
  std::vector<GrowingFile*> files{&*table_, &*log_, &collection_->file()};
  if (faces_) files.push_back(&faces_->file());
  for (std::optional<GrowingFile>* file : {&points_, &lines_, &history_})
    if (*file) files.push_back(&**file);
  return files;
}

void SolidResults::replace_summary() const { replace_file(path_ / "summary.json", text_of(summary_->json)); }

void SolidResults::add_fields(const analysis::SolidIncrement& increment) {
  const auto write = [&](const char* name, const std::string& content, FieldCollection& collection) {
    const std::string file = fmt::format("{}_{:04d}.vtu", name, finished_);
    replace_file(path_ / file, content);
    collection.add(static_cast<double>(finished_), file);
    not_synchronised_.push_back(path_ / file);
  };
  write("fields", vtu_content(solid_cells(posed_.model, increment)), *collection_);
  if (faces_) write("contact", vtu_content(solid_faces(posed_.model, increment)), *faces_);
}

void SolidResults::add(const analysis::SolidIncrement& increment) {
  std::vector<long long> sizes;
  for (const GrowingFile* file : growing_files()) sizes.push_back(file->size());
  const int finished = finished_;
  const std::size_t not_synchronised = not_synchronised_.size(), warnings = warnings_.size();
  const Json texts = summary_->json["warnings"];
  try {
    add_files(increment);
  } catch (const WriteError&) {  // nothing is left of the increment
    const std::vector<GrowingFile*> files = growing_files();
    for (std::size_t i = 0; i < files.size(); ++i) files[i]->cut_back(sizes[i]);
    finished_ = finished;
    not_synchronised_.resize(not_synchronised);
    warnings_.resize(warnings);
    summary_->json["warnings"] = texts;
    remove_later_fields(path_, finished_);
    Json& made = summary_->json["increments"];
    made.erase(made.size() - 1);
    try {  // there is room for what was removed
      replace_summary();
    } catch (const WriteError&) {
    }
    throw;
  }
}

void SolidResults::add_files(const analysis::SolidIncrement& increment) {
  Json& made = summary_->json["increments"];
  const std::size_t number = made.size();
  made.push_back(json_of(model_, posed_, increment, number));
  if (increment.status == contact::Status::solved) {
    ++finished_;
    table_->append(rows_of(model_, posed_, increment, number));
    if (points_) points_->append(outputs_.rows_of_points(increment, number));
    if (lines_) lines_->append(outputs_.rows_of_lines(increment, number));
    if (history_) history_->append(outputs_.row_of_history(increment, number));
    add_fields(increment);
  }
  log_->append(log_line(model_, made.back(), increment));
  summary_->json["status"] = "running";
  summary_->json["reason"] = nullptr;
  note_warnings(model_, made.back(), increment.warnings, summary_->json["warnings"], warnings_);
  replace_summary();
  note_outcome(posed_.model, increment, summary_->json);
  if (increment.mechanism)
    replace_file(path_ / mechanism_name, vtu_content(solid_mechanism_cells(posed_.model, *increment.mechanism)));
}

analysis::WrittenResults SolidResults::written() {
  analysis::WrittenResults written{finished_, finished_, true, {}, {}};
  for (const std::filesystem::path& file : not_synchronised_) synchronise_file(file);
  not_synchronised_.clear();
  synchronise_file(path_ / "summary.json");
  for (GrowingFile* file : growing_files()) {
    file->synchronise();
    written.files.push_back({file->path().filename().string(), file->size()});
  }
  return written;
}

namespace {

/// Puts the outcome into a summary.
SolidEnd end_of(Json& json, int finished, bool interrupted) {
  const Json& made = json["increments"];
  if (interrupted) {
    json["status"] = "interrupted";
    json["reason"] = finished > 0 ? "interrupted: the increments finished so far are kept"
                                  : "interrupted: no increment was finished";
  } else if (json["status"] == "running") {  // all increments had been made before
    json["status"] = "solved";
  }
  SolidEnd end;
  end.status = json["status"].get<std::string>();
  if (json["reason"].is_string()) end.reason = json["reason"].get<std::string>();
  end.finished = finished;
  for (const Json& increment : made)
    for (const Json& figure : increment["certificate"])
      end.certificate = std::max(end.certificate, figure.get<double>());
  if (!made.empty()) end.at = which_increment(json, made.back());
  if (finished > 0) end.totals = totals_of(made[static_cast<std::size_t>(finished - 1)]);
  return end;
}

}  // namespace

SolidEnd SolidResults::finish(bool interrupted) {
  Json& json = summary_->json;
  SolidEnd end = end_of(json, finished_, interrupted);
  if (end.status == "solved" && finished_ > 0)
    note_few_pairs(model_, json["increments"][static_cast<std::size_t>(finished_ - 1)], json["warnings"], warnings_);
  end.warnings = warnings_;
  std::string text = end.status == "solved" ? "\nSolved: every increment converged and is certified.\n"
                     : interrupted          ? fmt::format("\nInterrupted: {}\n", end.reason)
                                            : fmt::format("\nNot solved: {}\n", end.reason);
  if (finished_ > 0) {
    const Json& last = json["increments"][static_cast<std::size_t>(finished_ - 1)];
    text += fmt::format("\nAfter {}:\n{}", which_increment(json, last), end.totals);
  }
  if (json.contains("mechanism"))
    text += fmt::format("{} shows the motion: {}\n", mechanism_name, json["mechanism"]["text"].get<std::string>());
  for (const Json& warning : json["warnings"]) text += "warning: " + warning.get<std::string>() + '\n';
  log_->append(text);
  replace_summary();
  return end;
}

std::pair<std::string, SolidEnd> summary_of(const model::SpaceModel& model, const analysis::PosedSolids& posed,
                                            const std::vector<analysis::SolidIncrement>& increments, bool interrupted) {
  Json json = begun_summary(model, posed);
  int finished = 0;
  std::vector<Warning> warnings;
  for (std::size_t k = 0; k < increments.size(); ++k) {
    json["increments"].push_back(json_of(model, posed, increments[k], k));
    finished += increments[k].status == contact::Status::solved;
    note_warnings(model, json["increments"].back(), increments[k].warnings, json["warnings"], warnings);
    note_outcome(posed.model, increments[k], json);
  }
  SolidEnd end = end_of(json, finished, interrupted);
  if (end.status == "solved" && finished > 0)
    note_few_pairs(model, json["increments"][static_cast<std::size_t>(finished - 1)], json["warnings"], warnings);
  end.warnings = std::move(warnings);
  return {text_of(json), std::move(end)};
}

}  // namespace scabo::result
