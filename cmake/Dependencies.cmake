# Everything Scabo is built on, all from Debian packages (cmake/packages.txt). Reports all that is missing at once.
set(missing "")
foreach(package "Eigen3 3.4" fmt yaml-cpp muparser nlohmann_json CLI11 pugixml)
  separate_arguments(package)
  list(GET package 0 name)
  find_package(${package} QUIET CONFIG)
  if(NOT ${name}_FOUND)
    list(APPEND missing ${name})
  endif()
endforeach()

find_package(ZLIB QUIET)
if(NOT ZLIB_FOUND)
  list(APPEND missing zlib)
endif()

include(${CMAKE_CURRENT_LIST_DIR}/NumericalLibraries.cmake)
list(APPEND missing ${SCABO_NUMERICAL_LIBRARIES_MISSING})

find_path(SCABO_SUITESPARSE_INCLUDE cholmod.h PATH_SUFFIXES suitesparse)
mark_as_advanced(SCABO_SUITESPARSE_INCLUDE)
if(SCABO_SUITESPARSE_INCLUDE AND TARGET scabo::cholmod)
  set_target_properties(scabo::cholmod PROPERTIES
                        INTERFACE_INCLUDE_DIRECTORIES ${SCABO_SUITESPARSE_INCLUDE})
else()
  list(APPEND missing cholmod.h)
endif()

find_path(SCABO_HDF5_INCLUDE hdf5.h PATH_SUFFIXES hdf5/serial)
mark_as_advanced(SCABO_HDF5_INCLUDE)
if(SCABO_HDF5_INCLUDE AND TARGET scabo::hdf5)
  set_target_properties(scabo::hdf5 PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${SCABO_HDF5_INCLUDE})
else()
  list(APPEND missing hdf5.h)
endif()

find_path(SCABO_PNG_INCLUDE png.h)
mark_as_advanced(SCABO_PNG_INCLUDE)
if(SCABO_PNG_INCLUDE AND TARGET scabo::png)
  set_target_properties(scabo::png PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${SCABO_PNG_INCLUDE})
else()
  list(APPEND missing png.h)
endif()

find_path(SCABO_ISAL_INCLUDE isa-l/igzip_lib.h)
mark_as_advanced(SCABO_ISAL_INCLUDE)
if(SCABO_ISAL_INCLUDE AND TARGET scabo::isal)
  set_target_properties(scabo::isal PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${SCABO_ISAL_INCLUDE})
else()
  list(APPEND missing isa-l/igzip_lib.h)
endif()

find_path(SCABO_SPECTRA_INCLUDE Spectra/SymGEigsShiftSolver.h)
mark_as_advanced(SCABO_SPECTRA_INCLUDE)
if(NOT SCABO_SPECTRA_INCLUDE)
  list(APPEND missing Spectra)
endif()

find_path(SCABO_CGAL_INCLUDE CGAL/Constrained_Delaunay_triangulation_2.h)  # headers only, with those of Boost
mark_as_advanced(SCABO_CGAL_INCLUDE)
if(NOT SCABO_CGAL_INCLUDE)
  list(APPEND missing CGAL)
endif()

if(missing)
  list(JOIN missing ", " missing)
  message(FATAL_ERROR "Scabo needs what was not found: ${missing}.\n"
                      "On Debian and Ubuntu, 'make packages' installs everything (cmake/packages.txt).")
endif()
