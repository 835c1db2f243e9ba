// About how many nodes the cells of a body will have, before it is divided.
//
// With the wanted size of cells s(x), elements of order p and numbers a, b that the kind of mesh determines,
//
//     nodes = (a + b (p - 1)) integral of dA / s^2                                                           (1)
//
// since corners and sides of cells are a and b to an area of s^2. s is the least of `mesh.size` and of all `refine`:
// places that are refined side by side do not count twice. The integral is a sum over squares in each of which s is
// nearly constant.
#pragma once

#include <string>

#include "scabo/model/model.hpp"

namespace scabo::mesh {

/// Of a body with an outline, `mesh.size` > 0 and every size of `mesh.refine` > 0; within a factor of about 3.
double approximate_nodes(const model::Body& body);

/// A number of nodes above `limit` for a message, with as many digits (>= 1), or with all where rounding would make it
/// the limit: `1.6e+06`, `1000008`.
std::string text_of_count(double nodes, double limit, int digits);

}  // namespace scabo::mesh
