// A session of Gmsh's library, which is loaded when the first CAD file is meshed. Only for sources that are compiled
// with SCABO_GMSH, the path of the library.
#pragma once

#include <dlfcn.h>
#include <gmshc.h>

#include <iostream>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace scabo::files {

/// The library, or a function in it, is not there.
class GmshLoadError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Loaded once, for the rest of the process: libraries that it needs cannot be unloaded. Throws GmshLoadError.
void* loaded_gmsh();

template <class Function>
void find_symbol(const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(loaded_gmsh(), name));
  if (function == nullptr) throw GmshLoadError("it has no function " + std::string(name));
}

/// The functions of Gmsh's interface in C that all sessions use.
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
const GmshLibrary& gmsh_library();

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

/// An empty model in the library. One session at a time in a process: others wait. Errors are InputErrors of a file.
class GmshSession {
 public:
  using DimTags = std::vector<std::pair<int, int>>;

  /// `unit`: of lengths of STEP files in the model, as in M or MM.
  GmshSession(std::string file, const char* unit);
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  const std::string& file() const { return file_; }
  void set(const char* option, double value);
  /// Throws if there was an error, which `what` introduces; Gmsh's own message has the line of a .geo file.
  void check(int error, const char* what);
  /// Errors so far do not count.
  void forget_errors();
  DimTags taken(int* values, std::size_t count);
  DimTags entities(int dimension);
  /// Not gmshOpen, which also runs a file of options beside it.
  void merge(const std::string& path);
  /// Cells of dimension 2 or 3 with sides from `least` to `size`, or of the sizes that the model has if `size` is 0.
  void generate(int dimension, double least, double size, int order);
  /// The bytes of the .msh file that Gmsh writes: of all entities, or of physical groups only.
  std::string written(bool all);

 private:
  std::string first_error();

  std::lock_guard<std::mutex> lock_;
  const GmshLibrary& gmsh_;
  std::string file_;
  SilentOutput silent_;
};

}  // namespace scabo::files
