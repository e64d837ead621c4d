#!/usr/bin/env bash
# Installs what is missing, builds the command and runs it on a scan of a building from CGAL's examples.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/install_dependencies.sh --command
# shellcheck source=tools/build_settings.sh
source tools/build_settings.sh

echo "Building the command"
cmake --preset command "${configure_arguments[@]}" >/dev/null  # errors and warnings go to stderr
cmake --build build/release --target tufted_command

if samples=$(tools/fetch_samples.sh); then
  input=$samples/points_3/building.ply
else
  input=datasets/ellipsoid_uniform.ply
  echo "The package libcgal-demo cannot be had here; using our own sample $input instead of its scan of a building."
fi

echo
build/release/tufted laplacian "$input" --out out/demo --png out/demo/area.png
echo
build/release/tufted spectrum "$input" --count 8 --out out/demo/spectrum --png out/demo/eigenvector.png
echo
build/release/tufted distance "$input" --source 0 --out out/demo/distance --png out/demo/distance.png \
  --view out/demo/view.html
cat <<END

The results are in $PWD/out/demo:
  L.npz               the Laplacian, a sparse matrix: scipy.sparse.load_npz("out/demo/L.npz")
  M.npy               the area of each point: numpy.load("out/demo/M.npy")
  status.npy          why a point does not take part: 0 active, 1 not finite, 2 coincident, 3 isolated
  representative.npy  the point that stands for a coincident one
  boundary.npy        0, or why the surface ends: 1 rim, 2 jump, 3 missing triangles
  measured_positions.npy
                      where lengths are measured: noisy points are put back onto the surface
  points.ply          the points with all of this as fields, for CloudCompare, MeshLab or pcl_viewer
  report.json         what happened, with the options, the sign and the scale
Please open:
  view.html           distances along the surface, in a browser: turn, zoom, pick points
  distance.png        the same as a picture
  eigenvector.png     the first eigenvector; others by \`tufted view out/demo/spectrum --png FILE --column K\`
  area.png            the area of each point, the diagonal of M
END
