# hiac::hiac is a static library: who links it also links what it stands on.
find_dependency(TBB)
find_dependency(fmt)
find_dependency(pugixml)
find_dependency(PNG)
find_dependency(TIFF)
find_dependency(PkgConfig)

# The libraries that are found through pkg-config, under the target names that the library was
# linked by (PkgConfig::NAME).
foreach(_hiac_dependency XXHASH:libxxhash HWY:libhwy TOMLPLUSPLUS:tomlplusplus OPENEXR:OpenEXR
                         GMP:gmp)
  string(REPLACE ":" ";" _hiac_dependency ${_hiac_dependency})
  list(GET _hiac_dependency 0 _hiac_name)
  list(GET _hiac_dependency 1 _hiac_module)
  if(NOT TARGET PkgConfig::${_hiac_name})
    pkg_check_modules(${_hiac_name} QUIET IMPORTED_TARGET ${_hiac_module})
  endif()
  if(NOT TARGET PkgConfig::${_hiac_name})
    set(hiac_FOUND FALSE)
    set(hiac_NOT_FOUND_MESSAGE "hiac needs ${_hiac_module}, which pkg-config does not find")
    return()
  endif()
endforeach()
unset(_hiac_dependency)
unset(_hiac_name)
unset(_hiac_module)

include(${CMAKE_CURRENT_LIST_DIR}/hiacTargets.cmake)
