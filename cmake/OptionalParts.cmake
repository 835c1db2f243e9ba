# Parts that are built where what they need is installed: each has a variable of the cache, AUTO (if it is found), ON or OFF.

# scabo_optional(NAME WHAT): the variable NAME, and NAME_FOUND, which is NO for now.
macro(scabo_optional name what)
  set(${name} AUTO CACHE STRING "${what}: AUTO, ON or OFF")
  set_property(CACHE ${name} PROPERTY STRINGS AUTO ON OFF)
  set(${name}_FOUND NO)
endmacro()

# scabo_not_built(NAME PART REASON): a line if NAME is AUTO, the end of the configuration if it is ON.
function(scabo_not_built name part reason)
  if(NOT ${name} STREQUAL "AUTO")
    message(FATAL_ERROR "${name}: ${reason}.\nOr configure with -D${name}=OFF.")
  endif()
  message(STATUS "${part} is not built: ${reason}")
endfunction()

# scabo_loaded_library(NAME WHAT header HEADER library LIBRARY package PACKAGE group GROUP): a library that is loaded when it
# is needed, not linked. Sets NAME_FOUND, NAME_INCLUDE and NAME_FILE, its name with a version: that without one is of the
# development package. GROUP: in cmake/packages.txt.
macro(scabo_loaded_library name what)
  cmake_parse_arguments(loaded "" "header;library;package;group" "" ${ARGN})
  scabo_optional(${name} "${what} (${loaded_package})")
  if(${name})
    find_path(${name}_INCLUDE ${loaded_header})
    find_library(${name}_LIBRARY ${loaded_library})
    mark_as_advanced(${name}_INCLUDE ${name}_LIBRARY)
    if(${name}_INCLUDE AND ${name}_LIBRARY)
      set(${name}_FOUND YES)
      set(${name}_FILE ${${name}_LIBRARY})
      if(IS_SYMLINK ${${name}_LIBRARY})
        file(READ_SYMLINK ${${name}_LIBRARY} ${name}_FILE)
        get_filename_component(loaded_directory ${${name}_LIBRARY} DIRECTORY)
        get_filename_component(${name}_FILE ${${name}_FILE} ABSOLUTE BASE_DIR ${loaded_directory})
      endif()
    elseif(NOT ${name} STREQUAL "AUTO")
      message(FATAL_ERROR "${name} needs ${loaded_package}, which was not found.\n"
                          "Install it (cmake/install_packages.sh ${loaded_group}), or configure with -D${name}=OFF.")
    endif()
  endif()
endmacro()
