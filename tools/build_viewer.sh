#!/usr/bin/env bash
# Makes src/view/page/viewer.html, the page without a scene, from the sources beside it and three.js, which npm gives.
#   tools/build_viewer.sh [OUTPUT]
# Exit code 77: npm, or what it fetches, cannot be had.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../src/view/page"
output=$(realpath -m "${1-viewer.html}")

skip() {
  echo "build_viewer: $*" >&2
  exit 77
}
command -v npm >/dev/null || skip "npm is missing (Debian's package npm)"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cp -- *.js *.mjs *.css page.html package.json package-lock.json .npmrc "$scratch"
cd "$scratch"
npm ci >npm.log 2>&1 || { tail -n 5 npm.log >&2; skip "npm cannot fetch three.js and esbuild"; }
node build.mjs "$output"
