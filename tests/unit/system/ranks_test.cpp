// A body whose stiffness is elsewhere behaves as one whose stiffness is here. Ranks are stood in for by one that has
// all rows; real ones are compared in regression.cluster.
#include "scabo/system/ranks.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scabo/element/cell_library.hpp"
#include "scabo/system/assembly.hpp"
#include "scabo/system/body_system.hpp"
#include "unit/mesh/models.hpp"

namespace scabo::system {
namespace {

using namespace test;

class FactorElsewhere final : public linalg::SparseFactor {
 public:
  explicit FactorElsewhere(const linalg::SparseMatrix& A) : solver_(A) {}
  Matrix solve(const Matrix& B) const override { return solver_.solve(B); }
  Matrix inverse_block(const std::vector<int>& indices) const override { return solver_.inverse_block(indices); }

 private:
  linalg::SymmetricPositiveSolver solver_;
};

class StiffnessElsewhere final : public DividedStiffness {
 public:
  explicit StiffnessElsewhere(linalg::SparseMatrix K) : K_(std::move(K)) {}
  Eigen::Index size() const override { return K_.rows(); }
  double entries() const override { return static_cast<double>(K_.nonZeros()); }
  double largest_diagonal() const override { return Vector(K_.diagonal()).maxCoeff(); }
  double rounding() const override { return 1e-15; }
  Vector times(const Vector& u) const override { return K_ * u; }
  linalg::TwofoldVector times(const linalg::TwofoldVector& u) const override { return linalg::product(K_, u); }
  Vector times_squares(const Vector& u) const override { return K_.cwiseAbs2() * u; }
  std::unique_ptr<linalg::SparseFactor> factorise(const std::vector<int>& dofs, const InclinedNodes& inclined,
                                                  const linalg::SparseMatrix& springs, const std::vector<int>&,
                                                  linalg::FactorisationCosts& costs) const override {
    linalg::SparseMatrix whole = K_;
    if (springs.size() > 0) whole += springs;
    const linalg::SparseMatrix turned = inclined.none() ? whole : inclined.stiffness(whole);
    costs.operations += 1.0;
    const Matrix all(turned);
    return std::make_unique<FactorElsewhere>(linalg::SparseMatrix(Matrix(all(dofs, dofs)).sparseView()));
  }

 private:
  linalg::SparseMatrix K_;
};

class OtherProcess final : public Ranks {
 public:
  explicit OtherProcess(double from) : from_(from) {}
  int count() const override { return 2; }
  double divide_from() const override { return from_; }
  std::shared_ptr<const DividedStiffness> stiffness(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs,
                                                    std::size_t part, int threads) override {
    const auto cells = element::solve_cells(model, mesh, threads);
    ++divided;
    return std::make_shared<const StiffnessElsewhere>(part_stiffness(model, mesh, cells, dofs, part, threads).sparse);
  }
  int divided = 0;

 private:
  double from_;
};

/// A quadtree of 8 x 8 cells and one super-element.
model::Model two_bodies() {
  model::Model model;
  model.file = "model.yaml";
  model.materials.resize(1);
  model.materials[0].name = "steel";
  model.materials[0].young = 10e9;
  model.materials[0].poisson = 0.3;
  model.bodies.push_back(elastic("many", rectangle({0.0, 0.0}, {1.0, 1.0}), 0.125));
  model.bodies.back().mesh.kind = model::MeshKind::quadtree;
  model.bodies.push_back(elastic("one", rectangle({2.0, 0.0}, {1.0, 1.0}), 0.25));
  for (model::Body& body : model.bodies) body.material = 0;
  return model;
}

/// Two nodes of the lower side are held along x and y, one along a slope, and a spring acts at the last node.
std::unique_ptr<BodySystem> held(Stiffness stiffness, const std::vector<Vec2>& nodes, bool with_spring) {
  std::vector<Constraint> constraints;
  for (const int dof : {0, 1}) constraints.push_back({dof, Vec2::Zero(), dof, false, 0, 1e-3 * dof});
  const Eigen::Vector3d slope = Eigen::Vector3d(1.0, 2.0, 0.0).normalized();
  constraints.push_back({10, Vec2::Zero(), -1, false, 0, 0.0, slope});
  if (with_spring) {
    const Eigen::Index n = stiffness.size();
    stiffness.springs.matrix.resize(n, n);
    stiffness.springs.matrix.insert(n - 1, n - 1) = 3e9;
    stiffness.springs.matrix.makeCompressed();
    stiffness.springs.directions.push_back({nodes.back(), Vec2::UnitY()});
  }
  return elastic_body(std::move(stiffness), nodes, std::move(constraints));
}

TEST(BodyElsewhere, MovesAsOneThatIsHere) {
  const model::Model model = two_bodies();
  const mesh::Mesh mesh = mesh::make_mesh(model);
  const auto cells = element::solve_cells(model, mesh, 1);
  const linalg::SparseMatrix K = body_stiffness(model, model.analysis.thickness, mesh.bodies[0], cells[0]).sparse;
  for (const bool with_spring : {false, true}) {
    Stiffness here, elsewhere;
    here.sparse = K;
    elsewhere.divided = std::make_shared<const StiffnessElsewhere>(K);
    const auto expected = held(std::move(here), mesh.bodies[0].nodes, with_spring);
    const auto found = held(std::move(elsewhere), mesh.bodies[0].nodes, with_spring);
    ASSERT_EQ(found->size(), expected->size());
    Vector f = Vector::LinSpaced(expected->size(), -1e5, 2e5);
    const Vector prescribed = Eigen::Vector3d(0.0, 1e-3, 0.0);
    const Vector u = expected->displacement(f, prescribed), v = found->displacement(f, prescribed);
    const double size = u.lpNorm<Eigen::Infinity>();
    EXPECT_LT((u - v).lpNorm<Eigen::Infinity>(), 1e-12 * size);
    EXPECT_LT((expected->reactions(u, f) - found->reactions(u, f)).lpNorm<Eigen::Infinity>(),
              1e-9 * f.lpNorm<Eigen::Infinity>());
    EXPECT_NEAR(found->elastic_energy(u), expected->elastic_energy(u), 1e-12 * expected->elastic_energy(u));
    EXPECT_NEAR(found->energy_lost(u), expected->energy_lost(u), 1e-3 * expected->energy_lost(u));
    EXPECT_DOUBLE_EQ(found->stiff_force(u), expected->stiff_force(u));
    const std::vector<int> dofs{3, 10, 11, 40, 41, 90};
    const Matrix A = expected->flexibility(dofs);
    EXPECT_LT((A - found->flexibility(dofs)).cwiseAbs().maxCoeff(), 1e-12 * A.cwiseAbs().maxCoeff());
  }
}

TEST(Ranks, DivideLargeBodiesOfManyCellsOnly) {
  const model::Model model = two_bodies();
  const mesh::Mesh mesh = mesh::make_mesh(model);
  const auto flags = [&](double from) {
    const OtherProcess ranks(from);
    return divided_bodies(&ranks, model, mesh);
  };
  EXPECT_EQ(flags(100.0), (std::vector<char>{1, 0}));
  EXPECT_EQ(flags(1.0), (std::vector<char>{1, 0}));  // one super-element cannot be divided
  EXPECT_EQ(flags(1e6), (std::vector<char>{0, 0}));
  EXPECT_TRUE(divided_bodies(nullptr, model, mesh).empty());
}

TEST(Ranks, CellsOfDividedBodiesAreSolvedWhenTheyAreNeeded) {
  const model::Model model = two_bodies();
  const mesh::Mesh mesh = mesh::make_mesh(model);
  const auto here = element::solve_cells(model, mesh, 1), elsewhere = element::solve_cells(model, mesh, 1, {1, 0});
  for (std::size_t b = 0; b < 2; ++b)
    for (std::size_t c = 0; c < here[b].size(); ++c) {
      EXPECT_EQ(elsewhere[b][c]->K(), here[b][c]->K());
      EXPECT_EQ(elsewhere[b][c]->rounding(), here[b][c]->rounding());
    }
}

}  // namespace
}  // namespace scabo::system
