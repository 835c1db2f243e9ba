// Why a mesher cannot divide a domain.
#pragma once

#include <optional>
#include <string>

#include "scabo/base/error.hpp"
#include "scabo/base/types.hpp"

namespace scabo::mesh {

/// An InputError without a place in a file. Reason and place are kept apart, because a mesher may see a body in other
/// coordinates than its user (unit_free.hpp).
class Refusal : public InputError {
 public:
  /// `reason`: what is wrong, without its place. `near`: in the coordinates of the domain.
  explicit Refusal(std::string reason, std::optional<Vec2> near = {});
  const std::string& reason() const { return reason_; }
  const std::optional<Vec2>& near() const { return near_; }

 private:
  std::string reason_;
  std::optional<Vec2> near_;
};

/// `two lines cross near (1.5, 2)`
std::string refusal_text(const std::string& reason, const std::optional<Vec2>& near);

}  // namespace scabo::mesh
