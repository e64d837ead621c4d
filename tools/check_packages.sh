#!/usr/bin/env bash
# Makes the files of a release from the last commit, in build/packages, and tries them: the source tarball, from it
# Debian's packages and the wheel, installed into a Debian that has nothing else. Needs root and debootstrap; run once
# before a release. Takes the mirror of packages as its argument, otherwise debootstrap's own.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
((EUID == 0)) || { echo "check_packages: needs root for debootstrap" >&2; exit 1; }
# shellcheck source=/dev/null
source /etc/os-release
version=$(sed -n 's/#define TUFTED_VERSION "\(.*\)"/\1/p' include/tufted/version.h)
out=$PWD/build/packages
root=$out/root source=$out/tufted-$version

mkdir -p "$out"
rm -rf "$out"/*.deb "$out"/*.whl "$out"/*.tar.gz "$source" "$root"
git archive --prefix="tufted-$version/" --output="$out/tufted-$version.tar.gz" HEAD
tar -xzf "$out/tufted-$version.tar.gz" -C "$out"
cd "$source"
# shellcheck source=tools/build_settings.sh
source tools/build_settings.sh
echo "== packages"
cmake --preset packages "${configure_arguments[@]}" >/dev/null
cmake --build build/packages
(cd build/packages && cpack >/dev/null)
mv build/packages/*.deb "$out"
echo "== wheel"
/usr/bin/python3 -m pip wheel -q --no-build-isolation --no-deps --wheel-dir "$out" .
ls -l "$out"/*.deb "$out"/*.whl "$out"/*.tar.gz

debootstrap --variant=minbase "$VERSION_CODENAME" "$root" "$@" >"$out/debootstrap.log"
mkdir "$root/tufted"
echo 'Dpkg::Use-Pty "false";' >"$root/etc/apt/apt.conf.d/no-terminal"
cp -r "$out"/*.deb "$out"/*.whl include tests docs README.md datasets "$root/tufted"

# clean COMMAND: runs it in the new Debian, which has no ccache.
clean() {
  echo "== $1"
  env -u CMAKE_C_COMPILER_LAUNCHER -u CMAKE_CXX_COMPILER_LAUNCHER chroot "$root" bash -eo pipefail -c "cd /tufted; export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8; $1"
}
clean 'apt-get update -qq
       apt-get install -y -qq --no-install-recommends ./libtufted0*.deb ./tufted_*.deb ./python3-tufted_*.deb >/dev/null
       dpkg-query -W -f "\${Package} \${Version} \${Installed-Size} KiB\n" "*tufted*"'
clean 'tufted --version | sed -n 1p; tufted laplacian datasets/sphere_uniform.ply --out /tmp/sphere | sed -n 1,3p'
clean 'ldd /usr/bin/tufted | grep -c "=> /"; man -w tufted 2>/dev/null || ls /usr/share/man/man1/tufted.1*'
clean 'cd /; python3 -c "import tufted; print(tufted.__version__, tufted.__file__)"'
# The core is used with Eigen's headers and no others.
clean 'apt-get install -y -qq --no-install-recommends ./libtufted-dev_*.deb g++ cmake make pkg-config >/dev/null
       for header in CGAL flann pcl-1.13/pcl suitesparse tbb lz4.h; do test ! -e /usr/include/$header; done
       cmake -S tests/consumer -B /tmp/consumer -DCONSUMER_IO=ON >/dev/null
       cmake --build /tmp/consumer >/dev/null; ctest --test-dir /tmp/consumer | tail -n 4
       g++ -std=c++17 tests/consumer/main.cpp -o /tmp/by_pkg_config $(pkg-config --cflags --libs tufted)
       /tmp/by_pkg_config && echo "built by pkg-config"'
# The wheel has the libraries of the project inside; those of others were installed above.
clean 'dpkg --purge python3-tufted tufted libtufted-dev libtufted'"${version%.*}"' >/dev/null
       apt-get install -y -qq --no-install-recommends python3-venv >/dev/null
       python3 -m venv --system-site-packages /tmp/venv
       /tmp/venv/bin/pip install -q --no-index --no-deps ./*.whl
       cd /; /tmp/venv/bin/python -c "import tufted; print(tufted.__version__, tufted.__file__)"'
echo "== all of it works"
