#include "scabo/result/modal_results.hpp"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "scabo/result/files.hpp"
#include "scabo/result/model_content.hpp"
#include "scabo/result/recovery.hpp"
#include "scabo/result/report.hpp"
#include "scabo/result/summary.hpp"
#include "scabo/result/version.hpp"
#include "scabo/result/vtu.hpp"

namespace scabo::result {

namespace {

using Json = nlohmann::ordered_json;  // keys in the order of the documentation
using Clock = std::chrono::steady_clock;

/// Names of the bodies that vibrate.
std::string body_name(const analysis::ModalResult& result, const analysis::NaturalMode& mode) {
  std::string names;
  for (const int body : mode.bodies)
    names += (names.empty() ? "" : ", ") + result.structure.model.bodies[static_cast<std::size_t>(body)].name;
  return names;
}

std::string mass_cell(double mass, double total) {
  if (mass <= 1e-12 * total) mass = 0.0;  // rounding, as in the other tables (report.hpp)
  return fmt::format("{:.4g} ({:.1f} %)", mass, 100.0 * mass / total);
}

std::vector<std::pair<const char*, double>> stages(const analysis::ModalTiming& timing) {
  return {{"read", timing.read},
          {"mesh", timing.mesh},
          {"super_elements", timing.super_elements},
          {"mass", timing.mass},
          {"eigenvalues", timing.eigenvalues},
          {"recover", timing.recover},
          {"write", timing.write},
          {"total", timing.total}};
}

std::string report_warnings(const analysis::ModalResult& result) {
  std::string text;
  for (const Warning& warning : result.warnings) text += fmt::format("warning: {}\n", warning.text);
  return text.empty() ? text : text + '\n';
}

}  // namespace

std::string report_modes(const analysis::ModalResult& result) {
  std::vector<std::vector<std::string>> rows = {{"mode", "frequency", "body", "effective mass x", "effective mass y"}};
  Vec2 sum = Vec2::Zero();
  for (std::size_t k = 0; k < result.modes.size(); ++k) {
    const analysis::NaturalMode& mode = result.modes[k];
    rows.push_back({fmt::format("{}", k + 1), mode.rigid ? "0 (rigid)" : fmt::format("{:.6g}", mode.frequency),
                    body_name(result, mode), mass_cell(mode.effective_mass.x(), result.total_mass),
                    mass_cell(mode.effective_mass.y(), result.total_mass)});
    sum += mode.effective_mass;
  }
  rows.push_back({"sum", "", "", mass_cell(sum.x(), result.total_mass), mass_cell(sum.y(), result.total_mass)});
  return table(rows);
}

std::string modal_summary_content(const analysis::ModalResult& result, bool running) {
  const ModelSizes sizes = sizes_of(result.structure);
  Json json;
  json["scabo"] = version();
  json["title"] = result.structure.model.title;
  json["analysis"] = "modal";
  json["status"] = running ? "running" : "solved";
  json["reason"] = nullptr;
  json["warnings"] = texts_of(result.warnings);
  json["model"] = {{"nodes", sizes.nodes},
                   {"dofs", sizes.dofs},
                   {"super_elements", sizes.super_elements},
                   {"contact_pairs", sizes.contact_pairs}};
  json["model"].update(model_content(result.structure.model, result.structure.mesh));
  json["total_mass"] = result.total_mass;
  json["frequencies"] = Json::array();
  json["modes"] = Json::array();
  for (std::size_t k = 0; k < result.modes.size(); ++k) {
    const analysis::NaturalMode& mode = result.modes[k];
    json["frequencies"].push_back(mode.frequency);
    json["modes"].push_back({{"mode", k + 1},
                             {"frequency", mode.frequency},
                             {"body", body_name(result, mode)},
                             {"rigid", mode.rigid},
                             {"modal_mass", mode.modal_mass},
                             {"effective_mass", {mode.effective_mass.x(), mode.effective_mass.y()}},
                             {"residual", mode.residual}});
  }
  for (const auto& [name, seconds] : stages(result.timing)) json["timing"][name] = seconds;
  const auto memory = peak_memory();
  json["peak_memory_bytes"] = memory ? Json(*memory) : Json();
  // Texts of the user may not be UTF-8; the results must not be lost because of that.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

void write_shapes(const std::filesystem::path& directory, analysis::ModalResult& result) {
  const auto seconds_since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  FieldCollection collection(directory / "fields.pvd");
  Clock::time_point start = Clock::now();
  const Recovery recovery(result.structure);
  for (std::size_t k = 0; k < result.modes.size(); ++k) {
    const Fields fields = recovery.fields(result.structure, state_of(result, result.modes[k]));
    result.timing.recover += seconds_since(start);
    start = Clock::now();
    const std::string file = fmt::format("fields_{:04d}.vtu", k + 1);
    replace_file(directory / file, vtu_content(recovery.grid(), fields));
    collection.add(static_cast<double>(k + 1), file);
    result.timing.write += seconds_since(start);
    start = Clock::now();
  }
}

void write_modal_summary(const std::filesystem::path& directory, const analysis::ModalResult& result) {
  std::string log = report_header(result.structure.model, sizes_of(result.structure));
  log += fmt::format("Natural modes; total mass {:.6g}\n\n", result.total_mass) + report_modes(result) + '\n';
  log += report_warnings(result);
  std::vector<std::vector<std::string>> rows = {{"stage", "seconds"}};
  for (const auto& [name, seconds] : stages(result.timing)) rows.push_back({name, fmt::format("{:.4f}", seconds)});
  write_file(directory / "log.txt", log + table(rows));
  replace_file(directory / "summary.json", modal_summary_content(result));
}

}  // namespace scabo::result
