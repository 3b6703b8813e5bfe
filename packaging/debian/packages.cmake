# The Debian packages: which component each holds, and what it needs besides the shared libraries that
# dpkg-shlibdeps finds in its binaries.
set(HIAC_ABOUT "hiac makes volume-rendered pictures of finite-element results that
can be trusted: it orders cells by exact predicates and integrates the field
along every ray in closed form or with a proven error bound.")
set(same_version "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")

hiac_package(tools hiac "reference volume renderer for finite-element results"
  "This package contains the tools: hiac-convert, hiac-check, hiac-sort,
hiac-render, hiac-info and hiac-compare, their manual pages and completions,
the documentation and a sample."
  SUGGESTS "hiac-view ${same_version}" "hiac-preview ${same_version}"
           "hiac-tetrahedralize ${same_version}" ffmpeg)

hiac_package(view hiac-view "window for exact pictures of finite-element results"
  "This package contains hiac-view, a window in which views and transfer
functions are set."
  DEPENDS "hiac ${same_version}" libegl1 RECOMMENDS libgl1-mesa-dri)

hiac_package(preview hiac-preview "hardware preview of the volume renderer hiac"
  "This package contains hiac-preview, which draws by OpenGL, without a screen."
  DEPENDS "hiac ${same_version}" libegl1 RECOMMENDS libgl1-mesa-dri)

hiac_package(tetrahedralize hiac-tetrahedralize "tetrahedral meshes for the volume renderer hiac"
  "This package contains hiac-tetrahedralize, which makes tetrahedra of
surfaces, points and cells. Unlike the rest of hiac it is under the GNU
Affero General Public License, as it contains TetGen and parts of CGAL."
  DEPENDS "hiac ${same_version}")

hiac_package(shared libhiac${HIAC_SOVERSION} "volume renderer for finite-element results, library"
  "This package contains the shared library, for programs that are linked with
it."
  SECTION libs)

hiac_package(development libhiac-dev "volume renderer for finite-element results, for developers"
  "This package contains the headers, the static library, what programs need to
be linked with the shared one, and the package of CMake."
  SECTION libdevel
  DEPENDS "libhiac${HIAC_SOVERSION} ${same_version}" pkg-config libtbb-dev libfmt-dev libpugixml-dev
          libpng-dev libtiff-dev libxxhash-dev libhwy-dev libtomlplusplus-dev libopenexr-dev
          libgmp-dev)

hiac_package(formats libhiac-formats-dev "readers of finite-element files, for developers"
  "This package contains the static library by which programs read and write
the files of finite-element programs: hiac::formats of the package of CMake."
  SECTION libdevel
  DEPENDS "libhiac-dev ${same_version}" libvtk9-dev zlib1g-dev libhdf5-dev libnetcdf-dev libcgns-dev
          libsilo-dev)

hiac_package(python python3-hiac "volume renderer for finite-element results, Python module"
  "This package contains the Python module hiac."
  SECTION python DEPENDS python3-numpy "python3 (>= 3.11)" "python3 (<< 3.12)"
  SUGGESTS python3-ipywidgets python3-vtk9)

hiac_package(mpi hiac-mpi "volume renderer for finite-element results, on clusters"
  "This package contains hiac-render-mpi, whose processes hold a part of the
mesh each."
  DEPENDS "hiac ${same_version}" openmpi-bin)

# every library under multiarch folders may be installed beside that of another architecture
set(CPACK_DEBIAN_SHARED_PACKAGE_MULTIARCH same)
# programs that are linked with libhiac learn by shlibs which package to depend on
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
# archives of object code alone depend on what packages.cmake names
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_FORMATS_PACKAGE_SHLIBDEPS OFF)
# what Python compiles beside the module goes with it
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/python/postinst
                                              ${CMAKE_CURRENT_LIST_DIR}/python/prerm)
