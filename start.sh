#!/bin/sh
# From a bare Debian 12 to a picture: installs packages, builds the release, renders the gallery scene.
set -eu
cd "$(dirname "$0")"
sh cmake/install-packages.sh cmake/packages.txt
cmake --preset release >build-release.log 2>&1 || { cat build-release.log; exit 1; }
rm -f build-release.log
cmake --build --preset release
mkdir -p build/pictures
build/release/bin/pellucid render gallery -o build/pictures/gallery.exr -o build/pictures/gallery.png
echo "Look at build/pictures/gallery.png; next: build/release/bin/pellucid --help"
