#include "progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "sizes.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

// More than this many lines a second nobody can read, and a terminal takes its time for each.
constexpr std::chrono::milliseconds shortest_between_lines{50};

/// `increment 3 of 40: 4 iterations, 27 open, 0 stick, 5 slip`
std::string describe(const analysis::StaticSolution& solution, const analysis::IncrementResult& result,
                     int number) {
  const model::Model& model = solution.model;
  std::string text = fmt::format("increment {} of {}", number, increments_of(model));
  if (model.steps.size() > 1) text += fmt::format(" (step {})", result.step_name);
  text += ": " + count(result.newton_iterations, "iteration");
  if (result.halvings > 0) text += fmt::format(", halved {}", count(result.halvings, "time"));
  if (!result.converged) return text + ", not converged";
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
  // Piped, stages would be more lines than news.
  if (style_ == Style::terminal) show(last_increment_.empty() ? name : last_increment_ + "; " + name);
}

void Progress::meshed(const analysis::StaticSolution& solution) {
  if (style_ == Style::lines) show(describe_sizes(sizes_of(solution.model, solution.mesh)));
}

void Progress::increment(const analysis::StaticSolution& solution, const analysis::IncrementResult& result) {
  ++increments_done_;
  if (style_ == Style::silent) return;
  last_increment_ = describe(solution, result, increments_done_);
  const auto now = std::chrono::steady_clock::now();
  if (style_ == Style::terminal && now - last_shown_ < shortest_between_lines) return;
  last_shown_ = now;
  show(last_increment_);
}

void Progress::clear() {
  if (!line_shown_) return;
  fmt::print(stderr, "\r\033[K");
  line_shown_ = false;
}

void Progress::show(const std::string& line) {
  if (style_ == Style::lines) {
    fmt::print(stderr, "{}\n", line);
    return;
  }
  const size_t room = static_cast<size_t>(std::max(terminal_width() - 1, 1));
  fmt::print(stderr, "\r\033[K{}", line.substr(0, room));
  std::fflush(stderr);
  line_shown_ = true;
}

}  // namespace scabo::app
