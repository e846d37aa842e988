#!/usr/bin/env bash
# Installs what is missing, builds, and renders the default scene; with arguments, passes them on to the program.
set -euo pipefail
cd "$(dirname "$0")"
source .ci/setup.sh
install_packages
build_program
if [ $# -gt 0 ]; then exec build/crevice "$@"; fi
mkdir -p out
build/crevice render default -p ssao-deferred -o out/default.png
echo "The picture is at $PWD/out/default.png"
