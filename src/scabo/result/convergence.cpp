#include "scabo/result/convergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "scabo/result/contact_table.hpp"

namespace scabo::result {

const std::string_view convergence_table_header =
    "step,increment,attempt,iteration,stage,residual,merit,step_length,states_changed\n";
const std::string_view convergence_plot_mark = "<!-- Convergence of the contact solver, by Scabo -->";

namespace {

using Text = std::back_insert_iterator<fmt::memory_buffer>;

constexpr double width = 820.0, height = 500.0;                            // of the plot, pixels
constexpr double left = 84.0, right = 620.0, top = 56.0, bottom = 440.0;   // of the frame
constexpr std::size_t most_curves = 60, most_names = 16, most_named = 19;  // drawn; names aimed at; names at most
constexpr double least_residual = 1e-17;                                   // drawn for zero
constexpr const char* red = "#d62728";

/// From dark violet (0) through green to yellow (1): readable in grey and with colour blindness.
std::string colour(double t) {
  constexpr std::array<std::array<double, 3>, 5> stops = {
      {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {223, 205, 35}}};
  const double at = std::clamp(t, 0.0, 1.0) * (stops.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double part = at - static_cast<double>(k);
  const auto mixed = [&](std::size_t c) {
    return static_cast<int>(std::lround((1 - part) * stops[k][c] + part * stops[k + 1][c]));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mixed(0), mixed(1), mixed(2));
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '&')
      result += "&amp;";
    else if (c == '"')
      result += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      result += c;
  }
  return result;
}

/// Maps iterations to x and residuals to y.
class Axes {
 public:
  Axes(const std::vector<ConvergenceCurve>& curves, double tolerance) {
    double low = tolerance, high = 1e-2;
    for (const ConvergenceCurve& curve : curves)
      for (const contact::Iteration& at : curve.iterations) {
        last_ = std::max(last_, at.iteration);
        if (!std::isfinite(at.residual)) continue;
        low = std::min(low, std::max(at.residual, least_residual));
        high = std::max(high, at.residual);
      }
    low_ = std::floor(std::log10(low) - 0.3);
    high_ = std::min(std::ceil(std::log10(high) + 0.5), 30.0);  // room for the name of a stage
  }
  double x(double iteration) const { return left + (right - left) * iteration / last_; }
  double y(double residual) const {
    const double decade = std::isfinite(residual) ? std::log10(std::max(residual, least_residual)) : high_;
    return bottom - (bottom - top) * (std::clamp(decade, low_, high_) - low_) / (high_ - low_);
  }

  void draw(Text to) const {
    const int decades = static_cast<int>(high_ - low_), every = std::max(1, (decades + 9) / 10);
    for (int k = 0; k <= decades; k += every) {
      const int power = static_cast<int>(low_) + k;
      const double at = y(std::pow(10.0, power));
      fmt::format_to(to, "<line class=\"grid\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>\n", left,
                     right, at, at);
      fmt::format_to(to,
                     "<text class=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">10<tspan class=\"power\" "
                     "dy=\"-5\">{}</tspan></text>\n",
                     left - 8, at + 4, power < 0 ? fmt::format("\u2212{}", -power) : fmt::format("{}", power));
    }
    int step = 1;
    for (int k = 0; last_ / step > 10; ++k) step = k % 3 == 1 ? step / 2 * 5 : 2 * step;  // 1, 2, 5, 10, 20, 50 ...
    for (int at = 0; at <= last_; at += step) {
      fmt::format_to(to, "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\"/>\n", x(at),
                     top, bottom);
      fmt::format_to(to, "<text class=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x(at), bottom + 20, at);
    }
    fmt::format_to(to, "<rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", left,
                   top, right - left, bottom - top);
    fmt::format_to(to, "<text class=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">iteration</text>\n", 0.5 * (left + right),
                   bottom + 44);
    fmt::format_to(
        to, "<text class=\"middle\" transform=\"translate(26 {:.1f}) rotate(-90)\">residual / largest force</text>\n",
        0.5 * (top + bottom));
  }

 private:
  int last_ = 1;
  double low_ = -12.0, high_ = 0.0;
};

/// Whether an iteration belongs to a problem of fewer pairs, which makes the start (stage `newton, 65 pairs`).
bool is_coarse(const contact::Iteration& at) { return at.stage.find(',') != std::string::npos; }

/// With more points than this the curve would be hidden.
constexpr std::size_t most_points = 200;

bool shows_coarse_points(const ConvergenceCurve& curve) {
  return curve.iterations.size() <= most_points &&
         std::any_of(curve.iterations.begin(), curve.iterations.end(), is_coarse);
}

void draw_curve(Text to, const Axes& axes, const ConvergenceCurve& curve, const std::string& stroke, bool name_stages) {
  const bool crowded = curve.iterations.size() > 40;
  fmt::format_to(to, "<g stroke=\"{0}\" fill=\"{0}\"{1}><title>{2}</title>", stroke,
                 crowded && !name_stages ? " opacity=\"0.45\"" : "", escaped(curve.name));
  // A separate line for every start: when a joint breaks or another stage begins, the iteration number does not
  // advance.
  const std::string begin =
      fmt::format("<polyline class=\"curve\"{} points=\"", curve.converged ? "" : " stroke-dasharray=\"5 3\"");
  for (std::size_t k = 0; k < curve.iterations.size(); ++k) {
    const contact::Iteration& at = curve.iterations[k];
    if (k == 0 || at.iteration <= curve.iterations[k - 1].iteration)
      fmt::format_to(to, "{}{}", k == 0 ? "" : "\"/>", begin);
    fmt::format_to(to, "{:.1f},{:.1f} ", axes.x(at.iteration), axes.y(at.residual));
  }
  if (!curve.iterations.empty()) fmt::format_to(to, "\"/>");
  const std::string* stage = nullptr;
  std::vector<std::pair<double, double>> names;  // where they are
  for (const contact::Iteration& at : curve.iterations) {
    const double x = axes.x(at.iteration), y = axes.y(at.residual);
    if (curve.iterations.size() <= most_points)
      fmt::format_to(to, "<circle{} cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>", is_coarse(at) ? " class=\"coarse\"" : "",
                     x, y, crowded ? "1.6" : "2.6");
    if (name_stages && (!stage || *stage != at.stage)) {
      double name_y = y - 7;
      const auto covers = [&](const auto& other) {
        return std::abs(x - other.first) < 150.0 && std::abs(name_y - other.second) < 12.9;
      };
      while (names.size() < 50 && std::any_of(names.begin(), names.end(), covers)) name_y -= 13.0;
      names.emplace_back(x, name_y);
      fmt::format_to(to, "<text class=\"stage\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", x + 6, name_y, escaped(at.stage));
    }
    stage = &at.stage;
  }
  fmt::format_to(to, "</g>\n");
}

void draw_legend(Text to, const std::vector<const ConvergenceCurve*>& curves, const std::vector<std::string>& colours,
                 std::size_t left_out) {
  const double x = right + 20;
  double y = top + 10;
  const auto entry = [&](const std::string& stroke, const std::string& name) {
    fmt::format_to(to,
                   "<line class=\"curve\" stroke=\"{0}\" x1=\"{1:.1f}\" x2=\"{2:.1f}\" y1=\"{3:.1f}\" y2=\"{3:.1f}\"/>",
                   stroke, x, x + 22, y);
    fmt::format_to(to, "<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x + 30, y + 4, escaped(name.substr(0, 60)));
    y += 19;
  };
  // Names of all curves, or of the first, the last and some between; of those that did not converge, as many as there
  // is room for.
  const std::size_t every = (curves.size() + most_names - 1) / most_names;
  std::size_t unnamed = 0, room = most_named;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const bool last = k + 1 == curves.size();
    if (k % every != 0 && !last && curves[k]->converged) continue;
    if (room > 1 || (last && room > 0)) {
      entry(colours[k], curves[k]->name);
      --room;
    } else {
      ++unnamed;
    }
  }
  if (unnamed > 0)
    fmt::format_to(to, "<text class=\"note\" x=\"{:.1f}\" y=\"{:.1f}\">{} more without name</text>\n", x, y + 4,
                   unnamed),
        y += 19;
  if (left_out > 0)
    fmt::format_to(to, "<text class=\"note\" x=\"{:.1f}\" y=\"{:.1f}\">{} more are not drawn</text>\n", x, y + 4,
                   left_out);
}

/// Explanation of hollow points, below the names.
void draw_coarse_note(Text to) {
  const double x = right + 20, y = bottom + 18;
  fmt::format_to(to, "<circle class=\"coarse\" stroke=\"#222\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\"/>", x + 8, y - 4);
  for (const auto& [line, text] : {std::pair(0, "coarse problem, of every"), std::pair(1, "second, fourth, ... pair:"),
                                   std::pair(2, "the next starts from it")})
    fmt::format_to(to, "<text class=\"note\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x + 22, y + 14 * line, text);
}

}  // namespace

std::string convergence_table_rows(const analysis::IncrementResult& increment) {
  fmt::memory_buffer rows;
  for (std::size_t attempt = 0; attempt < increment.attempts.size(); ++attempt)
    for (const contact::Iteration& at : increment.attempts[attempt].iterations)
      fmt::format_to(std::back_inserter(rows), "{},{},{},{},{},{},{},{},{}\n", increment.step, increment.increment,
                     attempt + 1, at.iteration, csv_quoted(at.stage), at.residual, at.merit, at.step_length,
                     at.states_changed);
  return fmt::to_string(rows);
}

std::string convergence_plot(const std::vector<ConvergenceCurve>& all, const std::string& title, double tolerance) {
  std::vector<const ConvergenceCurve*> curves;
  std::vector<std::string> colours;
  const std::size_t every = (all.size() + most_curves - 1) / most_curves;
  const auto failed = static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [](const ConvergenceCurve& curve) { return !curve.converged; }));
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool wanted = !all[k].converged && failed <= most_curves;
    if (!wanted && k % every != 0 && k + 1 != all.size()) continue;
    curves.push_back(&all[k]);
    colours.push_back(all[k].converged
                          ? colour(all.size() > 1 ? static_cast<double>(k) / static_cast<double>(all.size() - 1) : 0.25)
                          : red);
  }
  fmt::memory_buffer text;
  const Text to(text);
  fmt::format_to(to, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{}\n", convergence_plot_mark);
  fmt::format_to(to,
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\">\n",
                 width, height);
  fmt::format_to(to, R"(<style>
  text {{ font: 13px system-ui, "Helvetica Neue", Arial, sans-serif; fill: #222; stroke: none }}
  .title {{ font-size: 16px }} .power {{ font-size: 9px }} .middle {{ text-anchor: middle }} .end {{ text-anchor: end }}
  .note, .stage {{ font-size: 11px; fill: #555 }}
  .grid {{ stroke: #e4e4e4 }} .frame {{ fill: none; stroke: #444 }} .tolerance {{ stroke: #888; stroke-dasharray: 2 3 }}
  .coarse {{ fill: white }}
  .curve {{ fill: none; stroke-width: 1.6; stroke-linejoin: round }}
</style>
<rect width="100%" height="100%" fill="white"/>
)");
  fmt::format_to(to, "<text class=\"title\" x=\"{:.1f}\" y=\"32\">{}</text>\n", left, escaped(title));
  const Axes axes(all, tolerance);
  axes.draw(to);
  fmt::format_to(to, "<line class=\"tolerance\" x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/>\n", left,
                 right, axes.y(tolerance));
  fmt::format_to(to, "<text class=\"note\" x=\"{:.1f}\" y=\"{:.1f}\">tolerance</text>\n", left + 6,
                 axes.y(tolerance) - 5);
  for (std::size_t k = 0; k < curves.size(); ++k) draw_curve(to, axes, *curves[k], colours[k], all.size() == 1);
  draw_legend(to, curves, colours, all.size() - curves.size());
  if (std::any_of(curves.begin(), curves.end(), [](const auto* curve) { return shows_coarse_points(*curve); }))
    draw_coarse_note(to);
  fmt::format_to(to, "</svg>\n");
  return fmt::to_string(text);
}

std::string convergence_plot(const analysis::StaticSolution& solution) {
  std::vector<ConvergenceCurve> curves;
  for (const analysis::IncrementResult& increment : solution.increments)
    for (std::size_t attempt = 0; attempt < increment.attempts.size(); ++attempt) {
      std::string name = fmt::format("{} {}", increment.step_name, increment.increment);
      if (increment.attempts.size() > 1) name += fmt::format(", attempt {}", attempt + 1);
      curves.push_back({std::move(name), increment.attempts[attempt].iterations, increment.attempts[attempt].accepted});
    }
  return convergence_plot(curves, solution.model.title.empty() ? "Convergence" : solution.model.title,
                          solution.model.solver.tolerance);
}

}  // namespace scabo::result
