#!/bin/sh
# Installs the Debian packages listed in the given files unless all are there; needs root or sudo then.
set -eu
wanted=$(cat "$@" | grep -v '^#')
missing=""
for package in $wanted; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' ||
    missing="$missing $package"
done
[ -n "$missing" ] || exit 0
echo "installing:$missing"
as_root=""
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null || { echo "install these as root, then start again:$missing" >&2; exit 1; }
  as_root="sudo"
fi
$as_root apt-get -qq update
# shellcheck disable=SC2086  # one word per package
$as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends $missing >/dev/null
