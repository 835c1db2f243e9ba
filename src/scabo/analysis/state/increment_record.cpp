#include "scabo/analysis/state/increment_record.hpp"

#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace scabo::analysis {

namespace {

template <typename T>
constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Writes values one after the other.
class Packer {
 public:
  std::string bytes;

  template <typename T>
  requires is_plain<T>
  void operator()(T& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }
  /// Number of items that follow; the container already has them.
  template <typename Container>
  void resize(Container& items) {
    std::uint64_t count = items.size();
    (*this)(count);
  }
  template <typename T>
  bool has(std::optional<T>& value) {
    bool there = value.has_value();
    (*this)(there);
    return there;
  }
  static constexpr bool reads = false;
};

/// Reads them back.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : left_(bytes) {}

  template <typename T>
  requires is_plain<T>
  void operator()(T& value) {
    if (left_.size() < sizeof value) throw std::out_of_range("the record is too short");
    std::memcpy(&value, left_.data(), sizeof value);
    left_.remove_prefix(sizeof value);
  }
  template <typename Container>
  void resize(Container& items) {
    std::uint64_t count = 0;
    (*this)(count);
    if (count > left_.size()) throw std::out_of_range("the record is too short");  // every item has a byte
    items.resize(count);
  }
  template <typename T>
  bool has(std::optional<T>& value) {
    bool there = false;
    (*this)(there);
    if (there) value.emplace();
    return there;
  }
  bool at_end() const { return left_.empty(); }
  static constexpr bool reads = true;

 private:
  std::string_view left_;
};

// One function for each type, for both directions.

template <typename Io, typename T>
requires is_plain<T>
void exchange(Io& io, T& value) { io(value); }
template <typename Io>
void exchange(Io& io, std::string& text) {
  io.resize(text);
  for (char& letter : text) io(letter);
}
template <typename Io>
void exchange(Io& io, Vec2& value) {
  io(value[0]), io(value[1]);
}
template <typename Io>
void exchange(Io& io, std::complex<double>& value) {
  double real = value.real(), imaginary = value.imag();
  io(real), io(imaginary);
  value = {real, imaginary};
}
template <typename Io, typename T>
void exchange(Io& io, std::optional<T>& value) {
  if (io.has(value)) exchange(io, *value);
}
template <typename Io, typename T>
void exchange(Io& io, std::vector<T>& items) {
  io.resize(items);
  for (T& item : items) exchange(io, item);
}
template <typename Io>
void exchange(Io& io, std::map<std::string, double>& values) {
  std::vector<std::pair<std::string, double>> items(values.begin(), values.end());
  io.resize(items);
  for (auto& [name, value] : items) exchange(io, name), io(value);
  if constexpr (Io::reads) values = {items.begin(), items.end()};
}
template <typename Io>
void exchange(Io& io, contact::Certificate& of) {
  for (double* value : {&of.equilibrium, &of.penetration, &of.tension, &of.friction_excess, &of.complementarity,
                        &of.slip_direction, &of.rigid_balance, &of.energy_balance})
    io(*value);
}
template <typename Io>
void exchange(Io& io, contact::Iteration& of) {
  io(of.iteration), io(of.residual), io(of.merit), io(of.step_length), io(of.states_changed);
  exchange(io, of.stage);
}
template <typename Io>
void exchange(Io& io, AttemptResult& of) {
  exchange(io, of.iterations);
  io(of.accepted);
}
template <typename Io>
void exchange(Io& io, ContactResult& of) {
  exchange(io, of.name);
  exchange(io, of.pore_force);
  io(of.normal_force), io(of.tangential_force);
  exchange(io, of.force);
  io(of.moment);
  exchange(io, of.centre_of_pressure);
  io(of.open), io(of.stick), io(of.slip);
  exchange(io, of.broken);
  io(of.max_gap), io(of.min_gap), io(of.max_pressure);
  exchange(io, of.first_in_contact);
  exchange(io, of.last_in_contact);
}
template <typename Io>
void exchange(Io& io, element::CornerTerm& of) {
  exchange(io, of.exponents);
  exchange(io, of.factors);
  exchange(io, of.limit);
  io(of.defective);
}
template <typename Io>
void exchange(Io& io, CrackResult& of) {
  io(of.held);
  exchange(io, of.name);
  element::StressIntensity& factors = of.factors;
  io(factors.kind);
  exchange(io, factors.exponents);
  io(factors.reference_length), io(factors.epsilon), io(factors.K_I), io(factors.K_II);
  exchange(io, factors.T_left), exchange(io, factors.T_right);
  exchange(io, factors.G), exchange(io, factors.J);
  io(factors.ray);
  exchange(io, factors.terms);
}
template <typename Io>
void exchange(Io& io, UniquenessResult& of) {
  exchange(io, of.verdict);
  io(of.others), io(of.complete), io(of.bound), io(of.index);
}
template <typename Io>
void exchange(Io& io, Energy& of) {
  for (double* value : {&of.external, &of.elastic, &of.friction, &of.friction_error, &of.kinetic, &of.damping,
                        &of.impact, &of.projection, &of.massless})
    io(*value);
}
template <typename Io>
void exchange(Io& io, PairsFound& of) {
  io(of.times), io(of.jump);
}
template <typename Io>
void exchange(Io& io, TipResult& of) {
  exchange(io, of.name);
  exchange(io, of.position);
  io(of.length), io(of.opening), io(of.K_I), io(of.K_II);
  exchange(io, of.T), exchange(io, of.G);
  io(of.kink), io(of.load_factor), io(of.grows);
  exchange(io, of.range), exchange(io, of.meets);
}
template <typename Io>
void exchange(Io& io, GrowthEnergy& of) {
  io(of.external), io(of.elastic), io(of.contact), io(of.released), io(of.integral), io(of.remeshing);
}
template <typename Io>
void exchange(Io& io, GrowthResult& of) {
  io(of.load_factor);
  exchange(io, of.cycles), exchange(io, of.displacement), exchange(io, of.reaction);
  exchange(io, of.energy);
  exchange(io, of.tips);
}
template <typename Io>
void exchange(Io& io, IncrementResult& of) {
  io(of.step);
  exchange(io, of.step_name);
  io(of.increment), io(of.reached);
  exchange(io, of.time);
  exchange(io, of.factors);
  io(of.converged), io(of.newton_iterations), io(of.coarse_iterations), io(of.halvings), io(of.residual);
  exchange(io, of.pairs_found);
  exchange(io, of.contacts);
  exchange(io, of.reactions);
  exchange(io, of.moments);
  exchange(io, of.springs);
  exchange(io, of.bars);
  exchange(io, of.absent);
  io(of.largest_force);
  exchange(io, of.certificate);
  io(of.lost_to_rounding);
  exchange(io, of.energy);
  exchange(io, of.cracks);
  exchange(io, of.growth);
  exchange(io, of.reason);
  exchange(io, of.uniqueness);
  exchange(io, of.attempts);
}

}  // namespace

std::string record_of(const IncrementResult& increment) {
  ensure(!increment.error && increment.quantities.empty(), "increments with an estimated error are not kept");
  Packer packer;
  exchange(packer, const_cast<IncrementResult&>(increment));  // NOLINT: a Packer changes nothing
  return std::move(packer.bytes);
}

IncrementResult increment_of(std::string_view record) {
  IncrementResult increment;
  Unpacker unpacker(record);
  exchange(unpacker, increment);
  if (!unpacker.at_end()) throw std::out_of_range("the record is too long");
  return increment;
}

std::uint64_t digest(std::string_view bytes, std::uint64_t before) {
  for (const char byte : bytes) before = (before ^ static_cast<unsigned char>(byte)) * 0x100000001b3ull;
  return before;
}

}  // namespace scabo::analysis
