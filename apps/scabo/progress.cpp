#include "progress.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/model/wording.hpp"
#include "scabo/run/static_run.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

// More lines per second cannot be read, and a terminal needs time for each.
constexpr std::chrono::milliseconds shortest_between_lines{50};

/// `4 iterations, 27 open, 0 stick, 5 slip`
std::string outcome_of(const analysis::IncrementResult& result) {
  std::string text = model::counted(result.newton_iterations, "iteration");
  if (result.coarse_iterations > 0) text += fmt::format(" and {} on fewer pairs", result.coarse_iterations);
  if (result.halvings > 0) text += fmt::format(", halved {}", model::counted(result.halvings, "time"));
  if (!result.converged) {
    for (const char* known : {"mechanism", "collapse"})
      if (result.reason.starts_with(known)) return text + ", " + known;
    return text + ", not converged";
  }
  if (result.contacts.empty()) return text;
  int open = 0, stick = 0, slip = 0;
  for (const analysis::ContactResult& contact : result.contacts) {
    open += contact.open;
    stick += contact.stick;
    slip += contact.slip;
  }
  return text + fmt::format(", {} open, {} stick, {} slip", open, stick, slip);
}

}  // namespace

Progress::Progress(bool quiet)
    : style_(quiet                  ? Style::silent
             : stderr_is_terminal() ? Style::terminal
                                    : Style::lines) {}

Progress::~Progress() { clear(); }

void Progress::stage(const std::string& name) {
  if (style_ != Style::terminal) return;  // if piped, stages would only add lines
  if (increments_ == 0) {
    show(name);
    return;
  }
  now_.clear();
  show_increment();
}

void Progress::iteration(const contact::Iteration& iteration) {
  if (style_ != Style::terminal || increments_ == 0) return;
  now_ = fmt::format(", iteration {}, residual {:.1e}", iteration.iteration, iteration.residual);
  show_increment();
}

void Progress::show_increment() {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_shown_ < shortest_between_lines) return;
  last_shown_ = now;
  show(fmt::format("{}{}{}{}", increment_at_work(), now_, time_left(), before_.empty() ? "" : "; before: " + before_));
}

void Progress::plan(const run::Plan& plan) {
  planned_dofs_ = plan.sizes.dofs;
  if (style_ == Style::silent) return;
  std::string text = run::describe(plan);
  if (style_ == Style::terminal && !run::is_long(plan)) {  // stays until the first stage is shown
    text.pop_back();
    show(text);
  } else {
    print_to_stderr(text);
  }
}

void Progress::meshed(const analysis::Discretisation& discretisation) {
  increments_ = run::increments_of(discretisation.model);
  for (const model::Step& step : discretisation.model.steps) automatic_ = automatic_ || !model::is_counted(step);
  time_left_.begin();
  const run::Sizes sizes = run::sizes_of(discretisation.model, discretisation.mesh);
  if (style_ == Style::lines && sizes.dofs != planned_dofs_) show(run::describe_sizes(sizes));
}

void Progress::resumed(int increments) { done_ = increments; }

void Progress::increment(const analysis::StaticSolution& solution, const analysis::IncrementResult& result) {
  before_ = outcome_of(result);
  if (style_ == Style::lines) {
    std::string step = solution.model.steps.size() > 1 ? fmt::format(" (step {})", result.step_name) : "";
    if (automatic_) step = fmt::format(" (step {}, {:.4g} %)", result.step_name, 100.0 * result.reached);
    show(fmt::format("{}{}: {}", increment_at_work(), step, before_));
  }
  time_left_.increment(run::part_done(solution.model, result), solution.increments.size() == 1);
  ++done_;
}

std::string Progress::increment_at_work() const {
  return automatic_ ? fmt::format("increment {}", done_ + 1)
                    : fmt::format("increment {} of {}", done_ + 1, increments_);
}

/// By the part of the steps that is done; the first seconds say little.
std::string Progress::time_left() const {
  const std::optional<double> left = time_left_.seconds();
  if (!left || time_left_.since() < 3.0 || *left < 5.0) return "";
  return fmt::format("; about {} left", run::duration_text(*left));
}

void Progress::clear() {
  if (!line_shown_) return;
  print_to_stderr("\r\033[K");
  line_shown_ = false;
}

void Progress::show(const std::string& line) {
  if (style_ == Style::lines) {
    print_to_stderr(line + "\n");
    return;
  }
  const size_t room = static_cast<size_t>(std::max(terminal_width() - 1, 1));
  print_to_stderr("\r\033[K" + line.substr(0, room));
  line_shown_ = true;
}

}  // namespace scabo::app
