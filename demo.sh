#!/usr/bin/env bash
# Builds softscope on a bare Debian 12, measures the depth of a stereo pair, and reconstructs a clip
# whose truth is known.
set -euo pipefail

usage() {
  cat <<'EOF'
usage: ./demo.sh [--no-install] [--help]
  Installs what is missing of packages.txt (as root or by sudo), builds build/release, examines the
  machine, measures the depth of data/demo_pair, simulates a clip of a living organ, reconstructs it,
  measures the error, draws it and writes a report; ends by naming what to look at in out/demo.
  What takes long and was done before is not done again.
  --no-install   never calls apt-get
EOF
}

install=yes
for argument in "$@"; do
  case $argument in
    --no-install) install=no ;;
    --help | -h) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done

source "$(dirname "${BASH_SOURCE[0]}")/cmake/steps.sh"
step_count=10
softscope=build/release/apps/softscope
pair=data/demo_pair
out=out/demo

install_packages "$install"
configure release
build release softscope

step "Examine this machine: softscope doctor"
"$softscope" doctor || say "a picture can't be drawn here; depth is measured all the same"

step "Depth of $pair: softscope depth"
if [ -e "$out/summary.json" ] && [ -z "$(find "$softscope" "$pair" -newer "$out/summary.json")" ]; then
  say "measured before, and nothing has changed since"
else
  "$softscope" depth "$pair/left/000000.png" "$pair/right/000000.png" \
    --calibration "$pair/calibration.yaml" --out "$out" --force
fi

clip=$out/clip
step "A clip of a breathing, pushed organ, with its truth: softscope simulate"
if [ -e "$clip/groundtruth/trajectory.txt" ] && [ "$clip/groundtruth/trajectory.txt" -nt "$softscope" ]; then
  say "simulated before, and nothing has changed since"
else
  "$softscope" simulate --out "$clip" --frames 40 --size 480x360 --force
fi

run=$out/run
step "Its live model: softscope reconstruct"
if [ -e "$run/run.json" ] && [ "$run/run.json" -nt "$clip/groundtruth/trajectory.txt" ]; then
  say "reconstructed before, and nothing has changed since"
else
  "$softscope" reconstruct "$clip" --out "$run" --save-every 5 --track "$clip/track_points.csv" --force
fi

step "Its error: softscope evaluate"
"$softscope" evaluate "$run" --reference "$clip" --out "$out/error" --force

step "Four panels of it beside the truth: softscope figure"
"$softscope" figure "$run" --reference "$clip" --observed --width-mm 183 --force \
  --out "$out/four_panels.png" --out "$out/four_panels.pdf" ||
  say "3-D can't be drawn here; everything else is there"

step "A report for people: softscope report"
"$softscope" report "$out/error" --out "$out/report.html" --force
finish_step

echo
echo "Done in $SECONDS s. Look at"
cat <<EOF
  $out/report.html      the error of the clip's model, for any browser, with a map that turns
  $out/four_panels.png  the last model, from three sides and in 3-D, coloured by its error
  $out/picture.png      the photograph and its depth, with a scale in mm
  $out/disparity.png    how far each pixel moved between the two pictures
  $out/confidence.png   how sure each pixel is
  $out/cloud.ply        the tissue as coloured points in mm, for any mesh viewer
  $out/run/model.ply    the last model of the clip, for MeshLab
  $out/run/models.pvd   the model as it moves, for ParaView
  $out/error/error_series.png   its distance from the truth, frame by frame
EOF
echo "and try a clip of your own by"
echo "  $softscope reconstruct LEFT.mp4 RIGHT.mp4 --calibration CALIBRATION.yaml --out out/mine"
