# SCABO_PYTHON_MODULE: the Python package `scabo` (python/). AUTO: if pybind11, Python's headers and NumPy are found
# (cmake/install_packages.sh python), and no sanitizer is in use. Sets SCABO_PYTHON_MODULE_FOUND and, below the prefix of
# an installation, SCABO_PYTHON_INSTALL_DIR.
scabo_optional(SCABO_PYTHON_MODULE "The Python package scabo (pybind11-dev, python3-dev)")
set(why_not "")
if(SCABO_PYTHON_MODULE STREQUAL "AUTO" AND CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  set(why_not "not with sanitizers")
elseif(SCABO_PYTHON_MODULE)
  find_package(ScaboPython QUIET)
  if(ScaboPython_FOUND)
    set(Python3_EXECUTABLE ${SCABO_PYTHON})
  endif()
  find_package(Python3 3.10 QUIET COMPONENTS Interpreter Development.Module NumPy)
  find_package(pybind11 2.9 QUIET CONFIG)
  if(NOT Python3_Development.Module_FOUND)
    set(why_not "Python's headers were not found (python3-dev; `make python` installs them)")
  elseif(NOT Python3_NumPy_FOUND)
    set(why_not "NumPy was not found (python3-numpy; `make python` installs it)")
  elseif(NOT pybind11_FOUND)
    set(why_not "pybind11 was not found (pybind11-dev; `make python` installs it)")
  else()
    set(SCABO_PYTHON_MODULE_FOUND YES)
  endif()
endif()
if(why_not)
  scabo_not_built(SCABO_PYTHON_MODULE "The Python package" "${why_not}")
endif()
if(SCABO_PYTHON_MODULE_FOUND)
  # Where Debian's Python looks below /usr/local, and any other below its prefix.
  execute_process(COMMAND ${Python3_EXECUTABLE} -c "import sys, sysconfig
name = 'dist-packages' if 'deb_system' in sysconfig.get_scheme_names() else 'site-packages'
print('lib/python%d.%d/%s' % (*sys.version_info[:2], name))"
                  OUTPUT_VARIABLE directory OUTPUT_STRIP_TRAILING_WHITESPACE)
  set(SCABO_PYTHON_INSTALL_DIR ${directory} CACHE STRING "Where the Python package is installed, below the prefix")
endif()
