// Ranges of the whole numbers of a model, for its validation and for readers, which refuse other numbers before they
// convert them.
#pragma once

namespace scabo::model::limits {

struct Range {
  long least, most;
};

constexpr double time_steps = 1e8;            ///< of a step in time, at most
constexpr Range modes{1, 1000};               ///< of a modal analysis
constexpr Range iterations{1, 10'000};        ///< Newton iterations in one attempt
constexpr Range halvings{0, 30};              ///< of an increment
constexpr Range order{1, 16};                 ///< of a boundary element
constexpr Range increments{1, 100'000};       ///< of a step
constexpr Range growth_steps{1, 100'000};     ///< of growing cracks
constexpr Range cycles{1, 10'000};            ///< of a step
constexpr double smallest_increment = 1e-6;   ///< automatic, part of a step
constexpr Range line_points{2, 1'000'000};    ///< of an output line
constexpr Range grid_points{1, 1'000'000};    ///< of a grid along one axis, and in all
constexpr Range every{1, 100'000};            ///< .vtu files of every so many increments
constexpr Range copies{1, 100'000};           ///< of a body that is repeated
constexpr double model_nodes = 4e6;           ///< of all bodies: more are a mistyped size, or 30 GB
constexpr long edges = 20'000;                ///< of an outline, at most
constexpr double superelement_dofs = 20'000;  ///< of one super-element: dense matrices, 3 GB each at this number

}  // namespace scabo::model::limits
