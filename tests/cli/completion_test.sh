#!/usr/bin/env bash
# Tests the completion for bash.   completion_test.sh SCRIPT COMMAND
set -uo pipefail
# shellcheck source=/dev/null
source "$1"
command=$2 failed=0

# expect WORDS... -- OFFERED...: checks what is offered for the last of the words, in any order.
expect() {
  local offered wanted
  COMP_WORDS=("$command")
  while [[ $1 != -- ]]; do
    COMP_WORDS+=("$1")
    shift
  done
  shift
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _tufted
  offered=$(printf '%s\n' "${COMPREPLY[@]}" | sort | tr '\n' ' ')
  wanted=$(printf '%s\n' "$@" | sort | tr '\n' ' ')
  if [[ $offered != "$wanted" ]]; then
    echo "${COMP_WORDS[*]}: offers $offered, must offer $wanted"
    failed=1
  fi
}

expect lap -- laplacian
expect h -- help hks
expect sig -- signed-distance
expect help spec -- spectrum
expect --v -- --version
expect laplacian --pres -- --preset
expect laplacian --o -- --out --order
expect laplacian --preset '' -- clean lidar scan
expect spectrum file.ply --structure im -- image
expect laplacian --out '' -- ''
expect laplacian sca -- ''  # files, which bash offers by itself
expect nonsense --o -- ''
exit $failed
