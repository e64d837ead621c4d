#!/usr/bin/env bash
# Builds the page without a scene again and compares it with the one that is checked in: compare_viewer.sh OUTPUT
set -euo pipefail
root=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
"$root/tools/build_viewer.sh" "$1"
cmp "$1" "$root/src/view/page/viewer.html"
if grep -q '"resolved"' "$root/src/view/page/package-lock.json"; then
  echo "package-lock.json names the registry that it was made with" >&2
  exit 1
fi
