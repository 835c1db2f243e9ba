#include "scabo/result/solid/solid_mechanism_cells.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/result/solid/solid_cells.hpp"
#include "scabo/result/solid/solid_faces.hpp"

namespace scabo::result {

namespace {

void add_cell(const std::vector<std::int32_t>& corners, std::int32_t first, std::uint8_t type, double motion,
              std::int32_t body, std::int32_t contact, SolidMechanismCells& cells) {
  for (const std::int32_t corner : corners) cells.connectivity.push_back(first + corner);
  cells.offsets.push_back(static_cast<std::int32_t>(cells.connectivity.size()));
  cells.types.push_back(type);
  cells.motion.push_back(motion);
  cells.body.push_back(body);
  cells.contact.push_back(contact);
}

void add_point(const Eigen::Vector3d& x, const analysis::SolidBodyMotion& motion, std::int32_t body,
               SolidMechanismCells& cells) {
  const Eigen::Vector3d u = motion.largest > 0.0 ? motion.at(x) : Eigen::Vector3d::Zero();
  cells.points.insert(cells.points.end(), x.data(), x.data() + 3);
  cells.displacement.insert(cells.displacement.end(), u.data(), u.data() + 3);
  cells.point_body.push_back(body);
}

void add_body(const mesh::SolidMesh& mesh, const analysis::SolidBodyMotion& motion, std::int32_t number,
              SolidMechanismCells& cells) {
  const auto first = static_cast<std::int32_t>(cells.point_body.size());
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i) add_point(mesh.nodes.col(i), motion, number, cells);
  for (const std::vector<int>& cell : mesh.cells)
    add_cell({cell.begin(), cell.end()}, first, vtk_type(cell.size()), motion.largest, number, 0, cells);
  cells.opening.resize(cells.point_body.size(), 0.0);
  cells.slip.resize(3 * cells.point_body.size(), 0.0);
  cells.pair.resize(cells.point_body.size(), 0);
}

void add_faces(const analysis::SolidModel& model, const analysis::SolidMechanism& mechanism,
               SolidMechanismCells& cells) {
  analysis::SolidIncrement moved;
  moved.pairs = mechanism.pairs;
  const SolidFaces faces = solid_faces(model, moved);
  const auto first = static_cast<std::int32_t>(cells.point_body.size());
  std::vector<double> largest(model.contacts.size(), 0.0);
  for (std::size_t i = 0; i < faces.pair.size(); ++i) {
    const auto contact = static_cast<std::size_t>(faces.contact[i] - 1);
    const int body = model.contacts[contact].a.body;
    add_point(Eigen::Vector3d(faces.points.data() + 3 * i), mechanism.bodies[static_cast<std::size_t>(body)], body + 1,
              cells);
    largest[contact] = std::max({largest[contact], std::abs(faces.gap[i]),
                                 Eigen::Map<const Eigen::Vector3d>(faces.slip.data() + 3 * i).norm()});
  }
  cells.opening.insert(cells.opening.end(), faces.gap.begin(), faces.gap.end());
  cells.slip.insert(cells.slip.end(), faces.slip.begin(), faces.slip.end());
  cells.pair.insert(cells.pair.end(), faces.pair.begin(), faces.pair.end());
  for (std::size_t i = 0; i < faces.types.size(); ++i) {
    const auto start = faces.connectivity.begin() + (i > 0 ? faces.offsets[i - 1] : 0);
    add_cell({start, faces.connectivity.begin() + faces.offsets[i]}, first, faces.types[i],
             largest[static_cast<std::size_t>(faces.cell_contact[i] - 1)], 0, faces.cell_contact[i], cells);
  }
}

}  // namespace

SolidMechanismCells solid_mechanism_cells(const analysis::SolidModel& model,
                                          const analysis::SolidMechanism& mechanism) {
  SolidMechanismCells cells;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!mechanism.is_absent(b))
      add_body(model.bodies[b].mesh, mechanism.bodies[b], static_cast<std::int32_t>(b + 1), cells);
  add_faces(model, mechanism, cells);
  return cells;
}

}  // namespace scabo::result
