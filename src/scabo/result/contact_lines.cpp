#include "scabo/result/contact_lines.hpp"

#include <initializer_list>

namespace scabo::result {

namespace {

constexpr std::uint8_t vtk_vertex = 1, vtk_line = 3;

std::uint8_t number_of(contact::ContactState state) {
  switch (state) {
    case contact::ContactState::open:
      return 0;
    case contact::ContactState::stick:
      return 1;
    case contact::ContactState::slip:
      return 2;
  }
  throw BrokenInvariant("a contact state without a number");
}

void add_vector(std::vector<double>& to, const Vec2& v) { to.insert(to.end(), {v.x(), v.y(), 0.0}); }

void add_cell(ContactLines& lines, std::uint8_t type, std::initializer_list<std::size_t> points, std::int32_t contact) {
  for (const std::size_t point : points) lines.connectivity.push_back(static_cast<std::int32_t>(point));
  lines.offsets.push_back(static_cast<std::int32_t>(lines.connectivity.size()));
  lines.types.push_back(type);
  lines.cell_contact.push_back(contact);
}

}  // namespace

ContactLines contact_lines(const analysis::IncrementResult& increment, const model::Analysis& analysis) {
  ContactLines lines;
  if (analysis.revolved()) lines.forces_of_radians = analysis.angle();
  for (std::size_t c = 0; c < increment.contacts.size(); ++c) {
    const auto number = static_cast<std::int32_t>(c + 1);
    const std::vector<analysis::PairResult>& pairs = increment.contacts[c].pairs;
    if (pairs.size() == 1) add_cell(lines, vtk_vertex, {lines.state.size()}, number);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const analysis::PairResult& pair = pairs[i];
      const std::size_t point = lines.state.size();
      if (i > 0) add_cell(lines, vtk_line, {point - 1, point}, number);
      const Vec2 &n = pair.normal, t = tangent_of(n);
      add_vector(lines.points, pair.position);
      lines.contact.push_back(number);
      lines.pair.push_back(pair.pair);
      lines.state.push_back(number_of(pair.state));
      lines.pressure.push_back(pair.pressure);
      lines.shear.push_back(pair.shear);
      lines.gap.push_back(pair.gap);
      lines.slip.push_back(pair.slip);
      lines.normal_force.push_back(pair.normal_force);
      lines.tangential_force.push_back(pair.tangential_force);
      add_vector(lines.traction, pair.pressure * n + pair.shear * t);
      add_vector(lines.displacement, pair.displacement_a.x() * n + pair.displacement_a.y() * t);
    }
  }
  return lines;
}

}  // namespace scabo::result
