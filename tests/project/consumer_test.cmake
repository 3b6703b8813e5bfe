# Installs what is built into a prefix of its own and there configures, builds and runs a project
# that knows hiac by find_package(hiac) alone. Builds nothing of hiac again.
#   cmake -D BUILD=... -D SOURCE=... -D WORK=... -D GENERATOR=... -D COMPILER=...
#         -D FORMATS=ON|OFF -P consumer_test.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${result}): ${command}\n${out}")
  endif()
endfunction()

function(require_absent pattern)
  file(GLOB package ${WORK}/prefix/lib*/cmake/hiac/*.cmake ${WORK}/prefix/lib*/*/cmake/hiac/*.cmake)
  if(NOT package)
    message(FATAL_ERROR "no CMake package in ${WORK}/prefix")
  endif()
  foreach(file ${package})
    file(STRINGS ${file} found REGEX ${pattern})
    if(found)
      message(FATAL_ERROR "${file} names what belongs to the build alone: ${found}")
    endif()
  endforeach()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
require_absent("hiac_build_flags")
require_absent(${BUILD})
require_absent(${SOURCE})

# moved before use: an installed prefix must not know where it was installed
file(RENAME ${WORK}/prefix ${WORK}/moved)
function(build_project folder build)
  run(${CMAKE_COMMAND} -S ${folder} -B ${build} -G ${GENERATOR}
      -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${WORK}/moved
      -D CMAKE_FIND_USE_PACKAGE_REGISTRY=OFF ${ARGN})
  run(${CMAKE_COMMAND} --build ${build})
endfunction()

build_project(${CMAKE_CURRENT_LIST_DIR}/consumer ${WORK}/build
              -D HIAC_HEADERS=${WORK}/moved/include)
run(${WORK}/build/consumer ${WORK}/mesh.zoo)

# a program that reads foreign files knows the component formats, where it was built
file(GLOB formats_package ${WORK}/moved/lib*/cmake/hiac/hiacFormats.cmake
     ${WORK}/moved/lib*/*/cmake/hiac/hiacFormats.cmake)
if(FORMATS)
  if(NOT formats_package)
    message(FATAL_ERROR "the component formats is not installed")
  endif()
  build_project(${CMAKE_CURRENT_LIST_DIR}/formats_consumer ${WORK}/formats_build)
  file(WRITE ${WORK}/cell.vtk "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n"
       "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n"
       "POINT_DATA 4\nSCALARS s double\nLOOKUP_TABLE default\n0 1 2 3\n")
  run(${WORK}/formats_build/formats_consumer ${WORK}/cell.vtk ${WORK}/cell.zoo)
  run(${WORK}/moved/bin/hiac-info ${WORK}/cell.zoo)
  # as many formats as the installed tool lists
  execute_process(COMMAND ${WORK}/formats_build/formats_consumer OUTPUT_VARIABLE named)
  execute_process(COMMAND ${WORK}/moved/bin/hiac-convert --list-formats OUTPUT_VARIABLE listed)
  string(STRIP "${named}" named)
  string(REPLACE "\n" ";" named "${named}")
  foreach(format IN LISTS named)
    if(NOT listed MATCHES "(^|\n)${format} ")
      message(FATAL_ERROR "hiac-convert does not list the format ${format} of the library")
    endif()
  endforeach()
  list(LENGTH named count)
  if(count LESS 20)
    message(FATAL_ERROR "the installed library knows ${count} formats alone: ${named}")
  endif()
elseif(formats_package)
  message(FATAL_ERROR "the component formats is installed, and was not built")
endif()

# the sample is a program that a newcomer reads at a glance
file(STRINGS ${SOURCE}/samples/program/main.cpp lines REGEX "^")
list(LENGTH lines count)
if(count GREATER 40)
  message(FATAL_ERROR "samples/program/main.cpp: 40 lines at most expected, ${count} found")
endif()
build_project(${SOURCE}/samples/program ${WORK}/program)
run(${WORK}/program/first_picture ${WORK}/mesh.zoo ${WORK}/picture.png)
run(${WORK}/moved/bin/hiac-info ${WORK}/picture.png)

# the same program over the shared library draws the same picture, and sees the library's exceptions
build_project(${CMAKE_CURRENT_LIST_DIR}/shared_consumer ${WORK}/shared_build
              -D HIAC_PROGRAM=${SOURCE}/samples/program/main.cpp)
run(${WORK}/shared_build/first_picture ${WORK}/mesh.zoo ${WORK}/shared.png)
run(${WORK}/moved/bin/hiac-compare ${WORK}/picture.png ${WORK}/shared.png --max-error 0)
execute_process(COMMAND ${WORK}/shared_build/first_picture ${WORK}/absent.zoo ${WORK}/absent.png
                RESULT_VARIABLE result ERROR_VARIABLE error)
if(NOT result EQUAL 3 OR NOT error MATCHES "absent.zoo")
  message(FATAL_ERROR "an error of the shared library arrives as (${result}): ${error}")
endif()
foreach(tool sort render compare)
  run(${WORK}/moved/bin/hiac-${tool} --version)
endforeach()
