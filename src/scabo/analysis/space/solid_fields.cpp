#include "scabo/analysis/space/solid_fields.hpp"

#include "scabo/analysis/state/field_numbers.hpp"

namespace scabo::analysis {

namespace {

struct SolidTable {
  using enum Owner;
  using enum Kept;
  static constexpr SolidField fields[] = {
      field_of<SolidState>(
          "loads", whole, 0, in_this_run, [](auto& state) -> auto& { return state.factors.loads; }),
      field_of<SolidState>(
          "supports", whole, 0, in_this_run, [](auto& state) -> auto& { return state.factors.supports; }),
      field_of<SolidState>(
          "coefficients", whole, 0, in_this_run, [](auto& state) -> auto& { return state.factors.coefficients; }),
      field_of<SolidState>(
          "fits", whole, 0, in_this_run, [](auto& state) -> auto& { return state.factors.fits; }),
      field_of<SolidState>(
          "tightened", whole, 0, in_this_run, [](auto& state) -> auto& { return state.factors.tightened; }),
      field_of<SolidState>(
          "bars", whole, 0, in_this_run, [](auto& state) -> auto& { return state.factors.bars; }),
      field_of<SolidState>(
          "step", whole, 1, in_this_run, [](auto& state) -> auto& { return state.factors.step; }),
      field_of<SolidState>(
          "presence", whole, 0, in_this_run, [](auto& state) -> auto& { return state.factors.presence; }),
      field_of<SolidState>(
          "release", whole, 1, in_this_run, [](auto& state) -> auto& { return state.factors.release; }),
      field_of<SolidState>(
          "released", whole, 0, in_this_run, [](auto& state) -> auto& { return state.released; }),
      field_of<SolidState>(
          "released_points", whole, 0, in_this_run, [](auto& state) -> auto& { return state.released_points; }),
      field_of<SolidState>(
          "shortening", whole, 0, in_this_run, [](auto& state) -> auto& { return state.shortening; }),
      field_of<SolidState>(
          "p", pair, 3, lasts, [](auto& state) -> auto& { return state.p; }),
      field_of<SolidState>(
          "gap", pair, 1, lasts, [](auto& state) -> auto& { return state.gap; }),
      field_of<SolidState>(
          "slip", pair, 2, lasts, [](auto& state) -> auto& { return state.slip; }),
      field_of<SolidState>(
          "history", pair, 3, lasts, [](auto& state) -> auto& { return state.history; }),
      field_of<SolidState>(
          "states", pair, 1, lasts, [](auto& state) -> auto& { return state.states; }),
      optional_field_of<SolidState>(
          "offset", pair, 3, lasts, [](auto& state) -> auto& { return state.offset; }),
      optional_field_of<SolidState>(
          "held_offset", held_pair, 3, lasts, [](auto& state) -> auto& { return state.held_offset; }),
      field_of<SolidState>(
          "rigid_motion", rigid_motion, 1, lasts, [](auto& state) -> auto& { return state.a; }),
      field_of<SolidState>(
          "energy", whole, 9, lasts, [](auto& state) -> auto& { return state.energy; }),
      field_of<SolidState>(
          "largest_force", whole, 1, lasts, [](auto& state) -> auto& { return state.force_scale; }),
  };
};

}  // namespace

std::span<const SolidField> fields_of_solid_state() { return SolidTable::fields; }

}  // namespace scabo::analysis
