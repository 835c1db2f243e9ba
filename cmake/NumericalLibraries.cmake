# OpenBLAS brings BLAS and LAPACK; LAPACKE and CHOLMOD stand on it. None of them has a CMake package on every
# Debian and Ubuntu, so each becomes the target scabo::<name> here. Installed beside scaboConfig.cmake, where a
# static Scabo needs the same targets.
set(SCABO_NUMERICAL_LIBRARIES_MISSING "")
foreach(name openblas lapacke cholmod)
  string(TOUPPER SCABO_${name} variable)
  find_library(${variable} ${name})
  mark_as_advanced(${variable})
  if(NOT ${variable})
    list(APPEND SCABO_NUMERICAL_LIBRARIES_MISSING ${name})
  elseif(NOT TARGET scabo::${name})
    add_library(scabo::${name} UNKNOWN IMPORTED)
    set_target_properties(scabo::${name} PROPERTIES IMPORTED_LOCATION ${${variable}})
  endif()
endforeach()
