#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests. The last line counts them: N passed, N failed.
#   --quick  the release build alone
#   --all    also the GPL parts and the command under sanitizers, the core under ThreadSanitizer, the core alone as a package,
#            and clang-tidy
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

extent=usual
case "${1-}" in
  '') ;;
  --quick | --all) extent=${1#--} ;;
  *)
    echo "usage: tools/test.sh [--quick | --all]" >&2
    exit 2
    ;;
esac

case $extent in
  quick) tools/install_dependencies.sh ;;
  usual) tools/install_dependencies.sh --tests ;;
  all) tools/install_dependencies.sh --all ;;
esac
# shellcheck source=tools/build_settings.sh
source tools/build_settings.sh
# Real meshes and scans of others; their tests skip where the package cannot be had.
if samples=$(tools/fetch_samples.sh); then
  configure_arguments+=("-DTUFTED_CGAL_DATA_DIR=$samples")
fi
# Real scans and meshes that may lie beside the project.
if [[ -d ../shared/data ]]; then
  configure_arguments+=("-DTUFTED_DATA_DIR=$(realpath ../shared/data)")
fi
export CTEST_PARALLEL_LEVEL=${CTEST_PARALLEL_LEVEL:-$(nproc)}

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
passed=0 failed=0 skipped=0

# step NAME COMMAND...: runs a step; its output is shown when it fails, which counts as a failed test.
step() {
  local name=$1 seconds=$SECONDS
  shift
  if "$@" >"$scratch/log" 2>&1; then
    echo "$name: done ($((SECONDS - seconds)) s)"
  else
    tail -n 200 "$scratch/log"
    echo "$name: FAILED"
    failed=$((failed + 1))
    return 1
  fi
}

# build PRESET: builds it. Warnings fail. To be called by step, whose log it reads.
build() {
  local warnings
  cmake --build "build/$1" || return
  warnings=$(grep -E 'warning: |warning #' "$scratch/log" || true)
  [[ -z $warnings ]] && return
  echo "$warnings"
  rm -f "build/$1/.ninja_log"  # or the next run would not see them again
  return 1
}

# tests NAME BUILD ARGUMENTS...: runs the tests of a folder by ctest and adds them up. ctest counts a test that it cannot
# start as failed and one that skips itself as passed, so the latter are taken off. For ctest a suite of GoogleTest is one
# test; here each of its cases counts, unless it fails.
tests() {
  local name=$1 build=$2 seconds=$SECONDS summary bad good odd
  shift 2
  ctest "$@" >"$scratch/log" 2>&1 || true
  summary=$(grep -Eo '[0-9]+ tests? failed out of [0-9]+' "$scratch/log" | tail -n 1 || true)
  if [[ ! $summary =~ ^([0-9]+)\ tests?\ failed\ out\ of\ ([0-9]+)$ ]]; then
    cat "$scratch/log"
    echo "$name: FAILED, ctest has no summary"
    failed=$((failed + 1))
    return
  fi
  bad=${BASH_REMATCH[1]}
  odd=$(count '^ *[0-9]+/[0-9]+ Test .*\*\*\*Skipped' "$scratch/log")
  good=$((BASH_REMATCH[2] - bad - odd))
  local output=$build/Testing/Temporary/LastTest.log
  good=$((good - $(count '^\[  PASSED  \]' "$output") + $(count '^\[  FAILED  \] .* listed below:' "$output")))
  good=$((good + $(count '^\[       OK \]' "$output"))) odd=$((odd + $(count '^\[  SKIPPED \] .* ms\)$' "$output")))
  ((bad == 0)) || cat "$scratch/log"
  passed=$((passed + good)) failed=$((failed + bad)) skipped=$((skipped + odd))
  echo "$name: $good passed, $bad failed, $odd skipped ($((SECONDS - seconds)) s)"
}

# count PATTERN FILE: how many lines of a file match.
count() {
  grep -Ec "$1" "$2" || true
}

# preset NAME ARGUMENTS...: configures, builds and tests one of CMakePresets.json.
preset() {
  step "$1: configure" cmake --preset "$1" "${configure_arguments[@]}" "${@:2}" &&
    step "$1: build" build "$1" &&
    tests "$1: tests" "build/$1" --preset "$1"
}

# consumer NAME BUILD ARGUMENTS...: installs BUILD and builds a project of a user's against what is installed; in build/,
# because ccache finds files of another clone again only below the project's folder.
consumer() {
  local name=$1 build=$2 dir=$PWD/build/$1
  shift 2
  rm -rf "$dir"
  step "$name: install" cmake --install "$build" --prefix "$dir/prefix" &&
    step "$name: configure" cmake -S tests/consumer -B "$dir/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
      -DCMAKE_PREFIX_PATH="$dir/prefix" "$@" &&
    step "$name: build" cmake --build "$dir/build" &&
    tests "$name: tests" "$dir/build" --test-dir "$dir/build" --output-on-failure --no-tests=error
}

# formatted: whether all files are as Debian's clang-format 14 leaves them.
formatted() {
  find src include tools tests docs/examples \( -name '*.h' -o -name '*.hpp' -o -name '*.cpp' \) -print0 |
    xargs -0 clang-format-14 --dry-run -Werror
}

# A failed step is counted already and must not keep the rest from running.
if [[ $extent != quick ]]; then
  step "format" formatted || true
fi
if [[ $extent == quick ]]; then
  preset release || true
else
  preset release -DTUFTED_WITH_PETSC=ON || true  # which is off by default
fi
if [[ $extent != quick ]]; then
  step "reference of the headers" cmake --build build/release --target docs || true
  consumer installed build/release -DCONSUMER_IO=ON -DCONSUMER_PCL=ON -DCONSUMER_MPI=ON || true
  preset sanitized || true
fi
if [[ $extent == all ]]; then
  preset sanitized-gpl || true
  preset threads || true
  # Without tufted::io and tufted::pcl the package may not ask for PCL.
  step "core: configure" cmake --preset core "${configure_arguments[@]}" &&
    step "core: build" build core &&
    consumer installed-core build/core -DCMAKE_DISABLE_FIND_PACKAGE_PclParts=ON || true
  step "tidy: configure" cmake --preset tidy "${configure_arguments[@]}" && step "tidy: build" build tidy || true
fi

total="$passed passed, $failed failed"
((skipped == 0)) || total+=", $skipped skipped"
echo "$total"
((failed == 0))
