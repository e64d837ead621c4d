#!/usr/bin/env bash
# Prints the folder of CGAL's sample data (meshes/, points_3/), taken from the Debian package libcgal-demo (universe on
# Ubuntu) into the user's cache; fails where the package cannot be had. The package is unpacked, not installed:
# minimised images would leave out usr/share/doc, where it keeps its data.
set -euo pipefail

cache=${XDG_CACHE_HOME:-${HOME:-/tmp}/.cache}/tufted
samples=$cache/data

# The lists of packages may be missing or too old; renewing them takes root.
download_package() {
  local download=(apt-get download -qq libcgal-demo)
  ((EUID != 0)) || download+=(-o APT::Sandbox::User=root)
  "${download[@]}" 2>/dev/null && return
  if ((EUID == 0)); then
    apt-get update -qq >&2
  elif command -v sudo >/dev/null; then
    sudo apt-get update -qq >&2
  fi
  "${download[@]}"
}

if [[ ! -d $samples ]]; then
  mkdir -p "$cache"
  unpacked=$(mktemp -d "$cache/unpack.XXXXXX")
  trap 'rm -rf "$unpacked"' EXIT
  cd "$unpacked"
  download_package
  dpkg-deb -x libcgal-demo_*.deb .
  archive=usr/share/doc/libcgal-dev/data.tar.gz
  [[ -f $archive ]] || archive=$(find . -name data.tar.gz -print -quit)
  tar -xzf "$archive" data/meshes data/points_3
  mv data "$samples"
fi
echo "$samples"
