#!/usr/bin/env bash
# Makes src/view/fonts/labels.ttf, the letters of titles and legends: a part of DejaVu Sans. Needs the packages
# fonts-dejavu-core and fonttools.
set -euo pipefail
cd "$(dirname "$0")/.."
pyftsubset /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf --output-file=src/view/fonts/labels.ttf --no-hinting \
  --layout-features='' --name-IDs='0,1,2,13,14' \
  --unicodes=U+0020-007E,U+00A0-00FF,U+0391-03C9,U+2013,U+2026,U+2070-2079,U+207B,U+2212,U+2264,U+2265,U+FFFD
cp /usr/share/doc/fonts-dejavu-core/copyright src/view/fonts/LICENSE
