#include "scabo/analysis/space/solid_checkpoint.hpp"

#include "scabo/analysis/state/checkpoint_file.hpp"

namespace scabo::analysis {

namespace {

template <typename Io>
void exchange_solid_checkpoint(Io& io, SolidCheckpoint& of) {
  exchange_origin(io, of.origin);
  exchange_results(io, of.results);
  SolidState& state = of.state;
  exchange_vector(io, "space/factors/loads", state.factors.loads);
  exchange_vector(io, "space/factors/supports", state.factors.supports);
  exchange_vector(io, "space/factors/coefficients", state.factors.coefficients);
  exchange_vector(io, "space/factors/fits", state.factors.fits);
  exchange_vector(io, "space/factors/tightened", state.factors.tightened);
  exchange_vector(io, "space/factors/bars", state.factors.bars);
  exchange_vector(io, "space/shortening", state.shortening);
  exchange_vector(io, "space/slip", state.slip);
  exchange_vector(io, "space/gap", state.gap);
  exchange_vector(io, "space/p", state.p);
  exchange_vector(io, "space/a", state.a);
  std::vector<int> states;
  for (const contact::ContactState one : state.states) states.push_back(static_cast<int>(one));
  io.integers("space/states", states);
  state.states.clear();
  for (const int one : states) state.states.push_back(static_cast<contact::ContactState>(one));
  Vector accumulated(static_cast<Eigen::Index>(state.history.size()));
  std::vector<int> lost;
  for (std::size_t i = 0; i < state.history.size(); ++i) {
    accumulated[static_cast<Eigen::Index>(i)] = state.history[i].slip;
    lost.push_back(int{state.history[i].broken} + 2 * int{state.history[i].slipped});
  }
  exchange_vector(io, "space/accumulated_slip", accumulated);
  io.integers("space/lost_strength", lost);
  state.history.clear();
  for (std::size_t i = 0; i < lost.size(); ++i)
    state.history.push_back({accumulated[static_cast<Eigen::Index>(i)], lost[i] % 2 != 0, lost[i] / 2 != 0});
  Energy& energy = state.energy;
  exchange_scalars(io, "space/scalars",
                   {&state.force_scale, &energy.external, &energy.elastic, &energy.friction, &energy.friction_error});
}

}  // namespace

void write_solid_checkpoint(const std::filesystem::path& directory, SolidCheckpoint checkpoint) {
  write_checkpoint_file(directory, [&](Sealing& io) { exchange_solid_checkpoint(io, checkpoint); });
}

SolidCheckpoint read_solid_checkpoint(const std::filesystem::path& directory, const std::string& version) {
  SolidCheckpoint checkpoint;
  read_checkpoint_file(directory, version, [&](Unsealing& io) {
    exchange_solid_checkpoint(io, checkpoint);
    io.finish();
  });
  return checkpoint;
}

}  // namespace scabo::analysis
