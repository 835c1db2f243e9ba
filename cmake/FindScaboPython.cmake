# SCABO_PYTHON: the interpreter for tests, examples and benchmarks, chosen by cmake/find_python.sh and kept.
set(SCABO_PYTHON "" CACHE STRING "Python interpreter; empty: found by cmake/find_python.sh")
if(NOT SCABO_PYTHON OR NOT SCABO_PYTHON STREQUAL SCABO_PYTHON_CHECKED)
  execute_process(COMMAND ${CMAKE_CURRENT_LIST_DIR}/find_python.sh ${SCABO_PYTHON}
                  RESULT_VARIABLE status OUTPUT_VARIABLE found ERROR_VARIABLE reason
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(status EQUAL 0)
    set(SCABO_PYTHON "${found}" CACHE STRING "Python interpreter" FORCE)
    set(SCABO_PYTHON_CHECKED "${found}" CACHE INTERNAL "")
  else()
    set(ScaboPython_NOT_FOUND_MESSAGE "${reason}")
    unset(SCABO_PYTHON CACHE)  # the next run looks afresh
    unset(SCABO_PYTHON_CHECKED CACHE)
  endif()
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ScaboPython REQUIRED_VARS SCABO_PYTHON_CHECKED
                                  REASON_FAILURE_MESSAGE "${ScaboPython_NOT_FOUND_MESSAGE}")
