#!/usr/bin/env bash
# tests/house/try_packages.sh: checks, installs, runs and removes the Debian packages of a folder.
set -euo pipefail

usage() {
  cat <<'EOT'
usage: tests/house/try_packages.sh FOLDER
  FOLDER holds the .deb files that `cmake --build --preset package` makes. Checks them
  with lintian, installs them with what they depend on, runs the program, the module and a program
  that finds the library, removes them, and looks for what they left. Ends with 1 at the first
  failure. As root, on a Debian made for it: tests/house/bare_machine.sh --packages FOLDER …
EOT
}

case ${1:-} in
  --help | -h) usage; exit 0 ;;
  '' | -*) usage >&2; exit 2 ;;
esac
packages=$(cd "$1" && pwd)
checkout=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export DEBIAN_FRONTEND=noninteractive

step() { echo "--- $*"; }
install() {
  apt-get install -y -qq --no-install-recommends "$@" >"$work/apt.log" 2>&1 && return
  tail -n 20 "$work/apt.log"
  exit 1
}
files() { dpkg-deb --fsys-tarfile "$1" | tar -t | sed -n 's,^\./,/,; /[^/]$/p'; }

apt-get update -qq
step "install $(ls "$packages" | tr '\n' ' ')"
install "$packages"/*.deb

step "run the program"
cd "$work"
softscope --version
softscope doctor || true
softscope simulate --out clip --frames 4 --set truth_every=1 --size 240x180 --quiet >/dev/null
softscope reconstruct clip --out run --save-every 1 --quiet >/dev/null
softscope evaluate run --reference clip --out evaluation --quiet >/dev/null
softscope report evaluation --out report.html --quiet >/dev/null
test -s report.html

step "run the module"
python3 - <<'EOT'
import softscope
sequence = softscope.Sequence("clip")
reconstructor = softscope.Reconstructor(sequence.calibration)
for frame in sequence:
    reconstructor.process(frame.left, frame.right)
assert len(reconstructor.model()) > 1000
print(softscope.evaluate(softscope.Run("run"), "clip").surface.observed.p95_mm, "mm")
EOT

step "complete a word"
bash -c 'source /usr/share/bash-completion/completions/softscope
  COMP_WORDS=(softscope recon) COMP_CWORD=1 && _softscope && test "${COMPREPLY[*]}" = reconstruct'

step "build a program against the library"
install cmake g++ make
cmake -S "$checkout/tests/consumer/project" -B "$work/consumer" >/dev/null
cmake --build "$work/consumer" >/dev/null
mkdir "$work/made" && "$work/consumer/consumer" "$work/made"

step "check with lintian"
install lintian
lintian --allow-root --fail-on error "$packages"/*.deb

step "remove"
for file in "$packages"/*.deb; do
  dpkg-deb --field "$file" Package
done | xargs apt-get purge -y -qq >"$work/apt.log" 2>&1
left=$(for file in "$packages"/*.deb; do files "$file"; done | while read -r file; do
  if [ -e "$file" ]; then echo "$file"; fi
done)
if [ -n "$left" ]; then
  echo "left behind:" $left >&2
  exit 1
fi
echo "installed, run and removed"
