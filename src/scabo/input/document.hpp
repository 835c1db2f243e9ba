// A model together with the tree of the text that it was read from, for those who change the tree and read it again
// (Python).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scabo/input/space/read_solid_model.hpp"
#include "scabo/input/yaml_document.hpp"

namespace scabo::input {

struct Document {
  NodePtr root;  ///< with the overrides in it
  AnyModel model;
};

/// `parse_model` with its tree, also of a model in space.
Document parse_document(std::string_view text, const std::string& file, const std::vector<Override>& overrides = {});

/// Reads and checks a tree, whoever made it. Mistakes at nodes without a line are reported by their key path alone;
/// `file` is used in messages, and files that the model names are relative to its folder. Throws InputError.
AnyModel model_of_tree(const NodePtr& root, const std::string& file);

}  // namespace scabo::input
