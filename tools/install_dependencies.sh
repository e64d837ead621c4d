#!/usr/bin/env bash
# Installs what tufted, its tests and its benchmark need, on Debian 12 and Ubuntu 22.04 and 24.04. Does nothing, and
# asks for no rights, where all of it is there already.
#
# The names are the same on all three. What differs: Ubuntu keeps most of them in `universe` (on by default); 22.04 has
# GCC 11, CMake 3.22, PCL 1.12 and CGAL 5.4, which suffice.
set -euo pipefail

packages=(
  g++ cmake ninja-build ccache pkg-config
  libeigen3-dev libflann-dev liblz4-dev libcgal-dev                 # the core
  libpcl-dev libzip-dev libmatio-dev nlohmann-json3-dev libcli11-dev  # files and the command
  libgtest-dev libspectra-dev libbenchmark-dev python3 python3-scipy  # tests and benchmark
)

fail() {
  echo "install_dependencies: $*" >&2
  exit 1
}

command -v dpkg-query >/dev/null || fail "knows Debian and Ubuntu only; please install: ${packages[*]}"

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
((${#missing[@]} > 0)) || exit 0

as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null || fail "needs root or sudo to install: ${missing[*]}"
  as_root=(sudo)
fi
echo "Installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq || fail "apt-get update failed"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" ||
  fail "apt-get could not install: ${missing[*]}"
