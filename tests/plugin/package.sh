#!/usr/bin/env bash
# Installs the package into an empty folder, moves it, and builds against it what its users would: the example plugin, the
# projects of the documentation, and plugins that have to be refused. Usage: package.sh BUILD SOURCE WORK CXX BUILD_TYPE
set -euo pipefail
build=$1 source=$2 work=$3 cxx=$4 type=$5
unset CREVICE_DATA_DIR LD_LIBRARY_PATH
rm -rf "$work"
mkdir -p "$work"/{outline,library,stages,compute,refused}

cmake --install "$build" --prefix "$work/installed" >"$work/install.log"
mv "$work/installed" "$work/crevice"
cp "$work/crevice/share/crevice/effects/copy.effect" "$work/crevice/share/crevice/effects/only-in-the-package.effect"

export PATH="$work/crevice/bin:$PATH" CMAKE_PREFIX_PATH="$work/crevice" CXX="$cxx" CMAKE_BUILD_PARALLEL_LEVEL=2
if command -v ninja >/dev/null; then export CMAKE_GENERATOR=Ninja; fi
if command -v ccache >/dev/null; then export CMAKE_CXX_COMPILER_LAUNCHER=ccache; fi

build_outline() {
  cp "$source"/stages/example_plugin/* "$work/outline"
  cd "$work/outline"
  cmake -B build -DCMAKE_BUILD_TYPE="$type"
  cmake --build build
  cp build/liboutline.so "$work/refused/libduplicate.so"
}

# The text says Release; the plugin has to match this build.
run_document() {
  cd "$work/$2"
  bash "$source/tests/plugin/extract.sh" "$source/docs/$1"
  sed -i "s/CMAKE_BUILD_TYPE=Release/CMAKE_BUILD_TYPE=$type/" commands.sh
  bash -ex commands.sh
}

build_refused() {
  cd "$work/refused"
  local make=("$cxx" -std=c++20 -shared -fPIC -I "$work/crevice/include/crevice" "$source/tests/plugin/RefusedPlugin.cpp")
  if [ "$type" != Debug ]; then make+=(-DNDEBUG); fi
  "${make[@]}" -DABI=crevice::kPluginAbi+1 -o libabi.so
  "${make[@]}" '-DCOMPILER="tinycc 0.9"' -o libcompiler.so
  "${make[@]}" '-DBUILD_TYPE="sanitized"' -o libtype.so
  "${make[@]}" -DNO_PLUGIN -o libnothing.so
  echo "no library" >libtext.so
}

run() {  # NAME COMMAND…: in the background, with a log of its own
  local name=$1
  shift
  ("$@") >"$work/$name.log" 2>&1 &
  jobs_of[$!]=$name
}
declare -A jobs_of
run outline build_outline
run refused build_refused
run library run_document library.md library
run stages run_document writing-a-stage.md stages
run compute run_document stages/ComputeStage.md compute
failed=0
for job in "${!jobs_of[@]}"; do
  if ! wait "$job"; then
    echo "--- ${jobs_of[$job]} failed:"
    cat "$work/${jobs_of[$job]}.log"
    failed=1
  fi
done
exit $failed
