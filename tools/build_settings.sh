# shellcheck shell=bash
# To be sourced by demo.sh and test.sh, so that both configure build/release alike: `configure_arguments`.

# A compiler launcher in the environment wins; CMake reads it when it configures for the first time.
export CMAKE_C_COMPILER_LAUNCHER=${CMAKE_C_COMPILER_LAUNCHER-ccache}
export CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER-ccache}

# A second clone finds what the first has compiled: paths count from the project's folder on.
CCACHE_BASEDIR=${CCACHE_BASEDIR-$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)}
export CCACHE_BASEDIR CCACHE_NOHASHDIR=${CCACHE_NOHASHDIR-1}

# Files that include a precompiled header are cached only so.
export CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS-pch_defines,time_macros}
# Otherwise a precompiled header is found from before a comment changed, and GCC does not know the changed file again.
export CCACHE_COMMENTS=${CCACHE_COMMENTS-1}

configure_arguments=()
# GCC knows mold from 12.1 on.
if command -v mold >/dev/null && echo 'int main() {}' | "${CXX:-c++}" -fuse-ld=mold -x c++ -o /dev/null - 2>/dev/null; then
  for kind in EXE SHARED MODULE; do
    configure_arguments+=("-DCMAKE_${kind}_LINKER_FLAGS=-fuse-ld=mold")
  done
fi
