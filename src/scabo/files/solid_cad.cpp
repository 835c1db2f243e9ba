#include "scabo/files/solid_cad.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <filesystem>
#include <numbers>

#include "scabo/base/error.hpp"
#include "scabo/files/stl.hpp"
#include "scabo/files/text_cursor.hpp"

#ifdef SCABO_GMSH
#include "scabo/files/solid_cad_session.hpp"
#endif

namespace scabo::files {

namespace {

std::string ending_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

}  // namespace

bool has_unit(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".step" || ending == ".stp";
}
bool is_stl_file(const std::string& path) { return ending_of(path) == ".stl"; }
bool is_solid_cad_file(const std::string& path) {
  return has_unit(path) || is_stl_file(path) || ending_of(path) == ".brep";
}

#ifdef SCABO_GMSH

using Eigen::Vector3d;

const SolidLibrary& solid_library() {
  static const SolidLibrary library = [] {
    SolidLibrary found{};
    find_symbol("gmshModelOccAddBox", found.box);
    find_symbol("gmshModelOccAddCylinder", found.cylinder);
    find_symbol("gmshModelOccAddSphere", found.sphere);
    find_symbol("gmshModelOccAddPoint", found.point);
    find_symbol("gmshModelOccAddLine", found.line);
    find_symbol("gmshModelOccAddCircleArc", found.arc);
    find_symbol("gmshModelOccAddCurveLoop", found.loop);
    find_symbol("gmshModelOccAddPlaneSurface", found.surface);
    find_symbol("gmshModelOccExtrude", found.extrude);
    find_symbol("gmshModelOccRevolve", found.revolve);
    find_symbol("gmshModelOccFuse", found.fuse);
    find_symbol("gmshModelOccCut", found.cut);
    find_symbol("gmshModelOccIntersect", found.intersect);
    find_symbol("gmshModelOccImportShapes", found.import);
    find_symbol("gmshModelOccSynchronize", found.synchronize);
    find_symbol("gmshModelOccGetMass", found.mass);
    find_symbol("gmshModelGetEntityName", found.name);
    find_symbol("gmshModelMeshOptimize", found.optimize);
    find_symbol("gmshModelMeshClassifySurfaces", found.classify);
    find_symbol("gmshModelMeshCreateGeometry", found.create_geometry);
    find_symbol("gmshModelGeoAddSurfaceLoop", found.shell);
    find_symbol("gmshModelGeoAddVolume", found.volume);
    find_symbol("gmshModelGeoSynchronize", found.synchronize_triangles);
    find_symbol("gmshModelMeshFieldAdd", found.add_field);
    find_symbol("gmshModelMeshFieldSetString", found.set_field_text);
    find_symbol("gmshModelMeshFieldSetNumbers", found.set_field_numbers);
    find_symbol("gmshModelMeshFieldSetAsBackgroundMesh", found.use_field);
    return found;
  }();
  return library;
}

namespace {

/// Later versions have one more argument: whether the middle point is the centre.
template <class Arc>
int add_arc(Arc arc, int start, int centre, int end, int& error) {
  if constexpr (std::is_invocable_v<Arc, int, int, int, int, int*>) {
    return arc(start, centre, end, -1, &error);
  } else {
    return arc(start, centre, end, -1, 1, &error);
  }
}

}  // namespace

SolidCad::SolidCad(const std::string& file, double factor) try : session_(std::make_unique<Session>(file, factor)) {
  session_->session.set("Geometry.OCCUnionUnify", 0);  // keeps faces apart that have names of their own
} catch (const GmshLoadError& error) {
  fail_in_file(file, 0, 0, fmt::format("Gmsh's library, which makes solids, cannot be loaded: {}", error.what()));
}
SolidCad::~SolidCad() = default;

SolidCad::Solids SolidCad::Session::volumes_of(const GmshSession::DimTags& made) const {
  Solids volumes;
  for (const auto& [dimension, tag] : made)
    if (dimension == 3) volumes.push_back(tag);
  return volumes;
}

SolidCad::Solids SolidCad::box(const Vector3d& corner, const Vector3d& size) {
  const Vector3d at = session_->scaled(corner), by = session_->scaled(size);
  int error = 0;
  const int tag = session_->solids.box(at.x(), at.y(), at.z(), by.x(), by.y(), by.z(), -1, &error);
  session_->session.check(error, "Gmsh cannot make the box");
  return {tag};
}

SolidCad::Solids SolidCad::cylinder(const Vector3d& from, const Vector3d& to, double radius) {
  const Vector3d at = session_->scaled(from), by = session_->scaled(to - from);
  int error = 0;
  const int tag = session_->solids.cylinder(at.x(), at.y(), at.z(), by.x(), by.y(), by.z(), session_->scaled(radius),
                                            -1, 2.0 * std::numbers::pi, &error);
  session_->session.check(error, "Gmsh cannot make the cylinder");
  return {tag};
}

SolidCad::Solids SolidCad::sphere(const Vector3d& centre, double radius) {
  const Vector3d at = session_->scaled(centre);
  constexpr double right = std::numbers::pi / 2.0;
  int error = 0;
  const int tag =
      session_->solids.sphere(at.x(), at.y(), at.z(), session_->scaled(radius), -1, -right, right, 4.0 * right, &error);
  session_->session.check(error, "Gmsh cannot make the sphere");
  return {tag};
}

int SolidCad::Session::surface_of(const std::vector<SolidLoop>& loops) {
  int error = 0;
  const auto add = [&](const Vector3d& x) {
    const Vector3d at = scaled(x);
    const int tag = solids.point(at.x(), at.y(), at.z(), 0.0, -1, &error);
    session.check(error, "Gmsh cannot make a point");
    return tag;
  };
  std::vector<int> wires;
  for (const SolidLoop& loop : loops) {
    std::vector<int> points, curves;
    for (const SolidLoop::Line& line : loop.lines) points.push_back(add(line.start));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const int start = points[i], end = points[(i + 1) % points.size()];
      curves.push_back(loop.lines[i].arc ? add_arc(solids.arc, start, add(loop.lines[i].centre), end, error)
                                         : solids.line(start, end, -1, &error));
      session.check(error, "Gmsh cannot make a line of the outline");
    }
    wires.push_back(solids.loop(curves.data(), curves.size(), -1, &error));
    session.check(error, "Gmsh cannot close the outline");
  }
  const int surface = solids.surface(wires.data(), wires.size(), -1, &error);
  session.check(error, "Gmsh cannot make a face of the outline");
  return surface;
}

SolidCad::Solids SolidCad::drawn(const std::vector<SolidLoop>& loops, const Vector3d& along) {
  std::array<int, 2> surface{2, session_->surface_of(loops)};
  const Vector3d by = session_->scaled(along);
  int* values = nullptr;
  std::size_t count = 0;
  int error = 0;
  session_->solids.extrude(surface.data(), 2, by.x(), by.y(), by.z(), &values, &count, nullptr, 0, nullptr, 0, 0,
                           &error);
  session_->session.check(error, "Gmsh cannot draw the outline along the axis");
  return session_->volumes_of(session_->session.taken(values, count));
}

SolidCad::Solids SolidCad::turned(const std::vector<SolidLoop>& loops, const Vector3d& point, const Vector3d& axis,
                                  double angle) {
  std::array<int, 2> surface{2, session_->surface_of(loops)};
  const Vector3d at = session_->scaled(point);
  int* values = nullptr;
  std::size_t count = 0;
  int error = 0;
  session_->solids.revolve(surface.data(), 2, at.x(), at.y(), at.z(), axis.x(), axis.y(), axis.z(), angle, &values,
                           &count, nullptr, 0, nullptr, 0, 0, &error);
  session_->session.check(error, "Gmsh cannot turn the outline about the axis");
  return session_->volumes_of(session_->session.taken(values, count));
}

/// Faces are cut where triangles turn by more than 40 degrees, and parametrised, so that they can be divided anew.
SolidCad::Solids SolidCad::of_stl(const std::string& path) {
  const SolidLibrary& of = session_->solids;
  constexpr double turn = 40.0 * std::numbers::pi / 180.0;
  session_->stl_volume = volume_of_stl(path);
  session_->session.merge(path);
  int error = 0;
  of.classify(turn, 1, 1, std::numbers::pi, 1, &error);
  session_->session.check(error, "Gmsh cannot divide the surface into faces");
  of.create_geometry(nullptr, 0, &error);
  session_->session.check(error, "Gmsh cannot make faces of the triangles");
  std::vector<int> faces;
  for (const auto& [dimension, tag] : session_->session.entities(2)) faces.push_back(tag);
  std::vector<int> shell{of.shell(faces.data(), faces.size(), -1, &error)};
  const int volume = of.volume(shell.data(), 1, -1, &error);
  of.synchronize_triangles(&error);
  session_->session.check(error, "Gmsh cannot make a solid of the triangles");
  return {volume};
}

SolidCad::Solids SolidCad::of_file(const std::string& path) {
  int* values = nullptr;
  std::size_t count = 0;
  int error = 0;
  session_->solids.import(path.c_str(), &values, &count, 1, "", &error);
  session_->session.check(error, "the file may be cut off or damaged: export it again; Gmsh cannot read the file");
  session_->session.set("General.Terminal", 0);
  const Solids found = session_->volumes_of(session_->session.taken(values, count));
  session_->step_file = has_unit(path) ? path : "";
  if (found.empty())
    fail_in_file(path, 0, 0, "the file has no solid: export the part as a solid, not as surfaces or lines");
  return found;
}

template <class Operation>
SolidCad::Solids SolidCad::Session::combined(Operation operation, const Solids& a, const Solids& b, const char* what) {
  std::vector<int> first, second;
  for (const int tag : a) first.insert(first.end(), {3, tag});
  for (const int tag : b) second.insert(second.end(), {3, tag});
  int *values = nullptr, **map = nullptr;
  std::size_t count = 0, *map_count = nullptr, maps = 0;
  int error = 0;
  operation(first.data(), first.size(), second.data(), second.size(), &values, &count, &map, &map_count, &maps, -1, 1,
            1, &error);
  for (std::size_t i = 0; error == 0 && i < maps; ++i) gmsh.free(map[i]);
  gmsh.free(map);
  gmsh.free(map_count);
  session.check(error, what);
  return volumes_of(session.taken(values, count));
}

SolidCad::Solids SolidCad::united(const Solids& a, const Solids& b) {
  return session_->combined(session_->solids.fuse, a, b, "Gmsh cannot unite the solids");
}
SolidCad::Solids SolidCad::cut(const Solids& a, const Solids& b) {
  return session_->combined(session_->solids.cut, a, b, "Gmsh cannot subtract the solids");
}
SolidCad::Solids SolidCad::common(const Solids& a, const Solids& b) {
  return session_->combined(session_->solids.intersect, a, b, "Gmsh cannot intersect the solids");
}

#else

class SolidCad::Session {};

SolidCad::SolidCad(const std::string& file, double) {
  fail_in_file(file, 0, 0,
               "this program was built without Gmsh's library, which makes solids: install libgmsh-dev and build "
               "again, or write a .msh of the solid with Gmsh");
}
SolidCad::~SolidCad() = default;
SolidCad::Solids SolidCad::box(const Eigen::Vector3d&, const Eigen::Vector3d&) { return {}; }
SolidCad::Solids SolidCad::cylinder(const Eigen::Vector3d&, const Eigen::Vector3d&, double) { return {}; }
SolidCad::Solids SolidCad::sphere(const Eigen::Vector3d&, double) { return {}; }
SolidCad::Solids SolidCad::drawn(const std::vector<SolidLoop>&, const Eigen::Vector3d&) { return {}; }
SolidCad::Solids SolidCad::turned(const std::vector<SolidLoop>&, const Eigen::Vector3d&, const Eigen::Vector3d&,
                                  double) {
  return {};
}
SolidCad::Solids SolidCad::of_file(const std::string&) { return {}; }
SolidCad::Solids SolidCad::of_stl(const std::string&) { return {}; }
SolidCad::Solids SolidCad::united(const Solids&, const Solids&) { return {}; }
SolidCad::Solids SolidCad::cut(const Solids&, const Solids&) { return {}; }
SolidCad::Solids SolidCad::common(const Solids&, const Solids&) { return {}; }
ImportedSolidMesh SolidCad::mesh(const SolidCadSizes&) { return {}; }

#endif

}  // namespace scabo::files
