# Run by cpack on the finished packages: lets the package of the shared library ask dpkg to run ldconfig,
# by a trigger, as Debian's policy wants it, instead of by the scripts that CPack puts in.
set(package ${CPACK_DEBIAN_SHARED_PACKAGE_NAME})
set(file ${CPACK_PACKAGE_FILES})
list(FILTER file INCLUDE REGEX "/${package}_")
if(NOT file)
  return()
endif()
set(folder ${CPACK_TEMPORARY_DIRECTORY}/${package})
file(REMOVE_RECURSE ${folder})
execute_process(COMMAND dpkg-deb --raw-extract ${file} ${folder} COMMAND_ERROR_IS_FATAL ANY)
file(REMOVE ${folder}/DEBIAN/postinst ${folder}/DEBIAN/postrm)
file(WRITE ${folder}/DEBIAN/triggers "activate-noawait ldconfig\n")
file(CHMOD ${folder}/DEBIAN/triggers PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
execute_process(COMMAND dpkg-deb --root-owner-group --build ${folder} ${file}
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
