# OpenBLAS provides BLAS and LAPACK; LAPACKE, CHOLMOD and UMFPACK use it; HDF5 reads and writes files, PNG reads images,
# ISA-L compresses fields. None of them has a CMake package on every Debian and Ubuntu (FindHDF5 of CMake fails in a project without C), so each becomes the target
# scabo::<name> here. The file is installed beside scaboConfig.cmake, because a static Scabo needs the same targets.
set(SCABO_NUMERICAL_LIBRARIES_MISSING "")
# A target with the property SCABO_HDF5_INSIDE contains HDF5, if its archive is installed: the shared library loads forty others
# with it, for files on other hosts, which takes 5 ms.
find_library(SCABO_HDF5_ARCHIVE NAMES libhdf5.a libhdf5_serial.a)
find_library(SCABO_SZ NAMES sz)
mark_as_advanced(SCABO_HDF5_ARCHIVE SCABO_SZ)
foreach(name openblas lapacke cholmod umfpack hdf5 png isal)
  string(TOUPPER SCABO_${name} variable)
  find_library(${variable} NAMES ${name} ${name}_serial)  # Debian calls HDF5 without MPI hdf5_serial
  mark_as_advanced(${variable})
  if(NOT ${variable})
    list(APPEND SCABO_NUMERICAL_LIBRARIES_MISSING ${name})
  elseif(name STREQUAL "hdf5" AND SCABO_HDF5_ARCHIVE AND SCABO_SZ AND NOT TARGET scabo::hdf5)
    set(alone $<BOOL:$<TARGET_PROPERTY:SCABO_HDF5_INSIDE>>)
    add_library(scabo::hdf5 INTERFACE IMPORTED)
    set_target_properties(scabo::hdf5 PROPERTIES INTERFACE_LINK_LIBRARIES
      "$<${alone}:${SCABO_HDF5_ARCHIVE}>;$<${alone}:${SCABO_SZ}>;$<${alone}:ZLIB::ZLIB>;$<$<NOT:${alone}>:${SCABO_HDF5}>")
  elseif(NOT TARGET scabo::${name})
    add_library(scabo::${name} UNKNOWN IMPORTED)
    set_target_properties(scabo::${name} PROPERTIES IMPORTED_LOCATION ${${variable}})
  endif()
endforeach()
