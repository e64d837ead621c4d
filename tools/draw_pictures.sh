#!/usr/bin/env bash
# Draws the pictures of README and docs by the command itself, from data of CGAL (tools/fetch_samples.sh) and PCL:
#   tools/draw_pictures.sh CLOUDS [FOLDER]
# CLOUDS holds clouds of PCL's test data: cturtle.pcd and mosd_learn0.pcd. FOLDER is docs/figures by default.
# Needs build/release/tufted.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

clouds=${1:?usage: draw_pictures.sh CLOUDS [FOLDER]}
figures=${2:-docs/figures}
samples=$(tools/fetch_samples.sh) || {
  echo "draw_pictures: the package libcgal-demo cannot be had here" >&2
  exit 1
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tufted=build/release/tufted

# draw NAME SUBCOMMAND...: runs a subcommand and keeps its picture alone.
draw() {
  local name=$1
  shift
  echo "$name"
  "$tufted" "$@" --out "$work/$name" --format none --png "$figures/$name.png" --quiet
}

building=$samples/points_3/building.ply
on_bunny=("$samples/meshes/bunny00.off" --as cloud --up y --camera 20,12 --size 560x500)
table=$clouds/mosd_learn0.pcd
draw distance distance "$building" --source 3446 --camera -128,24 --size 760x480
draw eigenvector spectrum "${on_bunny[@]}" --count 8 --column 5
draw parts segment "${on_bunny[@]}" --count 12
draw logmap logmap "$clouds/cturtle.pcd" --near 0,0,2 --size 760x500
draw boundary_kinds laplacian "$table" --color boundary --size 640x420
ls -l "$figures"/*.png
