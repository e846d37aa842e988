#!/usr/bin/env bash
# The same set-up as run.sh, then every test; ctest's own closing line comes last.
set -euo pipefail
cd "$(dirname "$0")"
source .ci/setup.sh
packages+=(chromium)  # opens the page of `crevice bench-ao`
install_packages
build_all
exec ctest --test-dir build --output-on-failure -LE long -j "$(nproc)" "$@"
