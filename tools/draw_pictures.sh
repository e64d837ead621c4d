#!/usr/bin/env bash
# Draws the pictures of README and docs by the command itself, from data of CGAL (tools/fetch_samples.sh) and datasets/:
#   tools/draw_pictures.sh [FOLDER]        FOLDER is docs/figures by default
# Needs build/release/tufted.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

figures=${1:-docs/figures}
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
bunny=$samples/meshes/bunny00.off
draw distance distance "$building" --source 0 --size 700x500
draw eigenvector spectrum "$bunny" --as cloud --count 8 --column 5 --up y --camera 20,12 --size 560x500
draw depth_image distance datasets/depth_camera.ply --source 8320 --component largest --size 700x500
draw logmap_bunny logmap "$bunny" --as cloud --source 200 --up y --camera 20,12 --size 560x500
draw parts segment "$bunny" --as cloud --count 12 --up y --camera 20,12 --size 560x500
draw boundary_kinds laplacian datasets/depth_camera.ply --color boundary --size 700x500
noisy=datasets/sphere_uniform_noise_1pct.ply
draw before filter "$noisy" --positions --count 600 --size 500x450
draw after filter "$noisy" --positions --count 60 --size 500x450
ls -l "$figures"/*.png
