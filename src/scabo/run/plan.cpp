#include "scabo/run/plan.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <tuple>

#include "scabo/element/cell_library.hpp"
#include "scabo/element/plane/exact_riccati.hpp"
#include "scabo/element/plane/mirror_symmetry.hpp"
#include "scabo/element/plane/sectors.hpp"
#include "scabo/geometry/box.hpp"
#include "scabo/model/wording.hpp"
#include "scabo/result/report.hpp"
#include "scabo/system/contact_system.hpp"

namespace scabo::run {

namespace {

/// Analyses that take less are described by one line.
constexpr double long_seconds = 60.0;
constexpr double large_bytes = 2e9;

bool is_one_super_element(const mesh::BodyMesh& body) {
  return body.cells.size() == 1 && body.count(mesh::CellKind::superelement) == 1;
}

/// What the cost of a super-element depends on besides its degrees of freedom.
struct Effort {
  int blocks = 1;            ///< by symmetry
  bool last_digits = false;  ///< it gets them

  /// Of the stiffness, of n degrees of freedom.
  double seconds(double n, const CostConstants& costs) const {
    return (costs.dense_seconds + (last_digits ? costs.last_digits_seconds : 0.0)) * n * n * n / (blocks * blocks);
  }
  double bytes(double n, const CostConstants& costs) const {
    return (costs.block_bytes + (last_digits ? costs.last_digits_bytes : 0.0)) * n * n / blocks;
  }
};

Effort effort_of(const model::Model& model, const model::Body& body, const mesh::Cell& cell,
                 const std::vector<Vec2>& nodes) {
  const element::Ring ring = element::ring_of(cell, nodes);
  const element::Elasticity D = element::sectors_of(model, cell).D;
  Effort effort;
  effort.blocks = element::symmetry_block_count(ring, D);
  const auto rows = places_of(ring.nodes.size()) / effort.blocks;
  effort.last_digits = !body.outside && rows <= element::rows_with_last_digits(ring, D.contrast());
  return effort;
}

/// Whether coordinates have digits enough for equal cells to be seen as such (element/cell_library).
bool may_share_cells(const model::Body& body) {
  const geometry::Box box = geometry::box_of(body.outline);
  const double farthest = std::max(box.low.lpNorm<Eigen::Infinity>(), box.high.lpNorm<Eigen::Infinity>());
  return body.mesh.kind == model::MeshKind::quadtree &&
         std::numeric_limits<double>::epsilon() * farthest < element::most_apart * body.mesh.size;
}

double log2_of(double n) { return std::log2(std::max(n, 2.0)); }

double read_number_of(const std::string& file) {
  std::ifstream stream(file);
  double value = -1.0;
  stream >> value;  // `max`: no limit
  return stream ? value : -1.0;
}

/// Value of a line `key 123 kB` or `key 123`, in units of the line; -1 without one.
double read_line_of(const std::string& file, const std::string& key) {
  std::ifstream stream(file);
  std::string name;
  for (double value = 0.0; stream >> name; std::getline(stream, name))
    if (name == key && stream >> value) return value;
  return -1.0;
}

/// What the control group of this process leaves; file caches of the group count as free.
double left_in_group() {
  const double most = read_number_of("/sys/fs/cgroup/memory.max"),
               used = read_number_of("/sys/fs/cgroup/memory.current");
  if (most > 0.0 && used >= 0.0)
    return most - used + std::max(0.0, read_line_of("/sys/fs/cgroup/memory.stat", "inactive_file"));
  const std::string old = "/sys/fs/cgroup/memory/";
  const double limit = read_number_of(old + "memory.limit_in_bytes"),
               in_use = read_number_of(old + "memory.usage_in_bytes");
  if (limit > 0.0 && limit < 1e18 && in_use >= 0.0)  // a limit of 2^63 is none
    return limit - in_use + std::max(0.0, read_line_of(old + "memory.stat", "total_inactive_file"));
  return -1.0;
}

std::string size_text(double bytes) {
  const bool large = bytes >= 0.995e9;
  const double size = large ? bytes / 1e9 : std::max(bytes / 1e6, 10.0);
  const double unit = std::pow(10.0, std::floor(std::log10(size)) - 1.0);  // of the second digit
  return fmt::format("{:g} {}", unit * std::round(size / unit), large ? "GB" : "MB");
}

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 1.0) return "less than a second";
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

namespace {

/// What the parts of a plan are made from.
struct Estimate {
  const model::Model& model;
  const mesh::Mesh& mesh;
  const CostConstants& costs;
  std::vector<double> pairs;  // of each body
  double solutions = 1.0;     // increments and time steps
  double written = 0.0;       // fields of bodies, how many times
  // Of one factor of the bodies joined at their pairs:
  double joined_bytes = 0.0, joined_seconds = 0.0;
  std::set<std::tuple<std::size_t, int, bool, double>> known = {};  // equal bodies are solved once
};

std::vector<double> pairs_of_bodies(const model::Model& model, const mesh::Mesh& mesh) {
  std::vector<double> pairs(model.bodies.size(), 0.0);
  for (const mesh::Interface& interface : mesh.interfaces) {
    const model::Contact& contact = model.contacts[static_cast<std::size_t>(interface.contact)];
    const auto count = static_cast<double>(interface.pairs.size());
    pairs[static_cast<std::size_t>(contact.a.body)] += count;
    if (contact.b.body != contact.a.body) pairs[static_cast<std::size_t>(contact.b.body)] += count;
  }
  return pairs;
}

/// A body of `n` degrees of freedom that is one super-element, `k` of them on pairs.
void add_super_element(Estimate& estimate, std::size_t b, double n, double k, Plan& plan) {
  const CostConstants& costs = estimate.costs;
  const model::Body& body = estimate.model.bodies[b];
  const mesh::BodyMesh& mesh = estimate.mesh.bodies[b];
  const Effort effort = effort_of(estimate.model, body, mesh.cells.front(), mesh.nodes);
  const double work = n * n * n;
  const bool is_new =
      estimate.known
          .insert({mesh.nodes.size(), effort.blocks, effort.last_digits, geometry::outline_size(body.outline)})
          .second;
  plan.bytes += 8.0 * n * n + (is_new ? effort.bytes(n, costs) : 0.0);
  if (is_new) plan.cells += effort.seconds(n, costs);
  if (is_new && estimate.written > 0.0)
    plan.fields += costs.dense_field_seconds * work / (effort.blocks * effort.blocks);
  plan.factorise += costs.dense_factor_seconds * work;
  plan.condense += costs.dense_condense_seconds * n * n * k;
}

/// Super-elements among the cells of a body that cost more than the others.
void add_large_cells(const Estimate& estimate, std::size_t b, Plan& plan) {
  const CostConstants& costs = estimate.costs;
  const mesh::BodyMesh& mesh = estimate.mesh.bodies[b];
  for (const mesh::Cell& cell : mesh.cells) {
    if (cell.kind != mesh::CellKind::superelement) continue;
    const double m = 2.0 * static_cast<double>(cell.nodes().size());
    if (m < costs.least_large_cell) continue;
    const Effort effort = effort_of(estimate.model, estimate.model.bodies[b], cell, mesh.nodes);
    plan.bytes += 8.0 * m * m + effort.bytes(m, costs);
    plan.cells += effort.seconds(m, costs);
    if (estimate.written > 0.0) plan.fields += costs.dense_field_seconds * m * m * m / (effort.blocks * effort.blocks);
  }
}

/// A body of many cells.
void add_cells(Estimate& estimate, std::size_t b, double n, double k, Plan& plan) {
  const CostConstants& costs = estimate.costs;
  const model::Body& body = estimate.model.bodies[b];
  const bool fem = body.mesh.kind == model::MeshKind::fem, cells_differ = !fem && !may_share_cells(body);
  plan.bytes += costs.sparse_bytes * n + costs.fill_bytes * n * log2_of(n);
  if (cells_differ) {
    plan.bytes += costs.own_cell_bytes * n;
    plan.cells += costs.own_cell_seconds * n;
    plan.fields += estimate.written * costs.own_field_seconds * n;
  }
  add_large_cells(estimate, b, plan);
  plan.mesh += (fem ? costs.fem_mesh_seconds : costs.mesh_seconds) * n;
  if (cells_differ) plan.mesh += costs.own_mesh_seconds * n;
  plan.cells += costs.cell_seconds * n;
  const double operations = costs.factor_seconds + (cells_differ ? costs.own_factor_seconds : 0.0);
  const double factor = costs.order_seconds * n * log2_of(n) + operations * std::pow(n, 1.5);
  plan.factorise += factor;
  estimate.joined_bytes += costs.fill_bytes * n * log2_of(n);
  estimate.joined_seconds += 2.0 * factor;
  if (k > 0.0)
    plan.condense +=
        costs.sweep_seconds * n + costs.condense_seconds * k * std::sqrt(n) + costs.flexibility_seconds * k * k;
  plan.contact += 2.0 * estimate.solutions * costs.solve_seconds * n * log2_of(n);
}

/// Which bodies have a support, a spring or a tie; contact alone holds the others.
std::vector<char> held_bodies(const model::Model& model) {
  std::vector<char> held(model.bodies.size(), 0);
  const auto hold = [&](const model::Place& on) { held[static_cast<std::size_t>(on.body)] = 1; };
  for (const model::Support& support : model.supports) hold(support.on);
  for (const model::Spring& spring : model.springs) hold(spring.on);
  for (const model::Tie& tie : model.ties) hold(tie.a), hold(tie.b);
  return held;
}

/// The contact problems. W has a block for each body, dense within it; the systems of Newton's method are as sparse,
/// those of rigid bodies as small as their motions. Where contact alone holds a body, the stages of the contact solver
/// that follow Newton's method may have to take over.
void add_contact(const Estimate& estimate, Plan& plan) {
  const CostConstants& costs = estimate.costs;
  const double components = 2.0 * plan.sizes.contact_pairs;
  const std::vector<char> held = held_bodies(estimate.model);
  double blocks = 0.0, of_rigid = 0.0;
  for (std::size_t b = 0; b < estimate.model.bodies.size(); ++b) {
    const double block = 4.0 * estimate.pairs[b] * estimate.pairs[b];
    if (!estimate.model.bodies[b].rigid)
      blocks += block;
    else if (!held[b])
      of_rigid += block;
  }
  if (components > system::most_formed && blocks > system::most_filled * components * components) {
    plan.bytes += estimate.joined_bytes;
    plan.contact += costs.joined_iterations * estimate.solutions * estimate.joined_seconds;
    return;
  }
  plan.bytes += costs.contact_bytes * std::min(blocks + of_rigid, components * components);
  const double width = components > 0.0 ? blocks / (2.0 * components) : 0.0;  // of two bodies: all components
  const bool many_bodies = width < 0.5 * components;                          // W and the systems are sparse
  if (many_bodies) plan.bytes += costs.wall_bytes * components * width;
  const double iterations = costs.wall_first_iterations + costs.wall_iterations * (estimate.solutions - 1.0);
  plan.contact += many_bodies ? iterations * costs.wall_seconds * components * width
                              : estimate.solutions * costs.contact_seconds * components * components;
  if (of_rigid > 0.0) plan.contact += iterations * costs.rigid_seconds * components;
  if (std::find(held.begin(), held.end(), 0) == held.end()) return;
  const double step = many_bodies ? costs.wall_seconds * 0.5 * (blocks + of_rigid)
                                  : costs.interior_seconds * components * components * components;
  plan.interior = costs.interior_steps * estimate.solutions * step;
}

}  // namespace

Plan plan_of(const model::Model& model, const mesh::Mesh& mesh, const CostConstants& costs) {
  Plan plan;
  plan.sizes = sizes_of(model, mesh);
  plan.increments = increments_of(model);
  plan.bytes = costs.base_bytes;
  Estimate estimate{model, mesh, costs, pairs_of_bodies(model, mesh), solutions_of(model, mesh)};
  if (model.output.fields.any_of_bodies())
    estimate.written = std::ceil(static_cast<double>(plan.increments) / model.output.every);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const model::Body& body = model.bodies[b];
    plan.first_mesh_only = plan.first_mesh_only || body.mesh.tolerance || model.tolerance;
    if (body.rigid) continue;
    const double n = 2.0 * static_cast<double>(mesh.bodies[b].nodes.size());
    const double k = std::min(2.0 * estimate.pairs[b], n);
    if (is_one_super_element(mesh.bodies[b]))
      add_super_element(estimate, b, n, k, plan);
    else
      add_cells(estimate, b, n, k, plan);
    const bool fem = body.mesh.kind == model::MeshKind::fem;
    plan.fields += estimate.written * (fem ? costs.fem_field_seconds : costs.field_seconds) * n;
  }
  add_contact(estimate, plan);
  if (model::is_dynamic(model)) plan.factorise *= 2.0, plan.condense *= 2.0;  // at rest, and of a time step
  return plan;
}

bool is_long(const Plan& plan) { return plan.seconds() > long_seconds || plan.bytes > large_bytes; }

std::string describe(const Plan& plan) {
  std::string text = fmt::format("{}; about {} of memory, {}", describe_sizes(plan.sizes), size_text(plan.bytes),
                                 duration_text(plan.seconds()));
  if (const double most = plan.seconds() + plan.interior; most >= 1.0 && most > 2.0 * plan.seconds())
    text += fmt::format(", up to {} where contact takes interior points", duration_text(most));
  if (plan.first_mesh_only) text += ", on the first mesh; refinement needs more";
  text += '\n';
  if (!is_long(plan)) return text;
  std::vector<std::vector<std::string>> rows = {{"stage", "about"}};
  const auto add = [&](const std::string& stage, double seconds) {
    if (seconds >= 1.0) rows.push_back({stage, duration_text(seconds)});
  };
  add("mesh", plan.mesh);
  add("super-elements", plan.cells);
  add("factorisation", plan.factorise);
  add("condensation to the contact pairs", plan.condense);
  add(model::counted(plan.increments, "increment"), plan.contact);
  add("fields and files", plan.fields);
  return text + result::table(rows);
}

std::optional<Memory> available_memory() {
  std::optional<Memory> least;
  const auto consider = [&](double bytes, const char* limit) {
    if (bytes >= 0.0 && (!least || bytes < least->bytes)) least = Memory{bytes, limit};
  };
  if (const double kilobytes = read_line_of("/proc/meminfo", "MemAvailable:"); kilobytes >= 0.0)
    consider(1024.0 * (kilobytes + std::max(0.0, read_line_of("/proc/meminfo", "SwapFree:"))), "this machine");
  consider(left_in_group(), "the limit of this container");
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    if (const double kilobytes = read_line_of("/proc/self/status", "VmSize:"); kilobytes >= 0.0)
      consider(static_cast<double>(limit.rlim_cur) - 1024.0 * kilobytes, "`ulimit -v`");
  return least;
}

std::string why_it_does_not_fit(const Plan& plan, const std::optional<Memory>& available, std::string_view anyway) {
  const CostConstants costs;
  if (!available || plan.bytes - costs.base_bytes <= available->bytes) return {};  // the program is there already
  return fmt::format(
      "not enough memory: the analysis needs about {}, and {} leaves {}: make the mesh coarser, use a larger machine, "
      "or {}",
      size_text(plan.bytes), available->limit, size_text(available->bytes), anyway);
}

}  // namespace scabo::run
