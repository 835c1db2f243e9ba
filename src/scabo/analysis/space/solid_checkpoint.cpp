#include "scabo/analysis/space/solid_checkpoint.hpp"

#include "scabo/analysis/space/solid_fields.hpp"
#include "scabo/analysis/state/checkpoint_file.hpp"

namespace scabo::analysis {

namespace {

template <typename Io>
void exchange_solid_checkpoint(Io& io, SolidCheckpoint& of) {
  exchange_origin(io, of.origin);
  exchange_results(io, of.results);
  for (const SolidField& field : fields_of_solid_state()) {
    std::vector<double> numbers = field.get(of.state);
    io.numbers(std::string("space/") + field.name, numbers);
    if constexpr (Io::reads) field.set(of.state, numbers);
  }
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
