#include "events.hpp"

#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scabo/analysis/diagnostics/mechanism.hpp"
#include "scabo/result/summary.hpp"
#include "scabo/result/version.hpp"
#include "scabo/run/failures.hpp"
#include "scabo/run/static_run.hpp"
#include "startup.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

using Json = nlohmann::ordered_json;

// A watcher shows a few iterations a second; a small model has thousands.
constexpr std::chrono::milliseconds shortest_between_iterations{100};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

template <typename Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

/// One line; text that is not UTF-8, as in names of files, keeps what is.
std::string line_of(const char* event, double t, Json content) {
  Json json = {{"event", event}, {"t", t}};
  json.update(content);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

const char* name_of(ExitStatus status, const std::optional<analysis::Outcome>& outcome) {
  if (status > ExitStatus::signalled) return "interrupted";
  switch (status) {
    case ExitStatus::solved:
      return "solved";
    case ExitStatus::wrong_input:
      return "wrong_input";
    case ExitStatus::not_converged:
      if (outcome == analysis::Outcome::mechanism) return "mechanism";
      return outcome == analysis::Outcome::collapse ? "collapse" : "not_converged";
    default:
      return "failed";
  }
}

}  // namespace

Events::Events(bool on) : wanted_(on), on_(on), begun_(start_) {
  if (on) ignore_broken_pipes();
}

ExitStatus Events::around(const std::string& command, const std::function<ExitStatus()>& run) {
  if (!on_) return run();
  write(
      line_of("start", 0.0, {{"schema", 1}, {"version", result::version()}, {"command", command}, {"pid", getpid()}}));
  try {
    const ExitStatus status = run();
    finished(status);
    return status;
  } catch (const InputError& mistakes) {
    const bool of_an_option = is_of_an_option(mistakes);  // no file is wrong
    for (const Diagnostic& mistake : mistakes.diagnostics()) {
      const bool placed = mistake.at.line > 0;
      write(line_of("error", seconds_since(start_),
                    {{"text", of_an_option ? format_diagnostic(mistakes.file(), mistake) : mistake.message},
                     {"file", of_an_option ? Json() : Json(mistakes.file())},
                     {"line", placed ? Json(mistake.at.line) : Json()},
                     {"column", placed ? Json(mistake.at.column) : Json()},
                     {"path", mistake.at.path.empty() ? Json() : Json(mistake.at.path)}}));
    }
    finished(ExitStatus::wrong_input);
    throw;
  } catch (const std::bad_alloc&) {
    error(run::not_enough_memory);
    finished(ExitStatus::failure);
    throw;
  } catch (const std::exception& failure) {
    error(failure.what());
    finished(ExitStatus::failure);
    throw;
  }
}

void Events::files(const std::string& model, const std::filesystem::path& directory, const char* analysis) {
  if (!on_) return;
  end_stage();
  write(line_of("model", seconds_since(start_),
                {{"model", model}, {"directory", directory.string()}, {"analysis", analysis}}));
}

void Events::plan(const run::Plan& plan) {
  if (!on_) return;
  end_stage();
  write(line_of("plan", seconds_since(start_),
                {{"bodies", plan.sizes.bodies},
                 {"nodes", plan.sizes.nodes},
                 {"dofs", plan.sizes.dofs},
                 {"super_elements", plan.sizes.super_elements},
                 {"finite_elements", plan.sizes.finite_elements},
                 {"contact_pairs", plan.sizes.contact_pairs},
                 {"increments", plan.increments},
                 {"bytes", plan.bytes},
                 {"seconds", plan.seconds()},
                 {"stages",
                  {{"mesh", plan.mesh},
                   {"super_elements", plan.cells},
                   {"factorise", plan.factorise},
                   {"condense", plan.condense},
                   {"increments", plan.contact},
                   {"fields", plan.fields}}},
                 {"first_mesh_only", plan.first_mesh_only}}));
}

void Events::stage(const std::string& name) {
  if (!on_ || increment_) return;  // the name of a stage that is an increment repeats what its begin has said
  end_stage();
  stage_ = name;
  begun_ = Clock::now();
  write(line_of("stage_begin", seconds_since(start_), {{"stage", name}}));
}

void Events::end_stage() {
  if (!stage_) return;
  write(line_of("stage_end", seconds_since(start_), {{"stage", *stage_}, {"seconds", seconds_since(begun_)}}));
  stage_.reset();
}

void Events::increment_begin(const analysis::IncrementBegin& begin) {
  if (!on_) return;
  end_stage();
  increment_ = begin;
  begun_ = Clock::now();
  write(line_of("increment_begin", seconds_since(start_),
                {{"step", begin.step},
                 {"step_name", begin.step_name},
                 {"increment", begin.increment},
                 {"increments", or_null(begin.increments)}}));
}

void Events::iteration(const contact::Iteration& iteration) {
  if (!on_ || !increment_ || Clock::now() - last_iteration_ < shortest_between_iterations) return;
  last_iteration_ = Clock::now();
  write(line_of("iteration", seconds_since(start_),
                {{"iteration", iteration.iteration},
                 {"residual", number(iteration.residual)},
                 {"states_changed", iteration.states_changed},
                 {"method", iteration.stage}}));
}

namespace {

/// Where cracks have come to.
Json json_of(const analysis::GrowthResult& growth) {
  Json tips = Json::object();
  for (const analysis::TipResult& tip : growth.tips)
    tips[tip.name] = {number(tip.position.x()), number(tip.position.y())};
  return {{"load_factor", number(growth.load_factor)}, {"cycles", or_null(growth.cycles)}, {"tips", tips}};
}

}  // namespace

void Events::increment_end(const model::Model& model, const analysis::IncrementResult& result, bool is_first) {
  if (!on_) return;
  if (!increment_) increment_begin({result.step, result.step_name, result.increment, std::nullopt});
  const double done = run::part_done(model, result);
  time_left_.increment(done, is_first);
  int open = 0, stick = 0, slip = 0;
  for (const analysis::ContactResult& contact : result.contacts) {
    open += contact.open;
    stick += contact.stick;
    slip += contact.slip;
  }
  const bool converged = result.converged;
  const Json pairs = converged ? Json{{"open", open}, {"stick", stick}, {"slip", slip}} : Json();
  write(line_of("increment_end", seconds_since(start_),
                {{"step", result.step},
                 {"step_name", result.step_name},
                 {"increment", result.increment},
                 {"reached", result.reached},
                 {"converged", converged},
                 {"residual", number(result.residual)},
                 {"certificate", number(result.certificate.worst())},
                 {"iterations", result.newton_iterations},
                 {"coarse_iterations", result.coarse_iterations},
                 {"halvings", result.halvings},
                 {"pairs", pairs},
                 {"growth", result.growth ? json_of(*result.growth) : Json()},
                 {"reason", result.reason.empty() ? Json() : Json(result.reason)},
                 {"seconds", seconds_since(begun_)},
                 {"done", done},
                 {"seconds_left", converged ? or_null(time_left_.seconds()) : Json()}}));
  increment_.reset();
}

void Events::warning(const Warning& warning) {
  if (on_)
    write(line_of("warning", seconds_since(start_), {{"kind", scabo::name_of(warning.kind)}, {"text", warning.text}}));
}

void Events::warning(const std::string& text) {
  if (on_) write(line_of("warning", seconds_since(start_), {{"kind", "output"}, {"text", text}}));
}

void Events::error(const std::string& text) {
  if (!on_) return;
  write(line_of("error", seconds_since(start_),
                {{"text", text}, {"file", nullptr}, {"line", nullptr}, {"column", nullptr}, {"path", nullptr}}));
}

void Events::not_solved(const analysis::StaticSolution& solution) {
  outcome_ = solution.outcome;
  if (solution.mechanism) mechanism_ = analysis::describe(*solution.mechanism, solution.model);
}

void Events::print_summary(const std::string& text) const {
  wanted_ ? print_to_stderr(text) : app::print_summary(text);
}

void Events::finished(ExitStatus status) {
  end_stage();
  write(line_of("finished", seconds_since(start_),
                {{"status", name_of(status, outcome_)},
                 {"exit_status", static_cast<int>(status)},
                 {"mechanism", or_null(mechanism_)}}));
}

void Events::write(std::string line) {
  std::string_view rest = line;
  while (on_ && !rest.empty()) {
    const ssize_t count = ::write(STDOUT_FILENO, rest.data(), rest.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) on_ = false;  // there is no reader, or the disk is full: the results are files
    if (count > 0) rest.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace scabo::app
