# Sourced by run.sh, test.sh and CI: packages and builds, both quick when there is nothing to do.

# Compiler results are shared between checkouts: paths count from the top of each.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=true

packages=(
  g++ cmake ninja-build pkg-config ccache mold
  libvulkan-dev mesa-vulkan-drivers vulkan-validationlayers
  glslang-dev glslang-tools spirv-tools libspirv-cross-c-shared-dev
  libglm-dev libtinygltf-dev nlohmann-json3-dev libyaml-cpp-dev
  libcli11-dev libfmt-dev libspdlog-dev
  libspng-dev libturbojpeg0-dev libwebp-dev libopenexr-dev libstb-dev zlib1g-dev libmeshoptimizer-dev
  libembree-dev libjs-chart.js
  libgtest-dev libgmock-dev libbenchmark-dev
)
# ISA-L has no package on every architecture: PNG files are then written by libspng.
if [ "$(dpkg --print-architecture 2>/dev/null)" = amd64 ]; then packages+=(libisal-dev); fi

install_packages() {
  local missing=() package
  for package in "${packages[@]}"; do
    dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
  done
  if [ ${#missing[@]} -eq 0 ]; then return; fi
  echo "Installing: ${missing[*]}"
  local sudo=""
  if [ "$(id -u)" -ne 0 ]; then sudo=sudo; fi
  $sudo apt-get update -qq
  DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

configure() {
  [ -f build/build.ninja ] || cmake --preset release >/dev/null
}

build_program() {
  configure
  cmake --build build --target crevice_program
}

build_all() {
  configure
  cmake --build build
}
