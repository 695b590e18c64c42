#!/usr/bin/env bash
# tests/house/bare_machine.sh: README's two commands, or the packages, on a bare Debian 12 in a chroot.
set -euo pipefail

usage() {
  cat <<'EOT'
usage: tests/house/bare_machine.sh [--keep] [--packages DIR] FOLDER [COMMAND…]
  Builds Debian 12 without anything beyond its base in FOLDER, which must not exist, from the mirror
  that this machine's apt uses; puts a clean checkout of the last commit in, and runs there each
  COMMAND (./demo.sh and ./test.sh unless others are named). Ends with the time that each took, on
  the clock and of the processor; exits with 1 where one failed. To be run by hand, as root;
  needs debootstrap, git and 10 GB.
  --keep          leaves FOLDER as it is in the end
  --packages DIR  copies the .deb files of DIR to /packages there; the command is then
                  tests/house/try_packages.sh /packages unless others are named
EOT
}

fail() {
  echo "error: $*" >&2
  exit 2
}

keep=no
packages=
while :; do
  case ${1:-} in
    --keep) keep=yes; shift ;;
    --packages) packages=${2:-}; shift 2 || break ;;
    --help | -h) usage; exit 0 ;;
    '' | -*) usage >&2; exit 2 ;;
    *) break ;;
  esac
done
folder=$1
shift
commands=("$@")
if [ "${#commands[@]}" -eq 0 ]; then
  commands=(./demo.sh ./test.sh)
  if [ -n "$packages" ]; then commands=("tests/house/try_packages.sh /packages"); fi
fi
checkout=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

[ "$(id -u)" -eq 0 ] || fail "this is not root, who alone may build a chroot"
[ -z "$packages" ] || ls "$packages"/*.deb >/dev/null 2>&1 || fail "$packages holds no .deb file"
[ ! -e "$folder" ] || fail "$folder exists; name a folder that doesn't"
for tool in debootstrap git; do
  command -v "$tool" >/dev/null || fail "$tool is not installed"
done
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' \
  'Codename: bookworm' 'Component: main' | head -n 1)
[ -n "$mirror" ] || fail "apt knows no mirror of Debian bookworm here; see apt's sources.list(5)"

unmount() {
  for place in dev/shm dev/pts proc; do
    if mountpoint -q "$folder/$place"; then umount "$folder/$place"; fi
  done
}
clean_up() {
  unmount
  if [ "$keep" = no ]; then rm -rf --one-file-system "$folder"; fi
}
trap clean_up EXIT

echo "Debian 12 in $folder"
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
debootstrap --variant=minbase bookworm "$folder" "$mirror" >"$folder.debootstrap.log" ||
  fail "debootstrap failed, see $folder.debootstrap.log"
cp /etc/resolv.conf "$folder/etc/resolv.conf"
apt-config dump | grep -E '^Acquire::(http|https)::' >"$folder/etc/apt/apt.conf.d/90mirror" || true
mkdir -p "$folder/dev/shm" "$folder/dev/pts"
mount -t proc proc "$folder/proc"
mount -t devpts devpts "$folder/dev/pts"
mount -t tmpfs tmpfs "$folder/dev/shm"

echo "Checkout of $(git -C "$checkout" log -1 --format='%h %s')"
git clone --quiet "$checkout" "$folder/softscope"
if [ -n "$packages" ]; then
  mkdir "$folder/packages"
  cp "$packages"/*.deb "$folder/packages"
fi

# run_bare COMMAND: as a newcomer would, with nothing of this machine's environment.
run_bare() {
  env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin ${http_proxy:+http_proxy="$http_proxy"} \
    chroot "$folder" /bin/bash -c "cd /softscope && $1" </dev/null
}

outcome=0
lines=()
TIMEFORMAT='%R %U %S'
for command in "${commands[@]}"; do
  echo "=== $command"
  status=0
  { time run_bare "$command" 2>&1 || status=$?; } 2>"$folder.time"
  read -r wall user system <"$folder.time"
  lines+=("$(printf '%-24s exit %d  %6.0f s on the clock, %6.0f s of the processor and %4.0f s in the system' \
    "$command" "$status" "$wall" "$user" "$system")")
  if [ "$status" -ne 0 ]; then outcome=1; fi
done
rm -f "$folder.time" "$folder.debootstrap.log"
echo "=== on $(nproc) cores, from nothing"
printf '%s\n' "${lines[@]}"
exit "$outcome"
