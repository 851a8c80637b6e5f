#!/usr/bin/env bash
# Plans the problems of planners/sandros and draws four moments of each path: demo/sandros.png. The folder demo/sandros keeps the
# animated scenes (NAME.glb).
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh demo
CARGO_TERM_QUIET=true scripts/install.sh >/dev/null
puma=$(scripts/fetch_puma560.sh)
cmake -S planners -B build/planners -DCMAKE_PREFIX_PATH="$PWD/local" >/dev/null
cmake --build build/planners --target sandros >/dev/null
mkdir -p demo/sandros
rm -f demo/sandros/*
build/planners/sandros/sandros --puma "$puma" --out demo/sandros

tiles=()
# Renders the moments of a problem: name, camera position, focal point, title, moments.
render() {
  local moment
  for moment in $5; do
    xvfb-run -a -s "-screen 0 1024x768x24" f3d --quiet "demo/sandros/$1_$moment.glb" --output "demo/sandros/$1_$moment.png" \
      --resolution 400,300 --up +Z --bg-color 1,1,1 --camera-position "$2" --camera-focal-point "$3" \
      --camera-view-up 0,0,1 >/dev/null 2>&1
    [ -s "demo/sandros/$1_$moment.png" ] || { echo "$1_$moment.glb could not be rendered" >&2; exit 1; }
    tiles+=(-label "$4" "demo/sandros/$1_$moment.png")
  done
}
render puma560 2.95,-2.45,2.45 0.4,0.1,0.5 "Puma 560 in its workcell" "0 1 2 3"
render windows -2.4,-8.3,2.4 0,0,0 "L through windows" "0 1 2 3"
render two_arms 0.9,-1.9,1.9 0,0,0.15 "two arms change sides" "0 1 2 3"
render two_carts 0,-1.3,6.6 0,0.5,0 "two carts change places" "0 1 2 3"
render bug_trap_open 0.3,-2,4.8 0.3,-0.1,0 "bug trap, open" "0 2 3"
render bug_trap 0.3,-2,4.8 0.3,-0.1,0 "bug trap, closed: no path" "0"
montage -font /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf "${tiles[@]}" -tile 4x -geometry 400x300+4+4 -pointsize 16 \
  +dither -colors 96 demo/sandros.png
echo "picture: $PWD/demo/sandros.png"
