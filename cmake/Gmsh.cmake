# SCABO_GMSH: Gmsh's library reads CAD (files/cad.hpp). The library is loaded when a CAD file is read, not linked: with all
# that it needs it would add 60 ms to every start of the program (docs/mesh_files.md).
scabo_loaded_library(SCABO_GMSH "Gmsh's library, which reads CAD" header gmshc.h library gmsh package libgmsh-dev group cad)
