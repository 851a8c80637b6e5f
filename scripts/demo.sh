#!/usr/bin/env bash
# Builds and installs libcstk, runs the report's slider on the arm of its Appendix A and on a Puma 560, and leaves a
# picture: demo/slider.png, frames 10, 20, 30 and 40 of both. The planar arm of Figure 16 slides in demo/planar_slider.png;
# demo/motion.png is a sweep that samples call free and that meets a thin plate; demo/shortcut.png a Puma 560's shortcut that is not free, and two that
# are; demo/contact_drop.png and demo/newton_cradle.png are simulations of contacts, demo/peg_in_hole.png a fine motion,
# demo/teleoperation.png how long the ticks of a motion filter take;
# demo/workcell.png shows two arms that share a workcell; demo/planner.png paths that RRT-Connect found.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh demo
scripts/install.sh

cmake -S examples-c -B build/examples -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$PWD/local" >/dev/null
cmake --build build/examples
mkdir -p demo
rm -f demo/*.glb demo/*.png demo/*.csv
echo
build/examples/puma_slider appendix models demo
echo
meshes=$(scripts/fetch_puma560.sh)
build/examples/puma_slider puma560 "$meshes" demo

# Renders one frame: name, camera position, focal point.
render() {
  xvfb-run -a -s "-screen 0 1024x768x24" f3d --quiet "demo/$1.glb" --output "demo/$1.png" \
    --resolution 640,480 --up +Z --bg-color 1,1,1 --camera-position "$2" --camera-focal-point "$3" \
    --camera-view-up 0,0,1 >/dev/null 2>&1
  [ -s "demo/$1.png" ] || { echo "demo/$1.glb could not be rendered" >&2; exit 1; }
}
font=/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf
tiles=()
for frame in 10 20 30 40; do
  render "appendix_$frame" 22,-10,17 6.2,4.8,0.2
  tiles+=(-label "Appendix A, step $frame" "demo/appendix_$frame.png")
done
for frame in 10 20 30 40; do
  render "puma560_$frame" 3.0,-1.9,2.0 0.25,0.1,0.65
  tiles+=(-label "Puma 560, step $frame" "demo/puma560_$frame.png")
done
montage -font "$font" "${tiles[@]}" -tile 4x2 -geometry 640x480+4+4 -pointsize 20 demo/slider.png
echo
build/examples/planar_slider demo
rsvg-convert --width 1280 demo/planar_slider.svg --output demo/planar_slider.png
echo
build/examples/motion demo/motion.svg
rsvg-convert --width 1240 demo/motion.svg --output demo/motion.png
echo
for example in contact_drop newton_cradle peg_in_hole; do
  build/examples/$example "demo/$example.svg"
  rsvg-convert --width 1200 "demo/$example.svg" --output "demo/$example.png"
  echo
done
build/examples/teleoperation 60 demo/teleoperation.svg
rsvg-convert --width 1100 demo/teleoperation.svg --output demo/teleoperation.png
echo
build/examples/puma_shortcut "$meshes" demo
for frame in contact free; do
  render "shortcut_$frame" 3.0,-1.9,2.0 0.25,0.1,0.65
done
tiles=(-label "straight on: the first contact, and the way there" demo/shortcut_contact.png
  -label "two shortcuts, proved free" demo/shortcut_free.png)
montage -font "$font" "${tiles[@]}" -tile 2x1 -geometry 640x480+4+4 -pointsize 20 demo/shortcut.png
echo
build/examples/puma_maps "$meshes" demo
render puma_map_3 10.5,-8.5,6.5 0,0,-0.2
convert demo/puma_map_2.png -resize 480x480 -bordercolor gray60 -border 1 demo/puma_map_2.png
tiles=(-label "over joints 1 and 2: inside is red" demo/puma_map_2.png
  -label "over joints 1, 2 and 3: the boundary of what is inside" demo/puma_map_3.png)
montage -font "$font" "${tiles[@]}" -tile 2x1 -geometry 640x482+4+4 -pointsize 20 demo/maps.png
echo
build/examples/workcell demo
for frame in free wrists; do
  render "workcell_$frame" 0.45,-2.5,1.3 0,0,0.32
done
tiles=(-label "both at home: OUTSIDE" demo/workcell_free.png
  -label "wrists meeting: INSIDE, arm against arm" demo/workcell_wrists.png)
montage -font "$font" "${tiles[@]}" -tile 2x1 -geometry 640x480+4+4 -pointsize 20 demo/workcell.png
echo
cmake -S planners -B build/planners -DCMAKE_PREFIX_PATH="$PWD/local" >/dev/null
cmake --build build/planners --target rrt_connect_program
panda=$(scripts/fetch_motion_bench_maker.sh)
build/planners/rrt_connect --puma "$meshes" --panda "$panda" --problems 1 --pictures demo
render windows -0.6,-4.4,1.6 0.5,0,0
render "Puma 560 workcell" 3.0,-3.0,2.4 0.1,-0.1,0.7
render cage -1.5,-1.9,2.0 0.4,0,0.4
render bookshelf_thin -1.6,-2.0,1.9 0.3,0,0.5
tiles=(-label "a rigid L through two windows" demo/windows.png
  -label "Puma 560: from the table to below a drum" "demo/Puma 560 workcell.png"
  -label "MotionBenchMaker: cage" demo/cage.png -label "MotionBenchMaker: bookshelf" demo/bookshelf_thin.png)
montage -font "$font" "${tiles[@]}" -tile 4x1 -geometry 640x480+4+4 -pointsize 20 demo/planner.png
echo
echo "picture: $PWD/demo/slider.png"
echo "picture: $PWD/demo/planar_slider.png"
echo "picture: $PWD/demo/motion.png"
for example in contact_drop newton_cradle peg_in_hole teleoperation; do
  echo "picture: $PWD/demo/$example.png"
done
echo "picture: $PWD/demo/shortcut.png"
echo "picture: $PWD/demo/workcell.png"
echo "picture: $PWD/demo/maps.png"
echo "picture: $PWD/demo/planner.png"
