// Fields of the cells of each rank, in a file of its own.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <utility>

#include "own_fields.hpp"
#include "scabo/base/components.hpp"
#include "scabo/result/vtu.hpp"
#include "share.hpp"

namespace scabo::mpi {

namespace {

void pack(Packer& packer, const element::LinearField& field) {
  packer.add(field.constant);
  packer.add(field.per_x);
  packer.add(field.per_y);
}
element::LinearField linear_field(Unpacker& unpacker) {
  element::LinearField field;
  field.constant = unpacker.get<double>();
  field.per_x = unpacker.get<double>();
  field.per_y = unpacker.get<double>();
  return field;
}

void pack(Packer& packer, const element::InitialStress& stress) {
  for (const element::Vec3& part : {stress.constant, stress.per_x, stress.per_y, stress.plain_constant})
    for (const double value : part) packer.add(value);
  pack(packer, stress.zz);
}
element::InitialStress initial_stress(Unpacker& unpacker) {
  element::InitialStress stress;
  for (element::Vec3* part : {&stress.constant, &stress.per_x, &stress.per_y, &stress.plain_constant})
    for (double& value : *part) value = unpacker.get<double>();
  stress.zz = linear_field(unpacker);
  return stress;
}

void pack(Packer& packer, const element::InteriorLoads& loads) {
  pack(packer, loads.temperature);
  packer.add(loads.loads.size());
  for (const element::RadialLoad& load : loads.loads) {
    packer.add(load.power);
    packer.add(load.g);
    packer.add(load.c);
  }
  packer.add(loads.remainders.size());
  for (const element::TemperatureRemainder& remainder : loads.remainders) {
    for (const Vec2& vector : {remainder.direction(), remainder.motion()})
      for (const double value : vector) packer.add(value);
    packer.add_list(remainder.places());
    packer.add_list(remainder.values());
  }
}
element::InteriorLoads interior_loads(Unpacker& unpacker) {
  element::InteriorLoads loads;
  loads.temperature = linear_field(unpacker);
  loads.loads.resize(unpacker.get<std::size_t>());
  for (element::RadialLoad& load : loads.loads) {
    load.power = unpacker.get<double>();
    load.g = unpacker.get_vector();
    load.c = unpacker.get_vector();
  }
  const auto remainders = unpacker.get<std::size_t>();
  for (std::size_t i = 0; i < remainders; ++i) {
    Vec2 direction, motion;
    for (Vec2* vector : {&direction, &motion})
      for (double& value : *vector) value = unpacker.get<double>();
    std::vector<double> places = unpacker.get_list<double>(), values = unpacker.get_list<double>();
    loads.remainders.emplace_back(direction, motion, std::move(places), std::move(values));
  }
  return loads;
}

/// The bodies of which this rank has a share, ascending.
using OwnShares = std::vector<std::pair<int, const Share*>>;

OwnShares own_shares(const std::map<int, std::unique_ptr<Share>>& shares) {
  OwnShares own;
  for (const auto& [id, share] : shares)
    for (const int body : share->bodies) own.emplace_back(body, share.get());
  std::sort(own.begin(), own.end());
  return own;
}

/// `of_root`: on rank 0, which has what is not divided.
std::unique_ptr<OwnFields> own_fields_of(const OwnShares& own, const model::Model& model,
                                         const analysis::Discretisation* of_root) {
  auto fields = std::make_unique<OwnFields>();
  analysis::Discretisation& of = fields->discretisation;
  of.model = model;
  const std::size_t bodies = of.model.bodies.size();
  fields->divided.assign(bodies, 0);
  fields->numbers.resize(bodies);
  fields->node_numbers.resize(bodies);
  of.mesh.bodies.resize(bodies);
  of.cells.resize(bodies);
  for (const auto& [body, share] : own) {
    const auto b = static_cast<std::size_t>(body);
    fields->divided[b] = 1;
    of.mesh.bodies[b] = share->mesh.bodies[b];
    of.cells[b] = share->cells[b];
    fields->numbers[b] = share->numbers[b];
    fields->node_numbers[b] = share->node_numbers[b];
  }
  for (std::size_t b = 0; b < bodies; ++b) {
    if (fields->divided[b]) continue;
    of.model.bodies[b].rigid = of_root && of.model.bodies[b].rigid;
    if (!of_root) continue;
    of.mesh.bodies[b] = of_root->mesh.bodies[b];
    of.cells[b] = of_root->cells[b];
  }
  return fields;
}

/// On rank 0 what each rank needs of a state; elsewhere nothing.
std::vector<Wanted> wanted_by_ranks(const Process& process, const OwnShares& own) {
  Packer has;
  std::vector<int> bodies;
  for (const auto& [body, share] : own) bodies.push_back(body);
  has.add_list(bodies);
  for (const auto& [body, share] : own) {
    has.add_list(share->cell_numbers[static_cast<std::size_t>(body)]);
    has.add_list(share->node_numbers[static_cast<std::size_t>(body)]);
  }
  std::vector<Wanted> of_ranks;
  for (const Bytes& bytes : process.collected(std::move(has).take())) {
    Unpacker unpacker(bytes);
    Wanted& wanted = of_ranks.emplace_back();
    wanted.bodies = unpacker.get_list<int>();
    for (std::size_t k = 0; k < wanted.bodies.size(); ++k) {
      wanted.cells.push_back(unpacker.get_list<int>());
      wanted.nodes.push_back(unpacker.get_list<int>());
    }
  }
  return of_ranks;
}

/// Which of a rank's own nodes other ranks have as well: OwnFields::is_shared. A rank has nodes that belong to another
/// one; the list of all such nodes is small.
std::vector<std::vector<char>> shared_nodes(const Process& process, const OwnShares& own, const OwnFields& fields) {
  Packer foreign;
  for (const auto& [body, share] : own) {
    std::vector<int> list;
    for (const int number : share->numbers[static_cast<std::size_t>(body)])
      if (number < share->first[static_cast<std::size_t>(process.rank())] ||
          number >= share->first[static_cast<std::size_t>(process.rank()) + 1])
        list.push_back(number);
    foreign.add_list(list);
  }
  std::vector<std::vector<int>> all(own.size());
  for (const Bytes& bytes : process.gathered(std::move(foreign).take())) {
    Unpacker unpacker(bytes);
    for (std::vector<int>& of_body : all) {
      const std::vector<int> list = unpacker.get_list<int>();
      of_body.insert(of_body.end(), list.begin(), list.end());
    }
  }
  std::vector<std::vector<char>> is_shared(fields.divided.size());
  for (std::size_t k = 0; k < own.size(); ++k) {
    std::sort(all[k].begin(), all[k].end());
    const auto b = static_cast<std::size_t>(own[k].first);
    for (const int number : fields.numbers[b])
      is_shared[b].push_back(std::binary_search(all[k].begin(), all[k].end(), number));
  }
  return is_shared;
}

Bytes pack_state(const analysis::Discretisation& discretisation, const analysis::IncrementResult& increment,
                 const std::filesystem::path& directory, const std::string& stem, const Wanted& wanted) {
  const analysis::FieldState& state = increment.fields;
  Packer packer;
  packer.add(directory.string());
  packer.add(stem);
  packer.add(discretisation.threads);
  packer.add_list(increment.absent);
  packer.add(state.reference_displacements.size());
  for (const Vec2& moved : state.reference_displacements) {
    packer.add(moved.x());
    packer.add(moved.y());
  }
  packer.add(state.initial.size());
  for (const element::InitialStress& stress : state.initial) pack(packer, stress);
  for (std::size_t k = 0; k < wanted.bodies.size(); ++k) {
    const auto b = static_cast<std::size_t>(wanted.bodies[k]);
    Vector u(places_of(wanted.nodes[k].size()));
    for (std::size_t i = 0; i < wanted.nodes[k].size(); ++i)
      u.segment<2>(place_of(i)) = state.displacements[b].segment<2>(place_of(wanted.nodes[k][i]));
    packer.add(u);
    const bool loaded = !state.interior[b].empty();
    packer.add(loaded);
    if (!loaded) continue;
    for (const int cell : wanted.cells[k])
      pack(packer, element::loads_in(state.interior[b], static_cast<std::size_t>(cell)));
  }
  return std::move(packer).take();
}

/// What rank 0 tells about a state: where its fields are written, and their values in own cells and nodes.
struct OwnState {
  std::filesystem::path directory;
  std::string stem;
  int threads = 1;
  std::vector<int> absent;
  analysis::FieldState fields;
};

/// `of_root`: on rank 0, which has what is not divided.
OwnState unpack_state(const Bytes& message, const OwnShares& own, std::size_t bodies,
                      const analysis::IncrementResult* of_root) {
  Unpacker unpacker(message);
  OwnState state;
  state.directory = unpacker.get_text();
  state.stem = unpacker.get_text();
  state.threads = unpacker.get<int>();
  state.absent = unpacker.get_list<int>();
  analysis::FieldState& fields = state.fields;
  fields.reference_displacements.resize(unpacker.get<std::size_t>());
  for (Vec2& moved : fields.reference_displacements)
    for (double& value : moved) value = unpacker.get<double>();
  const auto initial = unpacker.get<std::size_t>();
  for (std::size_t i = 0; i < initial; ++i) fields.initial.push_back(initial_stress(unpacker));
  fields.displacements.resize(bodies);
  fields.interior.resize(bodies);
  if (of_root) {
    fields.displacements = of_root->fields.displacements;
    fields.interior = of_root->fields.interior;
  }
  for (const auto& [body, share] : own) {
    const auto b = static_cast<std::size_t>(body);
    fields.displacements[b] = unpacker.get_vector();
    fields.interior[b].clear();
    if (!unpacker.get<bool>()) continue;
    for (std::size_t cell = 0; cell < share->cell_numbers[b].size(); ++cell)
      fields.interior[b].push_back(interior_loads(unpacker));
  }
  return state;
}

/// Adds to the sums at shared nodes what other ranks have there (result::CompleteSums).
class SumsOfRanks {
 public:
  SumsOfRanks(const Process& process, const OwnFields& fields)
      : process_(process), fields_(fields), nodes_(fields.divided.size()) {}

  void operator()(std::size_t body, const std::vector<int>& nodes, const std::vector<int>& materials,
                  result::SharedValues& sums, std::vector<int>& cells) {
    if (!fields_.divided[body]) return;
    nodes_[body] = nodes;
    const std::vector<int>& numbers = fields_.numbers[body];
    std::vector<Sum> mine;
    std::map<std::pair<int, int>, std::size_t> point_of;  // number, material
    for (std::size_t point = 0; point < nodes.size(); ++point) {
      const auto node = static_cast<std::size_t>(nodes[point]);
      if (!fields_.is_shared[body][node]) continue;
      const auto column = static_cast<Eigen::Index>(point);
      mine.push_back({numbers[node],
                      materials[point],
                      cells[point],
                      {sums(0, column), sums(1, column), sums(2, column), sums(3, column), sums(4, column)}});
      point_of[{numbers[node], materials[point]}] = point;
      sums.col(column).setZero();
      cells[point] = 0;
    }
    Packer packer;
    packer.add_list(mine);
    for (const Bytes& bytes : process_.gathered(std::move(packer).take())) {  // in the order of ranks, on every rank
      Unpacker of_rank(bytes);
      for (const Sum& sum : of_rank.get_list<Sum>()) {
        const auto found = point_of.find({sum.number, sum.material});
        if (found == point_of.end()) continue;
        sums.col(static_cast<Eigen::Index>(found->second)) += Eigen::Map<const Eigen::Vector<double, 5>>(sum.values);
        cells[found->second] += sum.cells;
      }
    }
  }

  /// [body]: own node of each point on the sides of cells, of divided ones.
  const std::vector<std::vector<int>>& nodes() const { return nodes_; }

 private:
  struct Sum {
    int number = 0, material = 0, cells = 0;
    double values[5] = {};  // stress, temperature, strain zz
  };

  const Process& process_;
  const OwnFields& fields_;
  std::vector<std::vector<int>> nodes_;
};

/// The node of its body of each point of a grid, -1 where it has none. The first points of an elastic body are its
/// nodes; of one that is divided, those follow where materials meet.
std::vector<std::int32_t> nodes_of_points(const result::Grid& grid, const OwnFields& own,
                                          const std::vector<std::vector<int>>& nodes_on_sides) {
  std::vector<std::int32_t> nodes(grid.point_count(), -1);
  for (std::size_t b = 0; b < own.divided.size(); ++b) {
    const auto [begin, end] =
        std::equal_range(grid.point_body.begin(), grid.point_body.end(), static_cast<std::int32_t>(b + 1));
    const auto first = static_cast<std::size_t>(begin - grid.point_body.begin());
    const bool divided = own.divided[b] != 0;
    const std::size_t count =
        std::min(divided ? nodes_on_sides[b].size() : own.discretisation.mesh.bodies[b].nodes.size(),
                 static_cast<std::size_t>(end - begin));
    for (std::size_t i = 0; i < count; ++i)
      nodes[first + i] =
          divided ? own.node_numbers[b][static_cast<std::size_t>(nodes_on_sides[b][i])] : static_cast<std::int32_t>(i);
  }
  return nodes;
}

/// Without the bodies that are absent.
void write_file(const std::filesystem::path& file, const OwnState& state, const OwnFields& own,
                const result::Fields& fields, const std::vector<std::vector<int>>& nodes_on_sides) {
  const analysis::Discretisation& of = own.discretisation;
  const auto write = [&](const result::Grid& grid, const result::Fields& values) {
    result::replace_file(file, result::vtu_content(grid, values, of.model.output.fields, of.threads,
                                                   nodes_of_points(grid, own, nodes_on_sides)));
  };
  const result::Grid& grid = own.recovery->grid();
  if (state.absent.empty()) {
    write(grid, fields);
  } else {
    const result::GridFields there = result::without_bodies(grid, fields, state.absent);
    write(there.grid, there.fields);
  }
}

}  // namespace

std::vector<std::string> Process::write_fields(const analysis::Discretisation* discretisation,
                                               const analysis::IncrementResult* increment,
                                               const std::filesystem::path* directory, const std::string* stem) {
  const OwnShares own = own_shares(shares_);
  const bool made = agreed([&] {
    if (!own_fields_) own_fields_ = own_fields_of(own, model(), discretisation);
  });
  if (!made) return {};
  OwnFields& mine = *own_fields_;
  if (mine.is_shared.empty()) {
    mine.of_ranks = wanted_by_ranks(*this, own);
    mine.is_shared = shared_nodes(*this, own, mine);
  }
  const Bytes message = distributed([&](int rank) {
    return pack_state(*discretisation, *increment, *directory, *stem, mine.of_ranks[static_cast<std::size_t>(rank)]);
  });
  const OwnState state = unpack_state(message, own, mine.divided.size(), increment);
  mine.discretisation.threads = state.threads;

  SumsOfRanks sums(*this, mine);
  result::Fields fields;
  together([&] {
    if (!mine.recovery) mine.recovery = std::make_unique<result::Recovery>(mine.discretisation, mine.divided);
    fields = mine.recovery->fields(mine.discretisation, state.fields, std::ref(sums));
  });
  std::vector<std::string> names;
  for (int rank = 0; rank < count_; ++rank) names.push_back(fmt::format("{}_{}.vtu", state.stem, rank));
  agreed(
      [&] { write_file(state.directory / names[static_cast<std::size_t>(rank_)], state, mine, fields, sums.nodes()); });
  return names;
}

}  // namespace scabo::mpi
