# SCABO_MUMPS: MUMPS as another library for sparse factorisations (linalg/mumps_factor.cpp). AUTO: if libmumps-seq-dev is
# installed. Like Gmsh's library, it is loaded when a model asks for it, not linked.
set(SCABO_MUMPS AUTO CACHE STRING "MUMPS without MPI (libmumps-seq-dev): AUTO, ON or OFF")
set_property(CACHE SCABO_MUMPS PROPERTY STRINGS AUTO ON OFF)
set(SCABO_MUMPS_FOUND NO)
if(SCABO_MUMPS)
  find_path(SCABO_MUMPS_INCLUDE dmumps_c.h)
  find_library(SCABO_MUMPS_LIBRARY dmumps_seq)
  mark_as_advanced(SCABO_MUMPS_INCLUDE SCABO_MUMPS_LIBRARY)
  if(SCABO_MUMPS_INCLUDE AND SCABO_MUMPS_LIBRARY)
    set(SCABO_MUMPS_FOUND YES)
    set(SCABO_MUMPS_FILE ${SCABO_MUMPS_LIBRARY})  # of the development package; it points to the name with a version
    if(IS_SYMLINK ${SCABO_MUMPS_LIBRARY})
      file(READ_SYMLINK ${SCABO_MUMPS_LIBRARY} SCABO_MUMPS_FILE)
      get_filename_component(directory ${SCABO_MUMPS_LIBRARY} DIRECTORY)
      get_filename_component(SCABO_MUMPS_FILE ${SCABO_MUMPS_FILE} ABSOLUTE BASE_DIR ${directory})
    endif()
  elseif(NOT SCABO_MUMPS STREQUAL "AUTO")
    message(FATAL_ERROR "SCABO_MUMPS needs libmumps-seq-dev, which was not found.\n"
                        "Install it (cmake/install_packages.sh mumps), or configure with -DSCABO_MUMPS=OFF.")
  endif()
endif()
