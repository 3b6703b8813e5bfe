# Run by cpack on the folders of files of the packages, before they are packed: what Debian asks of a
# package and cmake --install does not do. Compressed manual pages, changelogs, a copyright file, zsh's
# completions where Debian's zsh looks for them, and no second copy of the licence.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result ERROR_VARIABLE error)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGN}\n${error}")
  endif()
endfunction()

# The first version of CHANGELOG.md, as Debian writes it: `## [0.1.0] - 2026-11-25` has to be that version.
function(write_debian_changelog file)
  set(heading "^## \\[([0-9.]+)\\] - ([0-9]+-[0-9]+-[0-9]+)$")
  file(STRINGS ${CPACK_HIAC_SOURCE}/CHANGELOG.md versions REGEX "${heading}")
  list(GET versions 0 newest)
  string(REGEX MATCH "${heading}" newest "${newest}")
  if(NOT CMAKE_MATCH_1 STREQUAL CPACK_PACKAGE_VERSION)
    message(FATAL_ERROR "CHANGELOG.md: version ${CPACK_PACKAGE_VERSION} expected first, "
                        "${CMAKE_MATCH_1} found")
  endif()
  execute_process(COMMAND date --utc --rfc-email --date ${CMAKE_MATCH_2}
                  OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  file(WRITE ${file}
       "hiac (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) bookworm; urgency=medium\n\n"
       "  * Version ${CPACK_PACKAGE_VERSION}: see /usr/share/doc/hiac/changelog.gz of the package hiac.\n\n"
       " -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
endfunction()

foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(prefix ${CPACK_TEMPORARY_DIRECTORY}/${component}${CPACK_PACKAGING_INSTALL_PREFIX})
  set(documents ${prefix}/share/doc/${package})

  write_debian_changelog(${documents}/changelog.Debian)
  set(to_compress ${documents}/changelog.Debian)
  if(package STREQUAL "hiac")
    file(RENAME ${documents}/CHANGELOG.md ${documents}/changelog)
    list(APPEND to_compress ${documents}/changelog)
    file(REMOVE ${documents}/LICENSE)  # stands in the file copyright
  endif()
  file(READ ${CPACK_HIAC_SOURCE}/packaging/debian/copyright copyright)
  if(package STREQUAL "hiac-tetrahedralize")
    file(READ ${CPACK_HIAC_SOURCE}/packaging/debian/copyright.tetrahedralize more)
    string(APPEND copyright "${more}")
  endif()
  file(WRITE ${documents}/copyright "${copyright}")

  file(GLOB pages ${prefix}/share/man/man*/*)
  run(gzip -9 -n -f ${to_compress} ${pages})
  if(EXISTS ${prefix}/share/zsh/site-functions)
    file(RENAME ${prefix}/share/zsh/site-functions ${prefix}/share/zsh/vendor-completions)
  endif()
  # cmake --install strips programs, not archives
  file(GLOB objects ${prefix}/lib/*.a ${prefix}/lib/*/*.a)
  if(objects)
    run(strip --strip-unneeded --remove-section=.comment --remove-section=.note
        --enable-deterministic-archives ${objects})
  endif()
endforeach()
