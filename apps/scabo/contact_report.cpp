#include "contact_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "scabo/contact/status_name.hpp"
#include "scabo/model/wording.hpp"
#include "scabo/result/contact_table.hpp"
#include "scabo/result/report.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json list(const Vector& values) {
  Json json = Json::array();
  for (const double value : values) json.push_back(number_or_null(value));
  return json;
}

/// Figures of the certificate that follow from the discrete problem, in the order of the report.
std::vector<std::pair<const char*, double>> figures(const contact::Certificate& certificate) {
  return {{"penetration", certificate.penetration},         {"tension", certificate.tension},
          {"friction_excess", certificate.friction_excess}, {"complementarity", certificate.complementarity},
          {"slip_direction", certificate.slip_direction},   {"rigid_balance", certificate.rigid_balance}};
}

std::string describe_matrix(const contact::Problem& problem) {
  const auto size = problem.q.size();
  if (problem.W.is_sparse())
    return fmt::format("W {0} x {0}, sparse with {1} entries", size, problem.W.sparse().nonZeros());
  return fmt::format("W {0} x {0}, {1}", size, problem.W.is_dense() ? "dense" : "as an operator");
}

/// Relative motion of the pairs, u = W r + q + G a.
Vector motion_of(const contact::Problem& problem, const contact::Solution& solution) {
  Vector u = problem.q;
  if (solution.p.size() == u.size()) u += problem.W.times(solution.p);
  if (problem.G.cols() > 0 && solution.a.size() == problem.G.cols()) u += problem.G * solution.a;
  return u;
}

/// One line for each contact if the file names them, otherwise one for all pairs.
std::string forces_table(const contact::SavedProblem& saved, const contact::Solution& solution) {
  struct Sum {
    int open = 0, stick = 0, slip = 0;
    double normal = 0.0, largest = 0.0;
  };
  std::vector<Sum> sums(std::max<std::size_t>(1, saved.contacts.size()));
  for (std::size_t i = 0; i < solution.states.size(); ++i) {
    Sum& sum = sums[saved.contact_of_pair.empty() ? 0 : static_cast<std::size_t>(saved.contact_of_pair[i])];
    const contact::ContactState state = solution.states[i];
    ++(state == contact::ContactState::open ? sum.open : state == contact::ContactState::stick ? sum.stick : sum.slip);
    const double p_n = solution.p[static_cast<Eigen::Index>(i) * saved.problem.dimension];
    sum.normal += p_n;
    sum.largest = std::max(sum.largest, p_n);
  }
  // As in the tables of a run (result/report.hpp), a figure that is nothing but rounding is 0.
  const double rounding = solution.p.size() > 0 ? 1e-12 * solution.p.lpNorm<Eigen::Infinity>() : 0.0;
  const auto shown = [&](double force) { return fmt::format("{:.6g}", std::abs(force) <= rounding ? 0.0 : force); };
  std::vector<std::vector<std::string>> rows = {{"contact", "open", "stick", "slip", "normal force", "largest"}};
  for (std::size_t k = 0; k < sums.size(); ++k)
    rows.push_back({saved.contacts.empty() ? "all pairs" : saved.contacts[k], fmt::format("{}", sums[k].open),
                    fmt::format("{}", sums[k].stick), fmt::format("{}", sums[k].slip), shown(sums[k].normal),
                    shown(sums[k].largest)});
  return result::table(rows);
}

/// `Unique: several found (2 others, no more), bound 3.2, index 1`
std::string uniqueness_line(const contact::UniquenessReport& report) {
  std::string text = fmt::format("Unique: {}", contact::name_of(report.unique));
  if (!report.others.empty())
    text += fmt::format(" ({}{})", model::counted(static_cast<int>(report.others.size()), "other"),
                        report.complete ? ", no more" : "");
  text += std::isfinite(report.bound) ? fmt::format(", bound {:.3g}", report.bound) : ", bound does not apply";
  if (report.index != 0) text += fmt::format(", index {}", report.index);
  return text + "\n\n";
}

Json json_of(const contact::UniquenessReport& report) {
  Json json = {
      {"unique", contact::name_of(report.unique)}, {"others", report.others.size()}, {"complete", report.complete},
      {"bound", number_or_null(report.bound)},     {"index", report.index},          {"r", Json::array()}};
  for (const Vector& p : report.others) json["r"].push_back(list(p));
  return json;
}

}  // namespace

std::string_view spoken_name_of(contact::Status status) {
  return status == contact::Status::not_converged ? "did not converge" : contact::name_of(status);
}

std::string report_table(const std::string& file, const contact::SavedProblem& saved, const Judged& judged) {
  const contact::Problem& problem = saved.problem;
  const contact::Solution& solution = judged.solution;
  std::string text = fmt::format("{}: {}\n", file, saved.layout);
  if (!saved.title.empty()) text += saved.title + "\n";
  text += fmt::format("{} in {}D, {}", model::counted(problem.pairs(), "pair"), problem.dimension, describe_matrix(problem));
  if (problem.G.cols() > 0) text += ", " + model::counted(problem.G.cols(), "rigid motion");
  if (saved.start.p.size() > 0) text += ", with a start";

  std::string outcome(contact::name_of(solution.status));
  outcome[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(outcome[0])));
  std::replace(outcome.begin(), outcome.end(), '_', ' ');
  text += fmt::format(
      "\n\n{} by {}: {}{}, {:.3g} s\n\n", outcome, judged.solver, model::counted(solution.iterations, "iteration"),
      solution.coarse_iterations > 0 ? fmt::format(" and {} on fewer pairs", solution.coarse_iterations) : "",
      judged.seconds);

  if (judged.uniqueness) text += uniqueness_line(*judged.uniqueness);
  std::vector<std::vector<std::string>> rows = {{"certificate", fmt::format("tolerance {:.0e}", judged.tolerance), ""}};
  for (const auto& [name, value] : figures(solution.certificate))
    rows.push_back({name, fmt::format("{:.1e}", value), value <= judged.tolerance ? "" : "above the tolerance"});
  const double natural = solution.natural_map_residual, rounding = solution.rounding;
  rows.push_back({"natural_map_residual", fmt::format("{:.1e}", natural),
                  judged.by_certificate || natural <= judged.tolerance ? "" : "above the tolerance"});
  rows.push_back(
      {"rounding of W r", fmt::format("{:.1e}", rounding), rounding <= judged.tolerance ? "" : "above the tolerance"});
  return text + result::table(rows) + "\n" + forces_table(saved, solution);
}

std::string report_json(const std::string& file, const contact::SavedProblem& saved, const Judged& judged) {
  const contact::Problem& problem = saved.problem;
  const contact::Solution& solution = judged.solution;
  Json json = {{"status", contact::name_of(solution.status)},
               {"natural_map_residual", number_or_null(solution.natural_map_residual)},
               {"iterations", solution.iterations},
               {"coarse_iterations", solution.coarse_iterations},
               {"seconds", judged.seconds},
               {"solver", judged.solver},
               {"r", list(solution.p)},
               {"u", list(motion_of(problem, solution))},
               {"l", list(solution.a)}};
  if (saved.reduction && solution.p.size() == problem.q.size()) {
    const Vector motion = saved.reduction->motion(solution.p);
    const Eigen::Index n = saved.reduction->global().M.rows();
    json["v"] = list(motion.head(n));
    json["l"] = list(motion.tail(motion.size() - n));
  }
  json["states"] = Json::array();
  for (const contact::ContactState state : solution.states) json["states"].push_back(result::name_of(state));
  json["certificate"] = Json::object();
  for (const auto& [name, value] : figures(solution.certificate)) json["certificate"][name] = number_or_null(value);
  if (judged.uniqueness) json["uniqueness"] = json_of(*judged.uniqueness);
  json["tolerance"] = judged.tolerance;
  json["rounding"] = number_or_null(solution.rounding);
  json["judge"] = judged.by_certificate ? "certificate" : "natural_map";
  json["reason"] = solution.reason;
  if (solution.status == contact::Status::infeasible) json["proof"] = list(solution.proof);
  json["dimension"] = problem.dimension;
  json["pairs"] = problem.pairs();
  if (!saved.contact_of_pair.empty()) {
    json["contacts"] = saved.contacts;
    json["contact_of_pair"] = saved.contact_of_pair;
    json["number_of_pair"] = saved.number_of_pair;
  }
  json["file"] = file;
  json["layout"] = saved.layout;
  json["title"] = saved.title;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

const std::string_view trace_header = "iteration,stage,residual,merit,step_length,states_changed\n";

std::string report_trace(const contact::Solution& solution) {
  fmt::memory_buffer rows;
  fmt::format_to(std::back_inserter(rows), "{}", trace_header);
  for (const contact::Iteration& at : solution.trace)
    fmt::format_to(std::back_inserter(rows), "{},{},{},{},{},{}\n", at.iteration, result::csv_quoted(at.stage),
                   at.residual, at.merit, at.step_length, at.states_changed);
  return fmt::to_string(rows);
}

}  // namespace scabo::app
