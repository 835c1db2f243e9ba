#include "scabo/result/crack_table.hpp"

#include <fmt/format.h>

#include <iterator>

#include "scabo/result/contact_table.hpp"

namespace scabo::result {

const std::string_view crack_table_header =
    "step,increment,tip,x,y,length,K_I,K_II,T,G,kink,load_factor,critical_at,grows,range,cycles,opening,displacement,"
    "reaction,released,integral,remeshing\n";

std::string crack_table_rows(const analysis::IncrementResult& increment) {
  if (!increment.growth) return {};
  const auto text = [](const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; };
  const auto& energy = increment.growth->energy;
  const std::string energies =
      energy ? fmt::format("{},{},{}", energy->released, energy->integral, energy->remeshing) : ",,";
  fmt::memory_buffer rows;
  for (const analysis::TipResult& tip : increment.growth->tips)
    fmt::format_to(std::back_inserter(rows), "{},{},{},{},{},{},{},{},{},{},{},{},{},{:d},{},{},{},{},{},{}\n",
                   increment.step, increment.increment, csv_quoted(tip.name), tip.position.x(), tip.position.y(),
                   tip.length, tip.K_I, tip.K_II, text(tip.T), text(tip.G), tip.kink, increment.growth->load_factor,
                   tip.load_factor, tip.grows, text(tip.range), text(increment.growth->cycles), tip.opening,
                   text(increment.growth->displacement), text(increment.growth->reaction), energies);
  return fmt::to_string(rows);
}

}  // namespace scabo::result
