#!/usr/bin/env bash
# Draws the report's Figures 6 to 9 for our bodies: levels of sphere and hull hierarchies, in one picture,
# demo/hierarchies.png.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh demo
mkdir -p demo/hierarchies
rm -f demo/hierarchies/*
cargo run --quiet --release --locked --example hierarchy_figures -- demo/hierarchies >demo/hierarchies/views.txt
tiles=()
while read -r name camera focus title; do
  xvfb-run -a -s "-screen 0 1024x768x24" f3d --quiet "demo/hierarchies/$name.glb" \
    --output "demo/hierarchies/$name.png" --resolution 640,480 --up +Z --bg-color 1,1,1 \
    --camera-position "$camera" --camera-focal-point "$focus" --camera-view-up 0,0,1 >/dev/null 2>&1
  [ -s "demo/hierarchies/$name.png" ] || { echo "$name.glb could not be rendered" >&2; exit 1; }
  echo "$name: $title"
  tiles+=(-label "$title" "demo/hierarchies/$name.png")
done <demo/hierarchies/views.txt
montage -font /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf "${tiles[@]}" -tile 5x -geometry 480x360+4+4 \
  -pointsize 20 demo/hierarchies.png
echo "picture: $PWD/demo/hierarchies.png"
