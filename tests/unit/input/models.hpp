// Small model files for the tests of the reader.
#pragma once

#include <string>
#include <vector>

#include "scabo/input/read_model.hpp"

namespace scabo::input::testing_models {

/// A block held at its bottom, pushed by the load `push` and, where there is more, by `rest`.
inline std::string block(const std::string& rest = "") {
  return "scabo: 1\n"
         "materials: {steel: {young: 210e9, poisson: 0.3, density: 7850}}\n"
         "bodies:\n"
         "  block: {material: steel, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.5}}\n"
         "supports: [{on: block.bottom, fix: [x, y]}]\n"
         "loads: {push: {on: block.right, force: [1, 0]}}\n" +
         rest;
}

/// A body of the given shape, held at edge_1 and pushed at vertex_3; a rigid one lies on a spring-like block.
inline std::string shaped(const std::string& shape, const std::string& mesh = "{size: 0.5}") {
  return "scabo: 1\n"
         "materials: {steel: {young: 210e9, poisson: 0.3}}\n"
         "bodies:\n"
         "  body: {material: steel, shape: " +
         shape + ", mesh: " + mesh +
         "}\n"
         "supports: [{on: body.edge_1, fix: [x, y]}]\n"
         "loads: {push: {on: body.edge_2, force: [1, 0]}}\n";
}

using namespace model;  // what the reader gives
using geometry::Outline;

inline Model parse(const std::string& text, const std::vector<Override>& overrides = {}) {
  return parse_model(text, "model.yaml", overrides);
}

/// The outline of the only body of `shaped`.
inline Outline outline_of(const std::string& shape, const std::string& mesh = "{size: 0.5}") {
  return parse(shaped(shape, mesh)).bodies.front().outline;
}

/// Everything that is wrong, one mistake a line; empty when nothing is.
inline std::string mistakes_in(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    parse(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace scabo::input::testing_models
