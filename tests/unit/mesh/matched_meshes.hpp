// Models for the tests of matched sides, and what every mesh with matched sides must satisfy.
#pragma once

#include <vector>

#include "models.hpp"

namespace scabo::test {

/// Blocks of length 12 and height 2, divided along the contact into m and n elements.
model::Model blocks(int m, int n, int order_a = 1, int order_b = 1, double gap = 0.0);

/// Distances of the end nodes of an edge's elements from its start.
std::vector<double> breaks_of(const mesh::BodyMesh& mesh, int edge);

std::vector<double> x_of(const mesh::Interface& joint);

/// Area within the polygons of the nodes of all cells.
double area_of(const mesh::BodyMesh& mesh);

/// The mesh of a model. Expects of its elastic bodies that every node is used, the boundaries of the cells are chains,
/// the elements of edges are those of cells, in one or the other direction, and corners are where the outline has them.
mesh::Mesh sound_mesh(const model::Model& model);

}  // namespace scabo::test
