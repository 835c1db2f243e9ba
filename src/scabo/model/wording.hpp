// Words that messages about a model share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scabo/base/types.hpp"
#include "scabo/geometry/plane/outline.hpp"

namespace scabo::model {

/// The shortest text that reads back as the same number: `3`, `0.3`, `1e-9`.
std::string number_text(double value);

/// `1 node`, `2 nodes`.
std::string counted(long number, std::string_view noun);

/// `(x, y)`.
std::string point_text(const Vec2& point);

/// Name of an edge: the name given by the user, or `edge_3`.
const std::string& shown_name(const geometry::Edge& edge);

/// `a, b, c`, at most twelve names.
std::string name_list(const std::vector<std::string>& names);

/// Message about a load.
std::string named_like_a_support(const std::string& name);

/// Whether `text` is a name: letters, digits, _ and -, beginning with a letter or _. Paths and places separate names by
/// dots.
bool is_name(std::string_view text);

}  // namespace scabo::model
