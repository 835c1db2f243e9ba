#include "scabo/mesh/plane/refusal.hpp"

#include <fmt/format.h>

#include <utility>

namespace scabo::mesh {

std::string refusal_text(const std::string& reason, const std::optional<Vec2>& near) {
  return near ? fmt::format("{} near ({:.6g}, {:.6g})", reason, near->x(), near->y()) : reason;
}

Refusal::Refusal(std::string reason, std::optional<Vec2> near)
    : InputError("", {Diagnostic{{}, refusal_text(reason, near)}}), reason_(std::move(reason)), near_(near) {}

}  // namespace scabo::mesh
