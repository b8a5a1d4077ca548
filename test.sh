#!/bin/sh
# Installs packages, builds everything with warnings as errors, and runs all tests but the slow ones.
# Arguments go to ctest, e.g. ./test.sh -L unit. As many tests at a time as there are processors: compilers of
# kernels and scripts use one each.
set -eu
cd "$(dirname "$0")"
sh cmake/install-packages.sh cmake/packages.txt cmake/packages-test.txt
cmake --preset ci
cmake --build --preset ci
# Kernels compiled by tests are kept with the build, not in the user's cache.
export POCL_CACHE_DIR="$PWD/build/ci/pocl-cache"
mkdir -p "$POCL_CACHE_DIR"
ctest --preset ci --parallel "$(nproc)" "$@"
