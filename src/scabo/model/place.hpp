// Places of bodies, at which supports, loads and contacts act.
#pragma once

#include <string>

#include "scabo/base/error.hpp"
#include "scabo/base/types.hpp"

namespace scabo::model {

/// Where a support, load or contact acts.
struct Place {
  /// `face`: a side face, or a face of a crack between cells; `mouth`: the node of a side face at the boundary.
  enum class Kind { body, edge, corner, near, face, mouth };
  Kind kind = Kind::body;
  int body = -1;
  /// Edge or corner; side face, mouth: 0 at the start of the boundary, 1 at its end; face of Body::cracks[k] with a
  /// path: 2 k on its right, 2 k + 1 on its left, looking along the path.
  int index = -1;
  Vec2 near = Vec2::Zero();  ///< `near`: stands for the boundary node closest to this point
  std::string text;          ///< as given by the user, `upper.top_right`
  Source source;
};

}  // namespace scabo::model
