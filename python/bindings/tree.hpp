// Python's dictionaries, lists and scalars <-> the tree of a model file.
#pragma once

#include <string>

#include "bindings.hpp"
#include "scabo/input/yaml_document.hpp"

namespace scabo::python {

/// Maps become dictionaries; text becomes None, bool, int, float or str, as YAML reads it.
py::object to_python(const input::Node& node);

/// The tree of a Python value. Nodes of `before` whose value is the same are taken over with their lines; without
/// changes that is `before` itself. New nodes have no line. Throws TypeError for values that a model cannot contain,
/// and InputError, about `file`, for too many of them.
input::NodePtr tree_of(py::handle value, const input::NodePtr& before, const std::string& file);

}  // namespace scabo::python
