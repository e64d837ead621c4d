#!/usr/bin/env bash
# Draws the pictures of README and docs by the command itself, from data of CGAL (tools/fetch_samples.sh) and PCL:
#   tools/draw_pictures.sh CLOUDS [FOLDER]
# CLOUDS holds clouds of PCL's test data: cturtle.pcd, mosd_learn0.pcd and office1.pcd. FOLDER is docs/figures by default.
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
bunny=$samples/meshes/bunny00.off
view=(--up y --camera 20,12 --size 560x500)
on_bunny=("$bunny" --as cloud "${view[@]}")
table=$clouds/mosd_learn0.pcd
draw distance distance "$building" --source 3446 --camera -128,24 --size 760x480
draw eigenvector spectrum "${on_bunny[@]}" --count 8 --column 5
draw parts segment "${on_bunny[@]}" --count 12
draw logmap logmap "$clouds/cturtle.pcd" --near 0,0,2 --size 760x500
draw trace trace "$bunny" "${view[@]}" --near -0.3,0.2,0.3 --direction 1,-0.6,0 --length 3.5 --color none
draw map parameterize "$samples/meshes/nefertiti.off" --size 760x480
draw boundary_kinds laplacian "$table" --color boundary --size 640x420
# The triangles of a depth image, by its pixels and by the nearest points in space.
for structure in image none; do
  "$tufted" laplacian "$clouds/office1.pcd" --structure $structure --out "$work/$structure" --format triangles --quiet
  "$tufted" view "$work/$structure/triangles.ply" --png "$figures/office_$structure.png" --color none --up -y \
    --size 560x430 --quiet
done
# The mesh with normal noise, a third of its spacing, before and after.
awk 'function normal() { return sqrt(-2 * log(1 - rand())) * cos(6.283185307 * rand()) }
     BEGIN { srand(101); sigma = 0.002 }
     NR == 2 { points = $1 }
     NR > 2 && NF >= 3 && moved < points {
       ++moved
       printf "%.6f %.6f %.6f\n", $1 + sigma * normal(), $2 + sigma * normal(), $3 + sigma * normal()
       next
     }
     { print }' "$bunny" >"$work/noisy.off"
"$tufted" view "$work/noisy.off" --png "$figures/noisy.png" "${view[@]}" --color none --quiet
draw filtered filter "$work/noisy.off" --positions --count 1000 "${view[@]}" --color none
ls -l "$figures"/*.png
