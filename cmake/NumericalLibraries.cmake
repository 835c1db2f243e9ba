# OpenBLAS provides BLAS and LAPACK; LAPACKE, CHOLMOD and UMFPACK use it; HDF5 reads and writes files, PNG reads images. None
# of them has a CMake package on every Debian and Ubuntu (FindHDF5 of CMake fails in a project without C), so each becomes the target
# scabo::<name> here. The file is installed beside scaboConfig.cmake, because a static Scabo needs the same targets.
set(SCABO_NUMERICAL_LIBRARIES_MISSING "")
foreach(name openblas lapacke cholmod umfpack hdf5 png)
  string(TOUPPER SCABO_${name} variable)
  find_library(${variable} NAMES ${name} ${name}_serial)  # Debian calls HDF5 without MPI hdf5_serial
  mark_as_advanced(${variable})
  if(NOT ${variable})
    list(APPEND SCABO_NUMERICAL_LIBRARIES_MISSING ${name})
  elseif(NOT TARGET scabo::${name})
    add_library(scabo::${name} UNKNOWN IMPORTED)
    set_target_properties(scabo::${name} PROPERTIES IMPORTED_LOCATION ${${variable}})
  endif()
endforeach()
