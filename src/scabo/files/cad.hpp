// CAD files, meshed by Gmsh's library: geometries of Gmsh (.geo), STEP (.step, .stp) and BREP of OpenCASCADE (.brep).
//
// The faces lie in the plane z = 0. Gmsh divides them into triangles (or what a .geo file asks for), and the mesh is
// what Scabo reads from the .msh file that Gmsh writes: physical groups become regions and sets; without physical
// surfaces the regions are `surface_1`, ... and the edges `curve_1`, ... (files/gmsh.hpp). Lengths of STEP files, which
// have a unit, become metres; those of .geo and .brep files stay as they are.
//
// A .geo file is a program. It may not run other programs, write files or end this one.
#pragma once

#include <string>

#include "scabo/files/imported_mesh.hpp"

namespace scabo::files {

/// Whether the name of a file ends as that of a CAD file: .geo, .step, .stp or .brep, in upper or lower case.
bool is_cad_file(const std::string& path);

/// Whether the name ends in .geo: such a file may have sizes of its own.
bool has_own_sizes(const std::string& path);

/// Whether Scabo was built with Gmsh's library.
bool reads_cad();

/// Throws InputError for a file that cannot be read, and a .brep that is cut off, which OpenCASCADE never ends reading.
void check_cad_file(const std::string& path);

struct CadOptions {
  double size = 0.0;  ///< length of the sides of cells, m; 0: the sizes that the file has (.geo), or Gmsh's own
  int order = 1;      ///< of the sides, 1 or 2
};

/// Nodes that a file's mesh may have, about.
constexpr double most_cad_nodes = 1e6;

/// The mesh of all faces of a CAD file. Throws InputError, with Gmsh's message and the line of a .geo file where it has
/// one: the file cannot be read, has no faces, a solid, faces outside of the plane z = 0, cannot be meshed, would have
/// more than most_cad_nodes nodes, has forbidden commands; or Gmsh's library is not there.
///
/// Calls from several threads wait for each other. Gmsh's library has one state for the whole process: the caller must
/// not use it at the same time. The stream std::cout is silent meanwhile, as OpenCASCADE writes to it.
ImportedMesh mesh_cad_file(const std::string& path, const CadOptions& options);

}  // namespace scabo::files
