#include "ranks.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "scabo/base/components.hpp"
#include "share.hpp"

namespace scabo::mpi {

/// From the order of a part's degrees of freedom to that among all ranks, and back.
class Order {
 public:
  explicit Order(const std::vector<int>& number) : number_(number) {}
  Eigen::Index size() const { return places_of(number_.size()); }
  Eigen::Index operator[](Eigen::Index dof) const {
    return place_of(number_[static_cast<std::size_t>(plane_components.node_of(dof))],
                    plane_components.component_of(dof));
  }
  template <typename Values>
  Values there(const Values& here) const {
    Values result(here.size());
    for (Eigen::Index dof = 0; dof < size(); ++dof) at(result, (*this)[dof]) = at(here, dof);
    return result;
  }
  template <typename Values>
  Values here(const Values& there) const {
    Values result(there.size());
    for (Eigen::Index dof = 0; dof < size(); ++dof) at(result, dof) = at(there, (*this)[dof]);
    return result;
  }

 private:
  template <typename Values>
  static auto& at(Values& values, Eigen::Index i) {
    return values[static_cast<
        typename std::conditional_t<std::is_same_v<std::remove_const_t<Values>, Vector>,
                                    std::type_identity<Eigen::Index>, std::type_identity<std::size_t>>::type>(i)];
  }
  std::vector<int> number_;
};

class DividedFactor final : public linalg::SparseFactor {
 public:
  /// place[i]: unknown i among those of all ranks.
  DividedFactor(PetscRanks& ranks, int id, std::vector<int> place) : ranks_(ranks), id_(id), place_(std::move(place)) {}
  ~DividedFactor() override {
    ranks_.all({Command::release_factor, id_}, [&] { ranks_.process_.release_factor(id_); });
  }
  Matrix solve(const Matrix& B) const override {
    Matrix X(B.rows(), B.cols()), there(B.rows(), B.cols());
    for (Eigen::Index j = 0; j < B.cols(); ++j)
      for (Eigen::Index i = 0; i < B.rows(); ++i) there(place(i), j) = B(i, j);
    ranks_.all({Command::solve, id_}, [&] { ranks_.process_.solve(id_, &there); });
    for (Eigen::Index j = 0; j < B.cols(); ++j)
      for (Eigen::Index i = 0; i < B.rows(); ++i) X(i, j) = there(place(i), j);
    return X;
  }
  Matrix inverse_block(const std::vector<int>& indices) const override {
    if (indices.empty()) return {};
    std::vector<int> wanted;
    for (const int index : indices) wanted.push_back(place(index));
    if (ranks_.process_.is_condensed(id_)) return ranks_.process_.condensed_block(id_, wanted);
    std::vector<int> distinct = wanted;
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    ensure(distinct.size() < 46341, "MUMPS counts entries of the inverse with 32 bits");
    Matrix block;
    ranks_.all({Command::inverse_block, id_}, [&] { ranks_.process_.inverse_block(id_, &distinct, &block); });
    std::vector<Eigen::Index> places;
    for (const int index : wanted)
      places.push_back(std::lower_bound(distinct.begin(), distinct.end(), index) - distinct.begin());
    const Matrix all = block(places, places);
    return 0.5 * (all + all.transpose());
  }

 private:
  int place(Eigen::Index i) const { return place_[static_cast<std::size_t>(i)]; }
  PetscRanks& ranks_;
  int id_;
  std::vector<int> place_;
};

class DividedPart final : public system::DividedStiffness {
 public:
  DividedPart(PetscRanks& ranks, int id, const Division& division, const ShareFacts& facts)
      : ranks_(ranks), id_(id), order_(division.number), node_at_(division.number.size()), facts_(facts) {
    for (std::size_t node = 0; node < division.step.size(); ++node)
      node_at_[static_cast<std::size_t>(division.step[node])] = division.number[node];
  }
  ~DividedPart() override {
    ranks_.all({Command::release_share, id_}, [&] { ranks_.process_.release_share(id_); });
  }
  Eigen::Index size() const override { return order_.size(); }
  double entries() const override { return facts_.entries; }
  double largest_diagonal() const override { return facts_.largest_diagonal; }
  double rounding() const override { return facts_.rounding; }

  Vector times(const Vector& u) const override {
    const Vector there = order_.there(u);
    Vector product;
    ranks_.all({Command::multiply, id_}, [&] { ranks_.process_.multiply(id_, &there, &product); });
    return order_.here(product);
  }
  Vector times_squares(const Vector& u) const override {
    const Vector there = order_.there(u);
    Vector product;
    ranks_.all({Command::multiply_squares, id_}, [&] { ranks_.process_.multiply_squares(id_, &there, &product); });
    return order_.here(product);
  }
  linalg::TwofoldVector times(const linalg::TwofoldVector& u) const override {
    const linalg::TwofoldVector there = order_.there(u);
    linalg::TwofoldVector product;
    ranks_.all({Command::multiply_twofold, id_}, [&] { ranks_.process_.multiply_twofold(id_, &there, &product); });
    return order_.here(product);
  }

  std::unique_ptr<linalg::SparseFactor> factorise(const std::vector<int>& dofs, const system::InclinedNodes& inclined,
                                                  const linalg::SparseMatrix& springs,
                                                  const std::vector<int>& contact_dofs,
                                                  linalg::FactorisationCosts& costs) const override {
    FactorRequest request;
    request.solved.assign(static_cast<std::size_t>(size()), 0);
    for (const int dof : dofs) request.solved[static_cast<std::size_t>(order_[dof])] = 1;
    if (!inclined.none())
      for (int node = 0; node < plane_components.node_of(size()); ++node)
        if (const auto* M = inclined.of(node))
          request.inclined.push_back(
              {plane_components.node_of(order_[place_of(node)]), {(*M)(0, 0), (*M)(0, 1), (*M)(1, 0), (*M)(1, 1)}});
    for (Eigen::Index j = 0; j < springs.cols(); ++j)
      for (linalg::SparseMatrix::InnerIterator it(springs, j); it; ++it)
        request.springs.push_back({static_cast<int>(order_[it.row()]), static_cast<int>(order_[j]), it.value()});
    std::vector<int> before(static_cast<std::size_t>(size()));  // number of solved ones before each
    for (std::size_t i = 0, count = 0; i < before.size(); ++i) {
      before[i] = static_cast<int>(count);
      if (request.solved[i]) ++count;
    }
    const auto unknown = [&](int dof) { return before[static_cast<std::size_t>(order_[dof])]; };
    std::vector<int> place;
    for (const int dof : dofs) place.push_back(unknown(dof));
    for (const int dof : contact_dofs)
      if (request.solved[static_cast<std::size_t>(order_[dof])]) request.condensed.push_back(unknown(dof));
    std::sort(request.condensed.begin(), request.condensed.end());
    request.step = steps_of(request.condensed, request.solved);
    int id = 0;
    {
      const std::lock_guard lock(ranks_.one_at_a_time_);
      id = ranks_.next_id_++;
    }
    const FactorFacts facts =
        ranks_.all({Command::factorise, id, id_}, [&] { return ranks_.process_.factorise(id, id_, &request); });
    if (!facts.definite) throw linalg::NotPositiveDefinite();
    costs.analyse += facts.costs.analyse;
    costs.factorise += facts.costs.factorise;
    costs.entries += facts.costs.entries;
    costs.operations += facts.costs.operations;
    return std::make_unique<DividedFactor>(ranks_, id, std::move(place));
  }

 private:
  /// FactorRequest::step: those of the nodes, and of the condensed unknowns after all others.
  std::vector<int> steps_of(const std::vector<int>& condensed, const std::vector<char>& solved) const {
    std::vector<int> before(solved.size() / 2);  // number of solved ones before each node
    int count = 0;
    for (std::size_t i = 0; i < solved.size(); ++i) {
      if (i % 2 == 0) before[i / 2] = count;
      if (solved[i]) ++count;
    }
    std::vector<int> step(static_cast<std::size_t>(count), -1);
    int last = count;
    for (auto k = condensed.rbegin(); k != condensed.rend(); ++k) step[static_cast<std::size_t>(*k)] = --last;
    int next = 0;
    for (const int node : node_at_) {
      int unknown = before[static_cast<std::size_t>(node)];
      for (std::size_t i = 0; i < 2; ++i) {
        if (!solved[static_cast<std::size_t>(place_of(node)) + i]) continue;
        int& at = step[static_cast<std::size_t>(unknown++)];
        if (at < 0) at = next++;
      }
    }
    return step;
  }

  PetscRanks& ranks_;
  int id_;
  Order order_;
  std::vector<int> node_at_;  // which node is eliminated at each step, among all ranks
  ShareFacts facts_;
};

std::shared_ptr<const system::DividedStiffness> PetscRanks::stiffness(const model::Model& model, const mesh::Mesh& mesh,
                                                                      const system::Dofs& dofs, std::size_t part,
                                                                      int threads) {
  const std::lock_guard lock(one_at_a_time_);
  const Division division = divide_cells(mesh, dofs, part, count());
  SharePacker packer(mesh, dofs, part, division, threads);
  process_.use(model);
  const int id = next_id_++;
  announce({Command::divide, id});
  const ShareFacts facts = process_.divide(id, [&](int rank) { return packer.of(rank); });
  return std::make_shared<const DividedPart>(*this, id, division, facts);
}

bool PetscRanks::any() const { return process_.has_shares(); }

std::vector<std::string> PetscRanks::write(const analysis::Discretisation& discretisation,
                                           const analysis::IncrementResult& increment,
                                           const std::filesystem::path& directory, const std::string& stem) {
  return all({Command::write_fields},
             [&] { return process_.write_fields(&discretisation, &increment, &directory, &stem); });
}

void PetscRanks::begin(const std::string& file, const std::vector<std::string>& settings,
                       const std::filesystem::path& directory, double divide_from) {
  divide_from_ = divide_from;
  all({Command::read_model}, [&] { process_.read_model(&file, &settings, &directory); });
}

int PetscRanks::threads_of_a_rank() const {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / process_.on_this_machine());
}

double PetscRanks::part_on_this_machine() const {
  return static_cast<double>(process_.on_this_machine()) / static_cast<double>(process_.count());
}

void PetscRanks::end() {
  all({Command::end}, [] {});
}

namespace {

/// Both sides of a broadcast that is waited for with pauses: while rank 0 works alone, the others take no processor
/// from it.
void exchange(MPI_Comm comm, Announcement& what) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibcast(&what, static_cast<int>(sizeof what), MPI_BYTE, 0, comm, &request);
  std::chrono::microseconds pause{1};
  for (int done = 0;;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done) return;
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::microseconds{500});
  }
}

}  // namespace

void PetscRanks::announce(const Announcement& what) {
  Announcement copy = what;
  exchange(process_.comm(), copy);
}

void serve(Process& process) {
  for (;;) {
    Announcement what;
    exchange(process.comm(), what);
    switch (what.command) {
      case Command::end:
        return;
      case Command::read_model:
        process.read_model(nullptr, nullptr, nullptr);
        break;
      case Command::divide:
        process.divide(what.id, {});
        break;
      case Command::multiply:
        process.multiply(what.id, nullptr, nullptr);
        break;
      case Command::multiply_squares:
        process.multiply_squares(what.id, nullptr, nullptr);
        break;
      case Command::multiply_twofold:
        process.multiply_twofold(what.id, nullptr, nullptr);
        break;
      case Command::factorise:
        process.factorise(what.id, what.other, nullptr);
        break;
      case Command::solve:
        process.solve(what.id, nullptr);
        break;
      case Command::inverse_block:
        process.inverse_block(what.id, nullptr, nullptr);
        break;
      case Command::release_share:
        process.release_share(what.id);
        break;
      case Command::release_factor:
        process.release_factor(what.id);
        break;
      case Command::write_fields:
        process.write_fields(nullptr, nullptr, nullptr, nullptr);
        break;
    }
  }
}

}  // namespace scabo::mpi
