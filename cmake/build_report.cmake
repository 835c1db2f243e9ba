# cmake -DSOURCES=a,b -DFROM=... -DIN=... -DNODE=... -DNPM=... -DPAGE=... -DCOPY=... -DMODE=AUTO -P build_report.cmake: copies the
# sources of the page into the folder IN, fetches their packages there if package-lock.json has changed, and builds PAGE and
# COPY. In mode AUTO, packages that cannot be fetched are a warning.
string(REPLACE "," ";" SOURCES "${SOURCES}")
file(REMOVE_RECURSE ${IN}/src)
foreach(name ${SOURCES})
  get_filename_component(place ${IN}/${name} DIRECTORY)
  file(COPY ${FROM}/${name} DESTINATION ${place})
endforeach()

get_filename_component(node_folder ${NODE} DIRECTORY)
set(ENV{PATH} "${node_folder}:$ENV{PATH}")
file(SHA256 ${IN}/package-lock.json wanted)
set(fetched "")
if(EXISTS ${IN}/fetched.txt)
  file(READ ${IN}/fetched.txt fetched)
endif()
if(NOT fetched STREQUAL wanted)
  execute_process(COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error --fetch-retries=1 --fetch-timeout=60000
                  WORKING_DIRECTORY ${IN} RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(failed)
    set(message "The page for reports is not built, so that `scabo report` will say that it is missing: npm could not fetch its \
packages, which needs a network once. `make build` tries again; -DSCABO_REPORT=OFF does not.\n${said}")
    if(MODE STREQUAL "AUTO")
      message(WARNING "${message}")
      return()
    endif()
    message(FATAL_ERROR "${message}")
  endif()
  file(WRITE ${IN}/fetched.txt ${wanted})
endif()

execute_process(COMMAND ${NODE} node_modules/vite/bin/vite.js build --logLevel error WORKING_DIRECTORY ${IN} RESULT_VARIABLE failed
                OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(failed)
  message(FATAL_ERROR "The page for reports cannot be built:\n${said}")
endif()
foreach(page ${PAGE} ${COPY})
  get_filename_component(place ${page} DIRECTORY)
  file(MAKE_DIRECTORY ${place})
  configure_file(${IN}/dist/index.html ${page} COPYONLY)
endforeach()
file(TOUCH ${PAGE})
