#!/usr/bin/env bash
# Installs what is missing, builds the command and runs it on a scan of a building from CGAL's examples.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/install_dependencies.sh
# shellcheck source=tools/build_settings.sh
source tools/build_settings.sh

# Prints the path of the scan, from the Debian package libcgal-demo; fails where it cannot be had. The package is
# unpacked, not installed: minimised images would leave out usr/share/doc, where it keeps its data.
fetch_scan() {
  local cache=${XDG_CACHE_HOME:-${HOME:-/tmp}/.cache}/tufted
  local scan=$cache/building.ply
  if [[ ! -s $scan ]]; then
    mkdir -p "$cache" || return 1
    local unpacked
    unpacked=$(mktemp -d "$cache/unpack.XXXXXX") || return 1
    if extract_scan "$unpacked"; then
      mv "$unpacked/building.ply" "$scan"
    fi
    rm -rf "$unpacked"
  fi
  [[ -s $scan ]] && echo "$scan"
}

extract_scan() (
  cd "$1" || return 1
  download_package || return 1
  dpkg-deb -x libcgal-demo_*.deb . || return 1
  local archive=usr/share/doc/libcgal-dev/data.tar.gz
  [[ -f $archive ]] || archive=$(find . -name data.tar.gz -print -quit)
  tar -xzOf "$archive" data/points_3/building.ply >building.ply
)

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

echo "Building the command"
cmake --preset release "${configure_arguments[@]}" >/dev/null  # errors and warnings go to stderr
cmake --build build/release --target tufted_command

if ! input=$(fetch_scan); then
  input=datasets/ellipsoid_uniform.ply
  echo "The package libcgal-demo cannot be had here; using our own sample $input instead of its scan of a building."
fi

echo
build/release/tufted laplacian "$input" --out out/demo
cat <<END

The results are in $PWD/out/demo:
  L.npz               the Laplacian, a sparse matrix: scipy.sparse.load_npz("out/demo/L.npz")
  M.npy               the area of each point: numpy.load("out/demo/M.npy")
  status.npy          why a point does not take part: 0 active, 1 not finite, 2 coincident, 3 isolated
  representative.npy  the point that stands for a coincident one
  boundary.npy        1 where the surface ends
  points.ply          the points with all of this as fields, for CloudCompare, MeshLab or pcl_viewer
  report.json         what happened, with the options, the sign and the scale
END
