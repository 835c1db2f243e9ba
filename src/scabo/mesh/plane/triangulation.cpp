#include "scabo/mesh/plane/triangulation.hpp"

// Exact numbers are needed only where the floating-point filters of CGAL cannot decide; its own are fast enough, and no
// further library is linked.
#ifndef CGAL_DISABLE_GMP
#define CGAL_DISABLE_GMP 1
#endif
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <numeric>

#include "scabo/mesh/plane/refusal.hpp"

namespace scabo::mesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;

Kernel::Point_2 point_of(const Vec2& p) { return {p.x(), p.y()}; }

}  // namespace

std::vector<std::size_t> spatial_order(const std::vector<Vec2>& points) {
  std::vector<Kernel::Point_2> places;
  places.reserve(points.size());
  for (const Vec2& p : points) places.push_back(point_of(p));
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto map = CGAL::make_property_map(places);
  CGAL::hilbert_sort(order.begin(), order.end(), CGAL::Spatial_sort_traits_adapter_2<Kernel, decltype(map)>(map),
                     CGAL::Hilbert_sort_median_policy());
  return order;
}

std::vector<Triangle> triangulate(const std::vector<Vec2>& points, const std::vector<std::pair<int, int>>& segments,
                                  const std::vector<std::size_t>& order) {
  Delaunay delaunay;
  std::vector<Delaunay::Vertex_handle> vertices(points.size());
  Delaunay::Face_handle near;
  for (const std::size_t i : order) {
    vertices[i] = delaunay.insert(point_of(points[i]), near);
    vertices[i]->info() = static_cast<int>(i);
    near = vertices[i]->face();
  }
  if (delaunay.number_of_vertices() != points.size()) throw Refusal("two lines of the shape touch between their ends");
  try {
    for (const auto& [a, b] : segments)
      delaunay.insert_constraint(vertices[static_cast<std::size_t>(a)], vertices[static_cast<std::size_t>(b)]);
  } catch (const Delaunay::Intersection_of_constraints_exception&) {
    throw Refusal("two lines of the shape cross, or their facets are too long to tell them apart");
  }

  int count = 0;
  for (const Delaunay::Face_handle face : delaunay.finite_face_handles()) face->info() = count++;
  std::vector<Triangle> triangles(static_cast<std::size_t>(count));
  for (const Delaunay::Face_handle face : delaunay.finite_face_handles()) {
    Triangle& triangle = triangles[static_cast<std::size_t>(face->info())];
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      triangle.vertices[k] = face->vertex(i)->info();
      if (!delaunay.is_infinite(face->neighbor(i))) triangle.neighbours[k] = face->neighbor(i)->info();
      triangle.constrained[k] = face->is_constrained(i);
    }
  }
  return triangles;
}

}  // namespace scabo::mesh
