#!/bin/sh
# Uses what hiac's packages installed, as a user would: the steps of packaging/try-packages.sh inside of its
# clean root, and of Containerfile. Ends with 1 at the first that fails.
set -eu
work=$(mktemp -d)
cd "$work"
documents=/usr/share/doc/hiac
sample=$documents/samples/reactor-pool

# the sample's three commands; the picture is the one that hiac's documentation shows
hiac-convert "$sample/flow.vtu" |
  hiac-sort --view "$sample/view.toml" |
  hiac-render --view "$sample/view.toml" -o flow.png
hiac-compare flow.png "$sample/flow.png" --max-error 1e-2

# every command, by its own name and by the umbrella's, and its manual page
for program in /usr/bin/hiac-*; do
  "$program" --version
  name=${program##*/}
  test -s "/usr/share/man/man1/$name.1.gz"
  test -s "/usr/share/bash-completion/completions/$name"
done
hiac --version
hiac picture "$sample/flow.vtu" >picture.log 2>&1 || { cat picture.log; exit 1; }

if [ -e /usr/bin/hiac-tetrahedralize ]; then
  hiac-convert "$sample/flow.vtu" -o flow.zoo
  hiac-tetrahedralize flow.zoo --cells -o cells.zoo
  hiac-check cells.zoo
fi

# a program over the library as the package libhiac-dev brings it, static and shared
if ls /usr/lib/*/cmake/hiac/hiacConfig.cmake >/dev/null 2>&1; then
  cp -r "$documents/samples/program" static
  cmake -S static -B static/build -G Ninja
  cmake --build static/build
  hiac-convert "$sample/flow.vtu" -o flow.zoo
  static/build/first_picture flow.zoo static.png
  cp -r "$documents/samples/program" shared
  sed -i 's/find_package(hiac REQUIRED)/find_package(hiac REQUIRED COMPONENTS shared)/; s/hiac::hiac/hiac::shared/' \
    shared/CMakeLists.txt
  cmake -S shared -B shared/build -G Ninja
  cmake --build shared/build
  ldd shared/build/first_picture | grep libhiac.so
  shared/build/first_picture flow.zoo shared.png
  hiac-compare static.png shared.png --max-error 0
fi

# a program that reads foreign files, as libhiac-formats-dev brings the readers
if ls /usr/lib/*/cmake/hiac/hiacFormats.cmake >/dev/null 2>&1; then
  mkdir readers
  cat >readers/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.25)
project(readers LANGUAGES C CXX)
find_package(hiac REQUIRED COMPONENTS formats)
add_executable(readers main.cpp)
target_link_libraries(readers PRIVATE hiac::formats)
END
  cat >readers/main.cpp <<'END'
#include <formats/registry.hpp>
int main(int, char** argv) {
  return hiac::formats::format_to_read(argv[1]).read(argv[1], {}).mesh.kinds.empty() ? 1 : 0;
}
END
  cmake -S readers -B readers/build -G Ninja
  cmake --build readers/build
  readers/build/readers "$sample/flow.vtu"
fi

if dpkg-query -W python3-hiac >/dev/null 2>&1; then
  python3 -c 'import hiac; print(hiac.__file__)'
fi
cd /
rm -rf "$work"
