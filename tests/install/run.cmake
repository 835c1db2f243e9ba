# cmake -D build=... -D scratch=... -D python=... -P run.cmake: see CMakeLists.txt.
set(prefix ${scratch}/prefix)
set(consumer ${scratch}/build)
file(REMOVE_RECURSE ${scratch})

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGV}")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${build} --prefix ${prefix})

# Moved after it was installed: nothing in it may point to where it was, or to the sources.
file(RENAME ${prefix} ${scratch}/moved)
set(prefix ${scratch}/moved)

foreach(file bin/scabo include/scabo/input/read_model.hpp ${libdir}/cmake/scabo/scaboConfig.cmake
             share/scabo/model.schema.json share/scabo/examples share/scabo/scabo_plot/__main__.py share/doc/scabo/LICENSE
             share/doc/scabo/docs/model_file.md share/man/man1/scabo.1 share/bash-completion/completions/scabo
             share/zsh/site-functions/_scabo share/fish/vendor_completions.d/scabo.fish)
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()
run(${prefix}/bin/scabo --version)
if(python_directory)  # the Python package
  run(${CMAKE_COMMAND} -E env --unset=PYTHONHOME PYTHONPATH=${prefix}/${python_directory} PYTHONDONTWRITEBYTECODE=1
      ${python} -c "import scabo, sys\nsys.exit(not scabo.__file__.startswith('${prefix}') or not scabo.schema())")
endif()

# What was installed writes a model, solves it and draws it; the examples find the package for pictures beside them.
run(${prefix}/bin/scabo new beam -o ${scratch}/beam.yaml)
run(${prefix}/bin/scabo run --quiet ${scratch}/beam.yaml)
run(${CMAKE_COMMAND} -E env SCABO_PYTHON=${python} ${prefix}/bin/scabo plot ${scratch}/beam.results)
foreach(kind stress contact convergence mesh history)
  if(NOT EXISTS ${scratch}/beam.${kind}.png)
    message(FATAL_ERROR "not drawn: ${kind}")
  endif()
endforeach()
run(${CMAKE_COMMAND} -E chdir ${prefix}/share/scabo/examples ${python} -B -c "import pictures")

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B ${consumer} -G ${generator}
    -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_BUILD_TYPE=${build_type})
run(${CMAKE_COMMAND} --build ${consumer})
run(${consumer}/consumer)
include(${CMAKE_CURRENT_LIST_DIR}/readme.cmake)
