#!/usr/bin/env bash
# Builds softscope on a bare Debian 12 and measures the depth of the small stereo pair in data/.
set -euo pipefail

usage() {
  cat <<'EOF'
usage: ./demo.sh [--no-install] [--help]
  Installs what is missing of packages.txt (as root or by sudo), builds build/release, examines the
  machine, measures the depth of data/demo_pair and names the pictures to look at in out/demo.
  What was done before is not done again.
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
step_count=5
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
finish_step

echo
echo "Done in $SECONDS s. Look at"
cat <<EOF
  $out/picture.png      the photograph and its depth, with a scale in mm
  $out/disparity.png    how far each pixel moved between the two pictures
  $out/confidence.png   how sure each pixel is
  $out/cloud.ply        the tissue as coloured points in mm, for any mesh viewer
  $out/summary.json     coverage, range and times, for programs
EOF
echo "and measure a pair of your own by"
echo "  $softscope depth LEFT.png RIGHT.png --calibration CALIBRATION.yaml --out out/mine"
