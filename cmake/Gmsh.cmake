# SCABO_GMSH: Gmsh's library reads CAD (files/cad.hpp). AUTO: if libgmsh-dev is installed. The library is loaded when a CAD
# file is read, not linked: with all that it needs it would add 60 ms to every start of the program (docs/mesh_files.md).
set(SCABO_GMSH AUTO CACHE STRING "Gmsh's library, which reads CAD (libgmsh-dev): AUTO, ON or OFF")
set_property(CACHE SCABO_GMSH PROPERTY STRINGS AUTO ON OFF)
set(SCABO_GMSH_FOUND NO)
if(SCABO_GMSH)
  find_path(SCABO_GMSH_INCLUDE gmshc.h)
  find_library(SCABO_GMSH_LIBRARY gmsh)
  mark_as_advanced(SCABO_GMSH_INCLUDE SCABO_GMSH_LIBRARY)
  if(SCABO_GMSH_INCLUDE AND SCABO_GMSH_LIBRARY)
    set(SCABO_GMSH_FOUND YES)
    # libgmsh.so is of the development package; it points to the name with a version, which stays without it.
    set(SCABO_GMSH_FILE ${SCABO_GMSH_LIBRARY})
    if(IS_SYMLINK ${SCABO_GMSH_LIBRARY})
      file(READ_SYMLINK ${SCABO_GMSH_LIBRARY} SCABO_GMSH_FILE)
      get_filename_component(directory ${SCABO_GMSH_LIBRARY} DIRECTORY)
      get_filename_component(SCABO_GMSH_FILE ${SCABO_GMSH_FILE} ABSOLUTE BASE_DIR ${directory})
    endif()
  elseif(NOT SCABO_GMSH STREQUAL "AUTO")
    message(FATAL_ERROR "SCABO_GMSH needs libgmsh-dev, which was not found.\n"
                        "Install it (cmake/install_packages.sh cad), or configure with -DSCABO_GMSH=OFF.")
  endif()
endif()
