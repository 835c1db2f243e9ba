#ifdef SCABO_GMSH
#include "scabo/files/gmsh_session.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <type_traits>

#include "scabo/base/error.hpp"
#include "scabo/files/bytes_of_file.hpp"
#include "scabo/files/text_cursor.hpp"

#ifdef __has_feature
#if __has_feature(address_sanitizer)
// What Gmsh and OpenCASCADE do not free is not reported as a leak of Scabo.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libgmsh\nleak:libTK\n"; }
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
#endif
#endif

namespace scabo::files {

namespace {

namespace fs = std::filesystem;

std::mutex one_at_a_time;

/// Version 4.9 and later have one more argument, which opens the window.
template <class Initialize>
void initialize_gmsh(Initialize initialize, int& error) {
  if constexpr (std::is_invocable_v<Initialize, int, char**, int, int*>) {
    initialize(0, nullptr, 0, &error);
  } else {
    initialize(0, nullptr, 0, 0, &error);
  }
}

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

}  // namespace

void* loaded_gmsh() {
  static void* const handle = [] {
    void* found = dlopen(SCABO_GMSH, RTLD_NOW | RTLD_LOCAL);
    if (found == nullptr) found = dlopen(fs::path(SCABO_GMSH).filename().c_str(), RTLD_NOW | RTLD_LOCAL);
    if (found == nullptr) throw GmshLoadError(dlerror());
    return found;
  }();
  return handle;
}

const GmshLibrary& gmsh_library() {
  static const GmshLibrary library = [] {
    GmshLibrary found{};
    find_symbol("gmshInitialize", found.initialize);
    find_symbol("gmshFinalize", found.finalize);
    find_symbol("gmshMerge", found.merge);
    find_symbol("gmshWrite", found.write);
    find_symbol("gmshFree", found.free);
    find_symbol("gmshOptionSetNumber", found.set_number);
    find_symbol("gmshOptionSetString", found.set_string);
    find_symbol("gmshLoggerStart", found.start_logger);
    find_symbol("gmshLoggerStop", found.stop_logger);
    find_symbol("gmshLoggerGet", found.get_log);
    find_symbol("gmshModelAdd", found.add_model);
    find_symbol("gmshModelGetEntities", found.get_entities);
    find_symbol("gmshModelGetPhysicalGroups", found.get_groups);
    find_symbol("gmshModelGetBoundingBox", found.get_box);
    find_symbol("gmshModelGetBoundary", found.get_boundary);
    find_symbol("gmshModelGetParametrizationBounds", found.get_bounds);
    find_symbol("gmshModelGetValue", found.get_value);
    find_symbol("gmshModelMeshClear", found.clear_mesh);
    find_symbol("gmshModelMeshGenerate", found.generate);
    find_symbol("gmshModelMeshSetOrder", found.set_order);
    return found;
  }();
  return library;
}

GmshSession::GmshSession(std::string file, const char* unit)
    : lock_(one_at_a_time), gmsh_(gmsh_library()), file_(std::move(file)) {
  int error = 0;
  initialize_gmsh(gmsh_.initialize, error);
  if (error != 0) fail_in_file(file_, 0, 0, "Gmsh's library could not be started");
  set("General.Terminal", 0);
  gmsh_.start_logger(&error);
  gmsh_.add_model("scabo", &error);
  gmsh_.set_string("Geometry.OCCTargetUnit", unit, &error);
}

GmshSession::~GmshSession() {
  int error = 0;
  gmsh_.stop_logger(&error);  // the log would outlive the session
  gmsh_.finalize(&error);
}

void GmshSession::set(const char* option, double value) {
  int error = 0;
  gmsh_.set_number(option, value, &error);
  ensure(error == 0, "Gmsh's library knows its options");
}

void GmshSession::check(int error, const char* what) {
  std::string message = first_error();
  if (error == 0 && message.empty()) return;
  int line = 0;
  if (const std::string head = "'" + file_ + "', line "; message.compare(0, head.size(), head) == 0) {
    line = std::atoi(message.c_str() + head.size());
    const std::size_t colon = message.find(": ", head.size());
    if (colon != std::string::npos) message.erase(0, colon + 2);
  }
  fail_in_file(file_, line, line > 0 ? 1 : 0,
               fmt::format("{}: {}", what, message.empty() ? "it gives no reason" : message));
}

/// The first error in Gmsh's log, without its level.
std::string GmshSession::first_error() {
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

void GmshSession::forget_errors() {
  int error = 0;
  gmsh_.stop_logger(&error);
  gmsh_.start_logger(&error);
}

GmshSession::DimTags GmshSession::taken(int* values, std::size_t count) {
  DimTags tags;
  for (std::size_t i = 0; i + 1 < count; i += 2) tags.emplace_back(values[i], values[i + 1]);
  gmsh_.free(values);
  return tags;
}

GmshSession::DimTags GmshSession::entities(int dimension) {
  int* values = nullptr;
  std::size_t count = 0;
  int error = 0;
  gmsh_.get_entities(&values, &count, dimension, &error);
  return taken(values, count);
}

void GmshSession::merge(const std::string& path) {
  int error = 0;
  gmsh_.merge(path.c_str(), &error);
  check(error, "Gmsh cannot read the file");
  set("General.Terminal", 0);
}

void GmshSession::generate(int dimension, double least, double size, int order) {
  // An exception in one of Gmsh's threads would end the process; errors are in the log anyway.
  set("General.AbortOnError", 1);
  int error = 0;
  if (dimension == 2) gmsh_.clear_mesh(nullptr, 0, &error);  // what a .geo file has divided itself
  set("Mesh.ElementOrder", 1);
  set("Mesh.SecondOrderIncomplete", 1);
  if (size > 0.0) {
    set("Mesh.MeshSizeFactor", 1);
    set("Mesh.MeshSizeMax", size);
    set("Mesh.MeshSizeMin", least);
  }
  gmsh_.generate(dimension, &error);
  check(error, dimension == 2 ? "Gmsh cannot mesh the file" : "Gmsh cannot divide the solid into tetrahedra");
  gmsh_.set_order(order, &error);
  check(error, "Gmsh cannot make sides of order 2");
}

std::string GmshSession::written(bool all) {
  const TemporaryDirectory directory;
  if (directory.path().empty())
    fail_in_file(file_, 0, 0, "the mesh needs a temporary file, which cannot be made: set TMPDIR to a folder for it");
  const fs::path file = directory.path() / "mesh.msh";
  set("Mesh.MshFileVersion", 4.1);
  set("Mesh.Binary", 1);
  set("Mesh.SaveAll", all ? 1 : 0);
  set("Mesh.SaveParametric", 0);
  set("Mesh.SaveGroupsOfNodes", 0);
  int error = 0;
  gmsh_.write(file.c_str(), &error);
  check(error, "Gmsh cannot write its mesh");
  return bytes_of_file(file).value_or("");
}

}  // namespace scabo::files
#endif
