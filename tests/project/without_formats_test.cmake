# Configured without the foreign formats, tests and benchmarks, hiac asks for neither VTK nor any
# part under the GPL, and the tools that need none of them are there.
#   cmake -D SOURCE=... -D WORK=... -D COMPILER=... -P without_formats_test.cmake
file(REMOVE_RECURSE ${WORK})
execute_process(
  COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK} -G Ninja -D CMAKE_CXX_COMPILER=${COMPILER}
          -D HIAC_FORMATS=OFF -D HIAC_TESTS=OFF -D HIAC_BENCHMARKS=OFF
          -D CMAKE_DISABLE_FIND_PACKAGE_VTK=ON -D CMAKE_DISABLE_FIND_PACKAGE_GTest=ON
          -D CMAKE_DISABLE_FIND_PACKAGE_benchmark=ON
  RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE out)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "cannot be configured without formats:\n${out}")
endif()
file(READ ${WORK}/build.ninja rules)
foreach(wanted hiac-sort hiac-render hiac-compare hiac-info)
  if(NOT rules MATCHES "build tools/[a-z]+/${wanted}:")
    message(FATAL_ERROR "${wanted} is not built without formats")
  endif()
endforeach()
foreach(unwanted vtk hiac-convert delaunay)
  if(rules MATCHES ${unwanted})
    message(FATAL_ERROR "${unwanted} is there without formats")
  endif()
endforeach()
