#!/usr/bin/env bash
# Installs what tufted needs, on Debian 12 and Ubuntu 22.04 and 24.04. Does nothing, and asks for no rights, where all of
# it is there already. Without options it installs what all parts but --mpi and the benchmark need, otherwise what these need:
#   --command  the command `tufted` and the library alone
#   --pcl      the classes for PCL as well; PCL brings Qt and VTK
#   --python   the package for Python as well
#   --mpi      tufted::mpi and the program tufted-mpi as well: PETSc, SLEPc and Open MPI
#   --tests    everything, and what the checks of tools/test.sh need: clang with its sanitizers, clang-format, doxygen,
#              pytest, and a browser where it is a package (on Ubuntu it is none, and the tests of pages in a browser skip
#              themselves)
#   --all      that, and clang-tidy
#
# The names are the same on all three. What differs: Ubuntu keeps most of them in `universe` (on by default); 22.04 has
# GCC 11, CMake 3.22, PCL 1.12 and CGAL 5.4, which suffice.
set -euo pipefail

command_packages=(
  g++ cmake ninja-build ccache pkg-config
  libeigen3-dev libflann-dev liblz4-dev libcgal-dev libtbb-dev      # the core
  libsuitesparse-dev libopenblas-dev  # CHOLMOD, and the BLAS that it finds through Debian's alternatives: the reference
                                      # BLAS, which it takes otherwise, makes a factorisation 2 to 4 times slower
  nlohmann-json3-dev libcli11-dev  # files and the command
  zlib1g-dev libpng-dev libfreetype-dev  # archives, pages and pictures
)
pcl_packages=(libpcl-dev)
python_packages=(python3 python3-dev pybind11-dev python3-numpy python3-scipy python3-pip python3-venv)
mpi_packages=(libslepc-real-dev openmpi-bin)
other_packages=(
  help2man  # the manual pages of the command
  libgtest-dev libgmock-dev libzip-dev libspectra-dev libbenchmark-dev  # tests and benchmark
)
check_packages=(clang clang-format-14 doxygen python3-pytest)

packages=("${command_packages[@]}")
sanitizers=false
(($# > 0)) || packages+=("${pcl_packages[@]}" "${python_packages[@]}" "${other_packages[@]}")
for part in "$@"; do
  case $part in
    --command) ;;
    --pcl) packages+=("${pcl_packages[@]}") ;;
    --python) packages+=("${python_packages[@]}") ;;
    --mpi) packages+=("${mpi_packages[@]}") ;;
    --tests | --all)
      sanitizers=true
      packages+=("${pcl_packages[@]}" "${python_packages[@]}" "${mpi_packages[@]}" "${other_packages[@]}"
                 "${check_packages[@]}")
      [[ $part == --tests ]] || packages+=(clang-tidy)
      ;;
    *)
      echo "usage: tools/install_dependencies.sh [--command] [--pcl] [--python] [--mpi] [--tests | --all]" >&2
      exit 2
      ;;
  esac
done

fail() {
  echo "install_dependencies: $*" >&2
  exit 1
}

# install PACKAGE...: installs those that are missing.
install() {
  local missing=() as_root=() package status
  for package in "$@"; do
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
    [[ $status == installed ]] || missing+=("$package")
  done
  ((${#missing[@]} > 0)) || return 0
  if ((EUID != 0)); then
    command -v sudo >/dev/null || fail "needs root or sudo to install: ${missing[*]}"
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}"
  "${as_root[@]}" apt-get update -qq || fail "apt-get update failed"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" ||
    fail "apt-get could not install: ${missing[*]}"
}

# can_sanitize: whether clang has the runtime of its sanitizers, which some releases keep in a package of its own.
can_sanitize() {
  echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }' |
    clang++ -fsanitize=fuzzer,address,undefined -x c++ -o /dev/null - 2>/dev/null
}

command -v dpkg-query >/dev/null || fail "knows Debian and Ubuntu only; please install: ${packages[*]}"
install "${packages[@]}"
if $sanitizers && ! can_sanitize; then
  install libclang-rt-dev
fi
if $sanitizers && apt-cache show chromium-driver >/dev/null 2>&1; then
  install chromium chromium-driver python3-selenium
fi
