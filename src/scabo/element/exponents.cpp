#include "scabo/element/exponents.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/element/cell_library.hpp"
#include "scabo/linalg/dense.hpp"
#include "scabo/linalg/ordered_schur.hpp"
#include "scabo/mesh/mesh.hpp"

namespace scabo::element {

namespace {

constexpr double alike = 1e-6;  // defective exponents are separated by about the root of rounding

/// Whether the exponents of one cluster have fewer modes than their number. Exponents of different symmetry blocks do
/// not couple.
bool is_defective(const element::SuperElementSolution& solution, std::complex<double> value) {
  for (const element::Block& block : solution.blocks) {
    const linalg::OrderedSchur schur(block.S, [&](std::complex<double> z) {
      return std::abs(std::complex<double>(z.real(), std::abs(z.imag())) - value) <= 10.0 * alike ? 0 : 1;
    });
    if (linalg::is_defective(schur.group(0), 10.0 * alike)) return true;
  }
  return false;
}

void explain(Exponent& exponent, const element::SolvedSuperElement& of) {
  const bool unbounded = of.domain.unbounded, open = of.ring.is_open();
  const auto add = [&](const char* words) {
    exponent.meaning += (exponent.meaning.empty() ? "" : ", ") + std::string(words);
  };
  if (exponent.value == 0.0) return add(of.held ? "translation" : "translations");
  if (unbounded) return;
  if (std::abs(exponent.value - 1.0) <= alike && !of.held)
    add(open ? (exponent.multiplicity > 1 ? "rotation, T-stress" : "rotation") : "rotation, constant strains");
  if (exponent.singular) add("singular");
  if (exponent.singular && exponent.value.imag() != 0.0) add("oscillating");
  if (exponent.defective) add("defective: power-logarithmic");
}

BodyExponents of_super_element(const element::SolvedSuperElement& super_element) {
  BodyExponents found;
  const bool unbounded = super_element.domain.unbounded, open = super_element.ring.is_open();
  found.kind = unbounded ? "outside" : super_element.held ? "open, held" : open ? "open" : "closed";
  found.dofs = static_cast<int>(super_element.K().rows());
  std::vector<std::complex<double>> values = super_element.held
                                                 ? element::solve_held(super_element.ring, super_element.sectors.D,
                                                                       super_element.thickness, *super_element.held)
                                                       .exponents
                                                 : super_element.modes().exponents;
  const std::vector<int> cluster = linalg::clusters(values, alike);
  for (int c = 0, found_in = 1; found_in > 0; ++c) {
    std::complex<double> sum = 0.0;
    int upper = 0;
    found_in = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (cluster[i] != c) continue;
      ++found_in;
      if (values[i].imag() >= 0.0) sum += values[i], ++upper;
    }
    if (found_in == 0) break;
    Exponent exponent;
    exponent.value = sum / static_cast<double>(upper);
    // Equal real exponents may be computed as a complex pair, a root of rounding apart.
    const bool pairs = exponent.value.imag() > alike;
    if (!pairs) exponent.value = exponent.value.real();
    exponent.multiplicity = pairs ? upper : found_in;
    exponent.singular = !unbounded && exponent.value.real() > 0.0 && exponent.value.real() < 1.0 - 1e-4;
    if (exponent.value != 0.0 && exponent.multiplicity > 1 && !super_element.held)
      exponent.defective = is_defective(super_element.solution(), exponent.value);
    explain(exponent, super_element);
    found.exponents.push_back(std::move(exponent));
  }
  return found;
}

}  // namespace

std::vector<BodyExponents> exponents_of(const model::Model& model) {
  linalg::set_blas_threads(1);
  const auto cells = element::solve_cells(model, mesh::make_mesh(model), 1);
  std::vector<BodyExponents> all;
  for (std::size_t b = 0; b < cells.size(); ++b)
    for (const auto& cell : cells[b]) {
      const bool worth_it = cell && (cells[b].size() == 1 || cell->ring.is_open());  // ordinary cells have none
      if (!worth_it) continue;
      all.push_back(of_super_element(*cell));
      all.back().body = static_cast<int>(b);
    }
  return all;
}

}  // namespace scabo::element
