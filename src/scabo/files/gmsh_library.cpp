#include "scabo/files/gmsh_library.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/files/bytes_of_file.hpp"
#include "scabo/files/gmsh.hpp"
#include "scabo/files/text_cursor.hpp"

#ifdef SCABO_GMSH
#include <dlfcn.h>
#include <gmshc.h>

#ifdef __has_feature
#if __has_feature(address_sanitizer)
// What Gmsh and OpenCASCADE do not free is not reported as a leak of Scabo.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libgmsh\nleak:libTK\n"; }
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
#endif
#endif
#endif

namespace scabo::files {

namespace {

namespace fs = std::filesystem;

}  // namespace

#ifdef SCABO_GMSH

namespace {

/// The functions of Gmsh's interface in C that are used here.
struct GmshLibrary {
  decltype(&gmshInitialize) initialize;
  decltype(&gmshFinalize) finalize;
  decltype(&gmshMerge) merge;
  decltype(&gmshWrite) write;
  decltype(&gmshFree) free;
  decltype(&gmshOptionSetNumber) set_number;
  decltype(&gmshOptionSetString) set_string;
  decltype(&gmshLoggerStart) start_logger;
  decltype(&gmshLoggerStop) stop_logger;
  decltype(&gmshLoggerGet) get_log;
  decltype(&gmshModelAdd) add_model;
  decltype(&gmshModelGetEntities) get_entities;
  decltype(&gmshModelGetPhysicalGroups) get_groups;
  decltype(&gmshModelGetBoundingBox) get_box;
  decltype(&gmshModelGetBoundary) get_boundary;
  decltype(&gmshModelGetParametrizationBounds) get_bounds;
  decltype(&gmshModelGetValue) get_value;
  decltype(&gmshModelMeshClear) clear_mesh;
  decltype(&gmshModelMeshGenerate) generate;
  decltype(&gmshModelMeshSetOrder) set_order;
};

class LoadError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

template <class Function>
void find_symbol(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr) throw LoadError(fmt::format("it has no function {}", name));
}

/// Loaded once, for the rest of the process: libraries that it needs cannot be unloaded.
const GmshLibrary& gmsh_library() {
  static const GmshLibrary library = [] {
    void* handle = dlopen(SCABO_GMSH, RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) handle = dlopen(fs::path(SCABO_GMSH).filename().c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) throw LoadError(dlerror());
    GmshLibrary found{};
    find_symbol(handle, "gmshInitialize", found.initialize);
    find_symbol(handle, "gmshFinalize", found.finalize);
    find_symbol(handle, "gmshMerge", found.merge);
    find_symbol(handle, "gmshWrite", found.write);
    find_symbol(handle, "gmshFree", found.free);
    find_symbol(handle, "gmshOptionSetNumber", found.set_number);
    find_symbol(handle, "gmshOptionSetString", found.set_string);
    find_symbol(handle, "gmshLoggerStart", found.start_logger);
    find_symbol(handle, "gmshLoggerStop", found.stop_logger);
    find_symbol(handle, "gmshLoggerGet", found.get_log);
    find_symbol(handle, "gmshModelAdd", found.add_model);
    find_symbol(handle, "gmshModelGetEntities", found.get_entities);
    find_symbol(handle, "gmshModelGetPhysicalGroups", found.get_groups);
    find_symbol(handle, "gmshModelGetBoundingBox", found.get_box);
    find_symbol(handle, "gmshModelGetBoundary", found.get_boundary);
    find_symbol(handle, "gmshModelGetParametrizationBounds", found.get_bounds);
    find_symbol(handle, "gmshModelGetValue", found.get_value);
    find_symbol(handle, "gmshModelMeshClear", found.clear_mesh);
    find_symbol(handle, "gmshModelMeshGenerate", found.generate);
    find_symbol(handle, "gmshModelMeshSetOrder", found.set_order);
    return found;
  }();
  return library;
}

/// Version 4.9 and later have one more argument, which opens the window.
template <class Initialize>
void initialize_gmsh(Initialize initialize, int& error) {
  if constexpr (std::is_invocable_v<Initialize, int, char**, int, int*>) {
    initialize(0, nullptr, 0, &error);
  } else {
    initialize(0, nullptr, 0, 0, &error);
  }
}

/// std::cout writes nothing while this object exists: OpenCASCADE writes its messages there.
class SilentOutput {
 public:
  SilentOutput() : before_(std::cout.rdbuf(&nothing_)) {}
  ~SilentOutput() { std::cout.rdbuf(before_); }
  SilentOutput(const SilentOutput&) = delete;
  SilentOutput& operator=(const SilentOutput&) = delete;

 private:
  struct Nothing : std::streambuf {
    int overflow(int c) override { return traits_type::not_eof(c); }
  };
  Nothing nothing_;
  std::streambuf* before_;
};

/// A new directory in that for temporary files, removed with all that is in it.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::error_code error;
    std::string name = (fs::temp_directory_path(error) / "scabo_cad_XXXXXX").string();
    if (!error && ::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~TemporaryDirectory() {
    std::error_code error;
    if (!path_.empty()) fs::remove_all(path_, error);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const fs::path& path() const { return path_; }  // empty: none could be made

 private:
  fs::path path_;
};

using DimTags = std::vector<std::pair<int, int>>;

/// A session of Gmsh's library with one file: one at a time in a process.
class GmshSession {
 public:
  GmshSession(const GmshLibrary& gmsh, const std::string& path) : gmsh_(gmsh), path_(path) {
    int error = 0;
    initialize_gmsh(gmsh_.initialize, error);
    if (error != 0) fail_in_file(path_, 0, 0, "Gmsh's library could not be started");
    set("General.Terminal", 0);
    gmsh_.start_logger(&error);
    gmsh_.add_model("scabo", &error);
    gmsh_.set_string("Geometry.OCCTargetUnit", "M", &error);
  }
  ~GmshSession() {
    int error = 0;
    gmsh_.stop_logger(&error);  // the log would outlive the session
    gmsh_.finalize(&error);
  }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// Not gmshOpen, which also runs a file of options beside it.
  void read() {
    int error = 0;
    gmsh_.merge(path_.c_str(), &error);
    check(error, "Gmsh cannot read the file");
    set("General.Terminal", 0);
    if (!entities(3).empty())
      fail_in_file(path_, 0, 0, "the file has a solid; Scabo needs plane faces in x and y: export a face of it");
    surfaces_ = entities(2);
    if (surfaces_.empty())
      fail_in_file(path_, 0, 0, "the file has no surface, which a body is made of; add one (.geo: Plane Surface)");
    check_plane();
  }

  void mesh(const CadOptions& options) {
    check_count(options);
    // An exception in one of Gmsh's threads would end the process; errors are in the log anyway.
    set("General.AbortOnError", 1);
    int error = 0;
    gmsh_.clear_mesh(nullptr, 0, &error);
    set("Mesh.ElementOrder", 1);
    set("Mesh.SecondOrderIncomplete", 1);
    if (options.size > 0.0) {
      set("Mesh.MeshSizeFactor", 1);
      set("Mesh.MeshSizeMax", options.size);
      set("Mesh.MeshSizeMin", options.size);
    }
    gmsh_.generate(2, &error);
    check(error, "Gmsh cannot mesh the file");
    gmsh_.set_order(options.order, &error);
    check(error, "Gmsh cannot make sides of order 2");
  }

  /// The bytes of the .msh file that Gmsh writes.
  std::string written() {
    const TemporaryDirectory directory;
    if (directory.path().empty())
      fail_in_file(path_, 0, 0, "the mesh needs a temporary file, which cannot be made: set TMPDIR to a folder for it");
    const fs::path file = directory.path() / "mesh.msh";
    set("Mesh.MshFileVersion", 4.1);
    set("Mesh.Binary", 1);
    set("Mesh.SaveAll", groups_of_surfaces() == 0 ? 1 : 0);
    set("Mesh.SaveParametric", 0);
    set("Mesh.SaveGroupsOfNodes", 0);
    int error = 0;
    gmsh_.write(file.c_str(), &error);
    check(error, "Gmsh cannot write its mesh");
    return bytes_of_file(file).value_or("");
  }

 private:
  void set(const char* option, double value) {
    int error = 0;
    gmsh_.set_number(option, value, &error);
    ensure(error == 0, "Gmsh's library knows its options");
  }

  /// Throws if there was an error, which `what` introduces; Gmsh's own message has the line of a .geo file.
  void check(int error, const char* what) {
    std::string message = first_error();
    if (error == 0 && message.empty()) return;
    int line = 0;
    if (const std::string head = "'" + path_ + "', line "; message.compare(0, head.size(), head) == 0) {
      line = std::atoi(message.c_str() + head.size());
      const std::size_t colon = message.find(": ", head.size());
      if (colon != std::string::npos) message.erase(0, colon + 2);
    }
    fail_in_file(path_, line, line > 0 ? 1 : 0,
                 fmt::format("{}: {}", what, message.empty() ? "it gives no reason" : message));
  }

  /// The first error in Gmsh's log, without its level.
  std::string first_error() {
    char** log = nullptr;
    std::size_t count = 0;
    int error = 0;
    gmsh_.get_log(&log, &count, &error);
    if (error != 0) return {};
    std::string first;
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view line = log[i];
      if (first.empty() && line.starts_with("Error: ")) first = line.substr(7);
      gmsh_.free(log[i]);
    }
    gmsh_.free(log);
    return first;
  }

  DimTags taken(int* values, std::size_t count) {
    DimTags tags;
    for (std::size_t i = 0; i + 1 < count; i += 2) tags.emplace_back(values[i], values[i + 1]);
    gmsh_.free(values);
    return tags;
  }

  DimTags entities(int dimension) {
    int* values = nullptr;
    std::size_t count = 0;
    int error = 0;
    gmsh_.get_entities(&values, &count, dimension, &error);
    return taken(values, count);
  }

  std::size_t groups_of_surfaces() {
    int* values = nullptr;
    std::size_t count = 0;
    int error = 0;
    gmsh_.get_groups(&values, &count, 2, &error);
    return taken(values, count).size();
  }

  void check_plane() {
    for (const auto& [dimension, tag] : surfaces_) {
      std::array<double, 3> low{}, high{};
      int error = 0;
      gmsh_.get_box(dimension, tag, &low[0], &low[1], &low[2], &high[0], &high[1], &high[2], &error);
      if (error != 0) continue;
      const double size = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
      const double allowed = 1e-6 * size + 2e-7;  // OpenCASCADE widens boxes by 1e-7
      if (low[2] < -allowed || high[2] > allowed)
        fail_in_file(
            path_, 0, 0,
            fmt::format("surface {} is not in the plane z = 0: it lies between z = {:.4g} and z = {:.4g}; move "
                        "it there",
                        tag, low[2], high[2]));
    }
  }

  /// Points along a curve, in its direction.
  std::vector<Vec2> points_of(int curve) {
    constexpr int steps = 32;
    double *least = nullptr, *most = nullptr, *values = nullptr;
    std::size_t least_count = 0, most_count = 0, count = 0;
    int error = 0;
    std::vector<Vec2> points;
    gmsh_.get_bounds(1, curve, &least, &least_count, &most, &most_count, &error);
    if (error == 0 && least_count == 1 && most_count == 1) {
      std::array<double, steps + 1> at{};
      for (int i = 0; i <= steps; ++i) at[static_cast<std::size_t>(i)] = *least + (*most - *least) * i / steps;
      gmsh_.get_value(1, curve, at.data(), at.size(), &values, &count, &error);
      for (std::size_t i = 0; error == 0 && i + 2 < count; i += 3) points.emplace_back(values[i], values[i + 1]);
    }
    for (double* each : {least, most, values}) gmsh_.free(each);
    return points;
  }

  /// Equilateral triangles of the size have 1.15 nodes on an area of its square.
  void check_count(const CadOptions& options) {
    if (options.size <= 0.0) return;
    double nodes = 0.0;
    for (const auto& [dimension, tag] : surfaces_) {
      std::array<int, 2> surface{dimension, tag};
      int* values = nullptr;
      std::size_t count = 0;
      int error = 0;
      gmsh_.get_boundary(surface.data(), surface.size(), &values, &count, 0, 1, 0, &error);
      double area = 0.0, length = 0.0;
      for (const auto& [curve_dimension, curve] : taken(values, count)) {
        const std::vector<Vec2> points = points_of(std::abs(curve));
        double swept = 0.0;
        for (std::size_t i = 1; i < points.size(); ++i) {
          const Vec2 &a = points[i - 1], &b = points[i];
          swept += 0.5 * (a.x() * b.y() - a.y() * b.x());
          length += (b - a).norm();
        }
        area += curve < 0 ? -swept : swept;
      }
      const double sizes = options.size * options.size;
      nodes += (1.15 * std::abs(area) / sizes + 0.5 * length / options.size) * options.order * options.order;
    }
    if (!(nodes <= most_cad_nodes))
      fail_in_file(
          path_, 0, 0,
          fmt::format("with 'size' {:g} the mesh would have about {:.2g} nodes, more than the {:.7g} allowed: use a "
                      "larger 'size'",
                      options.size, nodes, most_cad_nodes));
  }

  const GmshLibrary& gmsh_;
  std::string path_;
  DimTags surfaces_;
};

}  // namespace

bool reads_cad() { return true; }

ImportedMesh mesh_by_gmsh(const std::string& path, const CadOptions& options) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const SilentOutput silent;
  std::string bytes;
  try {
    GmshSession session(gmsh_library(), path);
    session.read();
    session.mesh(options);
    bytes = session.written();
  } catch (const LoadError& error) {
    fail_in_file(path, 0, 0, fmt::format("Gmsh's library, which reads CAD files, cannot be loaded: {}", error.what()));
  }
  return parse_gmsh(bytes, path);
}

#else

bool reads_cad() { return false; }

ImportedMesh mesh_by_gmsh(const std::string& path, const CadOptions&) {
  fail_in_file(
      path, 0, 0,
      fmt::format("this program was built without Gmsh's library, which reads .geo and .step: install libgmsh-dev "
                  "and build again, or write a .msh with gmsh -2 {}",
                  fs::path(path).filename().string()));
}

#endif

}  // namespace scabo::files
