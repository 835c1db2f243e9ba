// `output`: what a run writes besides the files that it always writes.
#include "scabo/model/reading.hpp"

namespace scabo::model {

void read_output(Reading& reading, const Value& value) {
  const MapReader map(reading.report, value, {"discrete_problems"}, "{discrete_problems: true}");
  Output& output = reading.model.output;
  if (const auto problems = map.get("discrete_problems"))
    output.discrete_problems = read_flag(reading.report, *problems).value_or(false);
}

}  // namespace scabo::model
