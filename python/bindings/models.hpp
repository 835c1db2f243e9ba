// Models as the extension module keeps them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scabo/input/yaml_document.hpp"
#include "scabo/model/model.hpp"
#include "scabo/model/solid_model.hpp"

namespace scabo::python {

/// The tree of a model file, with the settings in it.
struct Document {
  std::string file;                   ///< path of the model file
  std::vector<std::string> settings;  ///< `path=value`
  input::NodePtr root;
  std::shared_ptr<const std::string> text = {};  ///< of the file
};

/// A model that has been read and validated.
struct CheckedModel {
  model::Model model;                              ///< empty of a model in space
  std::shared_ptr<const model::SpaceModel> space;  ///< a model in space; else null
  double reading = 0.0;                            ///< seconds
  /// If the model is that of the file with these settings: it can be read again by `scabo resume`.
  bool is_of_file = false;
  std::vector<std::string> settings;
};

}  // namespace scabo::python
